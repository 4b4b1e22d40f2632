/* The support library that `sinew generate --style readable` calls: one plain function for each
 * operator, on arrays of double in the layouts below. The numbers are those of the optimised code
 * to round-off.
 *
 *   pose                12  row-major 3x4 [R p]; X_AB is the pose of B in A: p_A = R p_B + p
 *   velocity twist       6  angular (rad/s), then linear (m/s)
 *   acceleration twist   6  angular (rad/s^2), then linear (m/s^2), classical
 *   wrench               6  moment (N m), then force (N)
 *   rigid-body inertia  10  m, m c (3), Ixx Ixy Ixz Iyy Iyz Izz about the frame's origin
 *   articulated inertia 21  J (xx xy xz yy yz zz), H row by row, M: n = J alpha + H a, f = H^T
 * alpha + M a
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

/* Gravity: the acceleration of a base that rests, and of what falls freely at the origin of X. */
void sinew_base_acceleration_from_gravity(const double g[3], double A[6]);
void sinew_free_fall_from_gravity(const double X[12], const double g[3], double A[6]);

/* The wrench that gives a body with velocity V the acceleration A. */
void sinew_newton_euler_wrench(const double I[10], const double V[6], const double A[6],
                               double W[6]);
/* The same, seen from the frame A before the body's revolute joint, where the predecessor moves
 * with V_A and A_A; V_rel and A_rel are those of the body B with respect to it. */
void sinew_newton_euler_wrench_across_revolute(const double X_AB[12], const double I_B[10],
                                               const double V_A[6], const double V_rel[6],
                                               const double A_A[6], const double A_rel[6],
                                               double W_A[6]);
void sinew_acceleration_twist_to_wrench(const double I[10], const double A[6], double W[6]);
void sinew_acceleration_twist_to_wrench_across_revolute(const double X_AB[12], const double I_B[10],
                                                        const double A_A[6], const double A_rel[6],
                                                        double W_A[6]);
void sinew_transform_wrench_to_proximal(const double X_AB[12], const double W_B[6], double W_A[6]);
void sinew_accumulate_wrench(const double a[6], const double b[6], double c[6]);
void sinew_rotate_wrench_to_proximal(const double X_AB[12], const double W_B[6], double W_A[6]);
void sinew_rotate_wrench_to_distal(const double X_AB[12], const double W_A[6], double W_B[6]);

/* Inertias of several bodies together. */
void sinew_transform_rigid_body_inertia_to_proximal(const double X_AB[12], const double I_B[10],
                                                    double I_A[10]);
void sinew_accumulate_rigid_body_inertia(const double a[10], const double b[10], double c[10]);
void sinew_articulated_from_rigid_body_inertia(const double I[10], double IA[21]);
void sinew_transform_articulated_body_inertia_to_proximal(const double X_AB[12],
                                                          const double I_B[21], double I_A[21]);
void sinew_accumulate_articulated_body_inertia(const double a[21], const double b[21],
                                               double c[21]);

/* The wrench U that accelerates a body at rest by one unit about z, or along z; its component along
 * the joint is the inertia D that the joint feels. */
void sinew_wrench_of_revolute_from_rigid_body_inertia(const double I[10], double U[6]);
void sinew_wrench_of_prismatic_from_rigid_body_inertia(const double I[10], double U[6]);
void sinew_wrench_of_revolute_from_articulated_body_inertia(const double I[21], double U[6]);
void sinew_wrench_of_prismatic_from_articulated_body_inertia(const double I[21], double U[6]);

/* Through a joint that is free to move: I - U U^T / D; W + U u / D; and the joint's acceleration
 * under the force u while the predecessor accelerates with A, (u - U . A) / D. */
void sinew_project_articulated_body_inertia(const double I[21], const double U[6],
                                            const double D[1], double I_a[21]);
void sinew_project_wrench(const double W[6], const double U[6], const double D[1],
                          const double u[1], double W_a[6]);
void sinew_joint_acceleration_from_force(const double u[1], const double U[6], const double D[1],
                                         const double A[6], double qdd[1]);
void sinew_subtract_joint_force(const double a[1], const double b[1], double c[1]);

/* A floating base: position x y z and unit quaternion x y z w; velocity seen from the base;
 * acceleration the derivative of those numbers; force the wrench on the base, seen from it. */
void sinew_position_to_pose_floating(const double q[7], double X[12]);
void sinew_velocity_to_twist_floating(const double qd[6], double V[6]);
void sinew_acceleration_to_twist_floating(const double qdd[6], const double V[6], double A[6]);
void sinew_force_from_wrench_floating(const double W[6], double f[6]);
void sinew_subtract_floating_force(const double a[6], const double b[6], double c[6]);
/* qdd = I^-1 u for an articulated inertia: J (6), H (9), M (6). */
void sinew_floating_acceleration_from_force(const double I[21], const double u[6], double qdd[6]);

/* The twist of the origin of B for one unit of velocity of a joint about, or along, z of C. */
void sinew_jacobian_column_revolute(const double X_RC[12], const double X_RB[12], double J[6]);
void sinew_jacobian_column_prismatic(const double X_RC[12], const double X_RB[12], double J[6]);

