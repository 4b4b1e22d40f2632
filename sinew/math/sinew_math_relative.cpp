#include "sinew/math/sinew_math_relative.h"

#include "sinew/math/c_arrays.h"
#include "sinew/math/relative_motion.h"

using namespace sinew::math;
using namespace sinew::math::c_arrays;

void sinew_subtract_velocity_twist(const double* V_F, const double* V_G, double* V) {
  store(subtract(load<VelocityTwist>(V_F), load<VelocityTwist>(V_G)), V);
}

void sinew_subtract_acceleration_twist(const double* A_F, const double* A_G, double* A) {
  store(subtract(load<AccelerationTwist>(A_F), load<AccelerationTwist>(A_G)), A);
}

void sinew_spatial_acceleration_from_classical(const double* A, const double* V, double* spatial) {
  store(spatial_acceleration(load<AccelerationTwist>(A), load<VelocityTwist>(V)), spatial);
}

void sinew_derivative_seen_by_observer(const double* A, const double* V, const double* observer,
                                       double* derivative) {
  store(derivative_seen_by(load<AccelerationTwist>(A), load<VelocityTwist>(V),
                           load<VelocityTwist>(observer)),
        derivative);
}

void sinew_rotate_spatial_acceleration_twist_to_proximal(const double* X, const double* A_B,
                                                         double* A_A) {
  store(rotate_to_proximal(load<Pose>(X), load<AccelerationTwist>(A_B)), A_A);
}

void sinew_turning_seen_from_proximal(const double* X, const double* V_B, double* V_A) {
  store(turning_seen_from_proximal(load<Pose>(X), load<VelocityTwist>(V_B)), V_A);
}

void sinew_add_linear_motion_of_column(const double* V, const double* J, const double* qd,
                                       double* V_with) {
  store(add_linear_motion_of_column(load<VelocityTwist>(V), load<VelocityTwist>(J), *qd), V_with);
}

void sinew_jacobian_column_between(const double* /*X*/, const double* moved, const double* moving,
                                   double* J) {
  store(subtract(load<VelocityTwist>(moved), load<VelocityTwist>(moving)), J);
}

void sinew_jacobian_columns_between(const double* /*X*/, const double* moved, const double* moving,
                                    double* J) {
  store(subtract(load<JacobianBlock>(moved), load<JacobianBlock>(moving)), J);
}

void sinew_rotate_jacobian_column_to_distal(const double* X, const double* J_A, double* J_B) {
  store(rotate_to_distal(load<Pose>(X), load<VelocityTwist>(J_A)), J_B);
}

void sinew_rotate_jacobian_columns_to_distal(const double* X, const double* J_A, double* J_B) {
  store(rotate_to_distal(load<Pose>(X), load<JacobianBlock>(J_A)), J_B);
}

void sinew_position_and_quaternion_from_pose(const double* X, double* q) {
  store(position_and_quaternion(load<Pose>(X)), q);
}

void sinew_quaternion_column_from_jacobian_column(const double* q, const double* J, double* rates) {
  store(quaternion_rates(load<FloatingPosition>(q), load<VelocityTwist>(J)), rates);
}

void sinew_quaternion_columns_from_jacobian_columns(const double* q, const double* J,
                                                    double* rates) {
  store(quaternion_rates(load<FloatingPosition>(q), load<JacobianBlock>(J)), rates);
}

void sinew_analytic_jacobian_from_columns(const double* const columns[], int count, double* J) {
  for (int column = 0; column < count; ++column)
    for (int row = 0; row < 7; ++row) J[row * count + column] = columns[column][row];
}

void sinew_floating_analytic_jacobian_from_columns(const double* const columns[], int count,
                                                   double* J) {
  const int width = 6 + count - 1;
  for (int row = 0; row < 7; ++row) {
    for (int k = 0; k < 6; ++k) J[row * width + k] = columns[0][7 * k + row];
    for (int j = 1; j < count; ++j) J[row * width + 5 + j] = columns[j][row];
  }
}
