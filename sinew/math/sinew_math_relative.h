/* The part of the support library that is about motion between two frames that both move, and about
 * coordinates of rotation. sinew_math.h includes it. Formulas: math/relative_motion.h. */
#ifndef SINEW_MATH_RELATIVE_H
#define SINEW_MATH_RELATIVE_H

#ifdef __cplusplus
extern "C" {
#endif

void sinew_subtract_velocity_twist(const double V_F[6], const double V_G[6], double V[6]);
void sinew_subtract_acceleration_twist(const double A_F[6], const double A_G[6], double A[6]);
void sinew_spatial_acceleration_from_classical(const double A[6], const double V[6],
                                               double spatial[6]);
void sinew_derivative_seen_by_observer(const double A[6], const double V[6],
                                       const double observer[6], double derivative[6]);
void sinew_rotate_spatial_acceleration_twist_to_proximal(const double X[12], const double A_B[6],
                                                         double A_A[6]);

/* How B turns, seen from A: (R w, 0); and a twist with the linear part of J qd added. */
void sinew_turning_seen_from_proximal(const double X[12], const double V_B[6], double V_A[6]);
void sinew_add_linear_motion_of_column(const double V[6], const double J[6], const double qd[1],
                                       double V_with[6]);

/* Columns of Jacobians; X is the pose of the one frame with respect to the other. */
void sinew_jacobian_column_between(const double X[12], const double moved[6],
                                   const double moving[6], double J[6]);
void sinew_jacobian_columns_between(const double X[12], const double moved[36],
                                    const double moving[36], double J[36]);
void sinew_rotate_jacobian_column_to_distal(const double X[12], const double J_A[6], double J_B[6]);
void sinew_rotate_jacobian_columns_to_distal(const double X[12], const double J_A[36],
                                             double J_B[36]);

/* Position and unit quaternion x y z w, w >= 0; their derivatives for a column of a Jacobian. */
void sinew_position_and_quaternion_from_pose(const double X[12], double q[7]);
void sinew_quaternion_column_from_jacobian_column(const double q[7], const double J[6],
                                                  double rates[7]);
void sinew_quaternion_columns_from_jacobian_columns(const double q[7], const double J[36],
                                                    double rates[42]);
void sinew_analytic_jacobian_from_columns(const double* const columns[], int count, double* J);
void sinew_floating_analytic_jacobian_from_columns(const double* const columns[], int count,
                                                   double* J);

#ifdef __cplusplus
}
#endif

#endif