/* Matrices, row by row: from `count` numbers one after the other; from `count` columns of 6. */
void sinew_mass_matrix_from_entries(const double* const entries[], int count, double* M);
void sinew_jacobian_from_columns(const double* const columns[], int count, double* J);
/* The same of a floating base: first its 6 columns one after the other; or its composite inertia
 * (10), then n wrenches (6), then n x n entries. */
void sinew_jacobian_columns_floating(const double X_RC[12], const double X_RB[12], double J[36]);
void sinew_floating_jacobian_from_columns(const double* const columns[], int count, double* J);
void sinew_floating_mass_matrix_from_parts(const double* const parts[], int count, double* M);

/* Momentum (angular, then linear; 6 numbers), energy, centre of mass (3). */
void sinew_momentum_from_velocity_twist(const double I[10], const double V[6], double P[6]);
void sinew_transform_momentum_to_proximal(const double X_AB[12], const double P_B[6],
                                          double P_A[6]);
void sinew_accumulate_momentum(const double a[6], const double b[6], double c[6]);
void sinew_kinetic_energy_from_momentum(const double V[6], const double P[6], double T[1]);
void sinew_add_energy(const double a[1], const double b[1], double c[1]);
void sinew_potential_energy_from_rigid_body_inertia(const double I[10], const double A[6],
                                                    double E[1]);
void sinew_center_of_mass_from_rigid_body_inertia(const double I[10], double p[3]);
void sinew_center_of_mass_velocity_from_momentum(const double I[10], const double P[6],
                                                 double v[3]);
void sinew_center_of_mass_column_revolute(const double X[12], const double I[10],
                                          const double total[10], double J[3]);
void sinew_center_of_mass_column_prismatic(const double X[12], const double I[10],
                                           const double total[10], double J[3]);
void sinew_center_of_mass_columns_floating(const double X[12], const double I[10],
                                           const double total[10], double J[18]);
void sinew_linear_jacobian_from_columns(const double* const columns[], int count, double* J);
void sinew_floating_linear_jacobian_from_columns(const double* const columns[], int count,
                                                 double* J);

/* Hybrid dynamics. Through a joint that gives way: qdd = e / D and F - U qdd. */
void sinew_subtract_wrench(const double a[6], const double b[6], double c[6]);
void sinew_add_joint_force(const double a[1], const double b[1], double c[1]);
void sinew_add_floating_force(const double a[6], const double b[6], double c[6]);
void sinew_joint_acceleration_from_drive(const double e[1], const double D[1], double qdd[1]);
void sinew_release_wrench(const double F[6], const double U[6], const double qdd[1], double F_a[6]);

/* Acceleration energy [N m/s^2]: F . A; the sum of e_j qdd_j, first all e, then all qdd. */
void sinew_acceleration_energy_of_wrench(const double F[6], const double A[6], double E[1]);
void sinew_acceleration_energy_of_joint_forces(const double* const parts[], int count, double* E);
void sinew_acceleration_energy_of_floating_force(const double e[6], const double qdd[6],
                                                 double E[1]);
void sinew_add_acceleration_energy(const double a[1], const double b[1], double c[1]);
void sinew_subtract_acceleration_energy(const double a[1], const double b[1], double c[1]);

/* Magnitudes x of n constraint forces, L x = r: the lower triangle of L row by row, r, and the
 * policy's number; n is at most 24 (truncated: 12). One of them: the vector, then a factor for each
 * number. */
void sinew_constraint_magnitudes_in_order(const double* const parts[], int count, double* x);
void sinew_constraint_magnitudes_damped(const double* const parts[], int count, double* x);
void sinew_constraint_magnitudes_truncated(const double* const parts[], int count, double* x);
void sinew_constraint_magnitude(const double* const parts[], int count, double* x);

/* Sums of what is in the first half of the parts times what is in the second half. */
void sinew_weigh_magnitudes(const double* const parts[], int count, double* sum);
void sinew_weigh_joint_forces(const double* const parts[], int count, double* sum);
void sinew_weigh_floating_forces(const double* const parts[], int count, double* sum);
/* The largest s in [0, 1], coming from 1, with |a_j + s b_j| <= l_j for every j, or 0: all a, all
 * b, all l. */
void sinew_scale_within_limits(const double* const parts[], int count, double* s);

/* Momentum about the centre of mass c, and what one unit of a joint's velocity adds to it. */
void sinew_momentum_about_center_of_mass(const double P[6], const double c[3], double P_c[6]);
void sinew_centroidal_momentum_column_revolute(const double X[12], const double I[10],
                                               const double c[3], double A[6]);
void sinew_centroidal_momentum_column_prismatic(const double X[12], const double I[10],
                                                const double c[3], double A[6]);
void sinew_centroidal_momentum_columns_floating(const double X[12], const double I[10],
                                                const double c[3], double A[36]);
void sinew_momentum_matrix_from_columns(const double* const columns[], int count, double* A);
void sinew_floating_momentum_matrix_from_columns(const double* const columns[], int count,
                                                 double* A);

#ifdef __cplusplus
}
#endif

#include "sinew_math_control.h"
#include "sinew_math_joints.h"
#include "sinew_math_relative.h"

#endif
