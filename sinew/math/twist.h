// Velocity and acceleration twists. The reference point is the origin of the frame from which they
// are seen. Accelerations are classical: the derivative of the angular velocity [rad/s^2], and the
// acceleration of the frame's origin [m/s^2]. All are absolute unless a name says otherwise.
#pragma once

#include "sinew/math/pose.h"

namespace sinew::math {

template <typename S>
struct VelocityTwist {
  Vector3<S> angular;  // omega [rad/s]
  Vector3<S> linear;   // v [m/s]
};

template <typename S>
struct AccelerationTwist {
  Vector3<S> angular;  // alpha [rad/s^2]
  Vector3<S> linear;   // a [m/s^2]
};

// The gradient of a rigid body's acceleration field, U = [alpha]x + [omega]x [omega]x: the
// acceleration of the point at p is a + U p, and the inertial force of first moment h is m a + U h
// (Balafoutis, Patel and Misra 1988 name it the angular acceleration tensor). Whoever needs it
// calls this, so that it is computed once for each body.
template <typename S>
Matrix3<S> acceleration_gradient(const Vector3<S>& omega, const Vector3<S>& alpha) {
  const S xx = omega.x * omega.x;
  const S yy = omega.y * omega.y;
  const S zz = omega.z * omega.z;
  const S xy = omega.x * omega.y;
  const S xz = omega.x * omega.z;
  const S yz = omega.y * omega.z;
  return {-(yy + zz),   xy - alpha.z, xz + alpha.y,  //
          xy + alpha.z, -(xx + zz),   yz - alpha.x,  //
          xz - alpha.y, yz + alpha.x, -(xx + yy)};
}

// Velocity of frame B that is rigidly attached to A: omega_B = R^T omega_A, v_B = R^T (v_A +
// omega_A x p).
template <typename S>
VelocityTwist<S> transform_to_distal(const Pose<S>& X_AB, const VelocityTwist<S>& V_A) {
  return {transpose_times(X_AB.R, V_A.angular),
          transpose_times(X_AB.R, V_A.linear + cross(V_A.angular, X_AB.p))};
}

// Acceleration of frame B that is rigidly attached to A, with V_A the velocity of A:
// alpha_B = R^T alpha_A, a_B = R^T (a_A + U p).
template <typename S>
AccelerationTwist<S> transform_to_distal_fixed(const Pose<S>& X_AB, const VelocityTwist<S>& V_A,
                                               const AccelerationTwist<S>& A_A) {
  const Matrix3<S> U = acceleration_gradient(V_A.angular, A_A.angular);
  return {transpose_times(X_AB.R, A_A.angular), transpose_times(X_AB.R, A_A.linear + U * X_AB.p)};
}

// Acceleration of frame B that moves with V_rel with respect to A (seen from B), without the part
// that its relative acceleration adds: alpha_B = R^T alpha_A + (R^T omega_A) x omega_rel, a_B = R^T
// (a_A + U p) + 2 (R^T omega_A) x v_rel.
template <typename S>
AccelerationTwist<S> transform_to_distal(const Pose<S>& X_AB, const VelocityTwist<S>& V_A,
                                         const VelocityTwist<S>& V_rel,
                                         const AccelerationTwist<S>& A_A) {
  const AccelerationTwist<S> A_B = transform_to_distal_fixed(X_AB, V_A, A_A);
  const Vector3<S> omega = transpose_times(X_AB.R, V_A.angular);
  return {A_B.angular + cross(omega, V_rel.angular),
          A_B.linear + S(2) * cross(omega, V_rel.linear)};
}

// Sum of twists that are seen from the same frame.
template <typename S>
VelocityTwist<S> add(const VelocityTwist<S>& a, const VelocityTwist<S>& b) {
  return {a.angular + b.angular, a.linear + b.linear};
}

template <typename S>
AccelerationTwist<S> add(const AccelerationTwist<S>& a, const AccelerationTwist<S>& b) {
  return {a.angular + b.angular, a.linear + b.linear};
}

// Acceleration of frame B that is rigidly attached to A, of a body at rest:
// alpha_B = R^T alpha_A, a_B = R^T (a_A + alpha_A x p).
template <typename S>
AccelerationTwist<S> transform_to_distal_at_rest(const Pose<S>& X_AB,
                                                 const AccelerationTwist<S>& A_A) {
  return {transpose_times(X_AB.R, A_A.angular),
          transpose_times(X_AB.R, A_A.linear + cross(A_A.angular, X_AB.p))};
}

// Gravity g as the acceleration of what falls freely, and the base's seen from there.
template <typename S>
AccelerationTwist<S> free_fall(const Vector3<S>& g) {
  return {{S(0), S(0), S(0)}, g};
}

template <typename S>
AccelerationTwist<S> base_acceleration(const Vector3<S>& g) {
  return {{S(0), S(0), S(0)}, -g};
}

// The same twist, about the same point, seen from other directions: from B to A, and from A to B.
template <typename S>
VelocityTwist<S> rotate_to_proximal(const Pose<S>& X_AB, const VelocityTwist<S>& V_B) {
  return {X_AB.R * V_B.angular, X_AB.R * V_B.linear};
}

template <typename S>
VelocityTwist<S> rotate_to_distal(const Pose<S>& X_AB, const VelocityTwist<S>& V_A) {
  return {transpose_times(X_AB.R, V_A.angular), transpose_times(X_AB.R, V_A.linear)};
}

template <typename S>
AccelerationTwist<S> rotate_to_proximal(const Pose<S>& X_AB, const AccelerationTwist<S>& A_B) {
  return {X_AB.R * A_B.angular, X_AB.R * A_B.linear};
}

template <typename S>
AccelerationTwist<S> rotate_to_distal(const Pose<S>& X_AB, const AccelerationTwist<S>& A_A) {
  return {transpose_times(X_AB.R, A_A.angular), transpose_times(X_AB.R, A_A.linear)};
}

}  // namespace sinew::math
