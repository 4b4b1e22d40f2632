/* The support library that `sinew generate --style readable` calls: one plain function for each
 * operator, on arrays of double in the layouts below. The numbers are those of the optimised code
 * to round-off.
 *
 *   pose                12  row-major 3x4 [R p]; X_AB is the pose of B in A: p_A = R p_B + p
 *   velocity twist       6  angular (rad/s), then linear (m/s)
 *   acceleration twist   6  angular (rad/s^2), then linear (m/s^2), classical
 *   wrench               6  moment (N m), then force (N)
 *   rigid-body inertia  10  m, m c (3), Ixx Ixy Ixz Iyy Iyz Izz about the frame's origin
 *
 * A twist or wrench is about the origin of the frame from which it is seen, which the suffix names:
 * V_A is seen from A. Outputs come last and may not overlap inputs. No allocation, no global state.
 */
#ifndef SINEW_MATH_H
#define SINEW_MATH_H

#ifdef __cplusplus
extern "C" {
#endif

/* Joints along or about z: position, velocity, acceleration and force of one degree of freedom. */
void sinew_position_to_pose_revolute(const double q[1], double X[12]);
void sinew_position_to_pose_prismatic(const double q[1], double X[12]);
void sinew_velocity_to_twist_revolute(const double qd[1], double V[6]);
void sinew_velocity_to_twist_prismatic(const double qd[1], double V[6]);
void sinew_acceleration_to_twist_revolute(const double qdd[1], double A[6]);
void sinew_acceleration_to_twist_prismatic(const double qdd[1], double A[6]);
void sinew_force_from_wrench_revolute(const double W[6], double tau[1]);
void sinew_force_from_wrench_prismatic(const double W[6], double tau[1]);

/* Poses: X_AC = X_AB X_BC; X_BA = X_AB^-1. */
void sinew_compose_pose(const double X_AB[12], const double X_BC[12], double X_AC[12]);
void sinew_invert_pose(const double X_AB[12], double X_BA[12]);

/* Motion of frame B that is rigidly attached to A. */
void sinew_transform_velocity_twist_to_distal(const double X_AB[12], const double V_A[6],
                                              double V_B[6]);
void sinew_transform_acceleration_twist_to_distal_fixed(const double X_AB[12], const double V_A[6],
                                                        const double A_A[6], double A_B[6]);
/* Acceleration of frame B that moves with V_rel (seen from B) with respect to A, without the part
 * that its relative acceleration adds. V_A is the absolute velocity of A. */
void sinew_transform_acceleration_twist_to_distal(const double X_AB[12], const double V_A[6],
                                                  const double V_rel[6], const double A_A[6],
                                                  double A_B[6]);
void sinew_add_velocity_twist(const double a[6], const double b[6], double c[6]);
void sinew_add_acceleration_twist(const double a[6], const double b[6], double c[6]);

void sinew_transform_acceleration_twist_to_distal_at_rest(const double X_AB[12],
                                                          const double A_A[6], double A_B[6]);

/* The same twist, about the same point, seen from other directions. */
void sinew_rotate_velocity_twist_to_proximal(const double X_AB[12], const double V_B[6],
                                             double V_A[6]);
void sinew_rotate_velocity_twist_to_distal(const double X_AB[12], const double V_A[6],
                                           double V_B[6]);
void sinew_rotate_acceleration_twist_to_proximal(const double X_AB[12], const double A_B[6],
                                                 double A_A[6]);
void sinew_rotate_acceleration_twist_to_distal(const double X_AB[12], const double A_A[6],
                                               double A_B[6]);

/* The wrench that gives a body with velocity V the acceleration A. */
void sinew_newton_euler_wrench(const double I[10], const double V[6], const double A[6],
                               double W[6]);
void sinew_acceleration_twist_to_wrench(const double I[10], const double A[6], double W[6]);
void sinew_transform_wrench_to_proximal(const double X_AB[12], const double W_B[6], double W_A[6]);
void sinew_accumulate_wrench(const double a[6], const double b[6], double c[6]);
void sinew_rotate_wrench_to_proximal(const double X_AB[12], const double W_B[6], double W_A[6]);
void sinew_rotate_wrench_to_distal(const double X_AB[12], const double W_A[6], double W_B[6]);

#ifdef __cplusplus
}
#endif

#endif
