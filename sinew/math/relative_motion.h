// Motion of a frame F with respect to another frame G that moves too, and coordinates of rotation.
#pragma once

#include <cmath>

#include "sinew/math/floating.h"
#include "sinew/math/jacobian.h"
#include "sinew/math/select.h"

namespace sinew::math {

template <typename S>
VelocityTwist<S> subtract(const VelocityTwist<S>& a, const VelocityTwist<S>& b) {
  return {a.angular - b.angular, a.linear - b.linear};
}

template <typename S>
AccelerationTwist<S> subtract(const AccelerationTwist<S>& a, const AccelerationTwist<S>& b) {
  return {a.angular - b.angular, a.linear - b.linear};
}

// The derivative of the twist's six numbers while its frame stands still in space and the body
// flows past: a_spatial = a - omega x v (Featherstone 2008, section 2.11).
template <typename S>
AccelerationTwist<S> spatial_acceleration(const AccelerationTwist<S>& A,
                                          const VelocityTwist<S>& V) {
  return {A.angular, A.linear - cross(V.angular, V.linear)};
}

// The derivative of the numbers of V, seen from a frame that turns with O, from the acceleration A
// that an observer who does not turn sees from the same directions: dx/dt = A - omega_O x V.
template <typename S>
AccelerationTwist<S> derivative_seen_by(const AccelerationTwist<S>& A, const VelocityTwist<S>& V,
                                        const VelocityTwist<S>& O) {
  return {A.angular - cross(O.angular, V.angular), A.linear - cross(O.angular, V.linear)};
}

// How a twist turns, seen from A instead of B: (R omega, 0).
template <typename S>
VelocityTwist<S> turning_seen_from_proximal(const Pose<S>& X_AB, const VelocityTwist<S>& V_B) {
  return {X_AB.R * V_B.angular, {S(0), S(0), S(0)}};
}

// What one joint adds to the velocity of a point: v + J_v qd. How the point turns is left.
template <typename S>
VelocityTwist<S> add_linear_motion_of_column(const VelocityTwist<S>& V, const VelocityTwist<S>& J,
                                             const S& qd) {
  return {V.angular, V.linear + qd * J.linear};
}

template <typename S>
JacobianBlock<S> subtract(const JacobianBlock<S>& a, const JacobianBlock<S>& b) {
  JacobianBlock<S> block;
  for (int k = 0; k < 6; ++k) block.columns[k] = subtract(a.columns[k], b.columns[k]);
  return block;
}

template <typename S>
JacobianBlock<S> rotate_to_distal(const Pose<S>& X_AB, const JacobianBlock<S>& J_A) {
  JacobianBlock<S> block;
  for (int k = 0; k < 6; ++k) block.columns[k] = rotate_to_distal(X_AB, J_A.columns[k]);
  return block;
}

// By the largest of the four squares 4 q_i^2 (Shepperd 1978), so that nothing is divided by a small
// number. The quaternion with w >= 0, of the two that there are.
template <typename S>
FloatingPosition<S> position_and_quaternion(const Pose<S>& X) {
  using std::sqrt;
  const Matrix3<S>& R = X.R;
  const S one(1), half(0.5);
  const S squares[4] = {one + R.xx - R.yy - R.zz, one - R.xx + R.yy - R.zz,
                        one - R.xx - R.yy + R.zz, one + R.xx + R.yy + R.zz};
  const S xy = R.yx + R.xy, xz = R.xz + R.zx, yz = R.zy + R.yz;
  const S wx = R.zy - R.yz, wy = R.xz - R.zx, wz = R.yx - R.xy;
  // 4 q_i q_j, row i.
  const S products[4][4] = {{squares[0], xy, xz, wx},
                            {xy, squares[1], yz, wy},
                            {xz, yz, squares[2], wz},
                            {wx, wy, wz, squares[3]}};
  S largest = squares[3];
  S row[4] = {products[3][0], products[3][1], products[3][2], products[3][3]};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 4; ++k) row[k] = select_less(largest, squares[i], products[i][k], row[k]);
    largest = select_less(largest, squares[i], squares[i], largest);
  }
  const S scale = half / sqrt(largest);
  const S sign = select_less(row[3], S(0), -scale, scale);
  return {X.p, {sign * row[0], sign * row[1], sign * row[2]}, sign * row[3]};
}

// The derivative of these seven numbers, where the frame has the twist V (a column of a Jacobian)
// with directions of the frame that X is with respect to: dq/dt = (omega, 0) q / 2.
template <typename S>
FloatingPosition<S> quaternion_rates(const FloatingPosition<S>& X, const VelocityTwist<S>& V) {
  const S half(0.5);
  const Vector3<S> turning = half * V.angular;
  return {V.linear, X.w * turning + cross(turning, X.v), -dot(turning, X.v)};
}

// The same of six columns.
template <typename S>
struct QuaternionBlock {
  FloatingPosition<S> columns[6];
};

template <typename S>
QuaternionBlock<S> quaternion_rates(const FloatingPosition<S>& X, const JacobianBlock<S>& J) {
  QuaternionBlock<S> block;
  for (int k = 0; k < 6; ++k) block.columns[k] = quaternion_rates(X, J.columns[k]);
  return block;
}

}  // namespace sinew::math
