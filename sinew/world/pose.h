// Poses as the world model keeps them: a unit quaternion and a point, seven numbers. Chains compose
// and interpolate in this form; the solvers' [R p] is a conversion away. X_AB is the pose of frame
// B in frame A, as everywhere: p_A = R p_B + p.
#pragma once

#include <cstddef>

#include "sinew/math/pose.h"
#include "sinew/math/twist.h"

namespace sinew::world {

using Vector3 = math::Vector3<double>;
using Twist = math::VelocityTwist<double>;             // angular first
using Acceleration = math::AccelerationTwist<double>;  // angular first, classical

struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
};

struct Pose {
  Quaternion q;  // of length 1
  Vector3 p;     // [m]
};

// a b, as rotations: first b, then a.
inline Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  return {
      a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
      a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

inline Quaternion conjugate(const Quaternion& q) { return {-q.x, -q.y, -q.z, q.w}; }

// R(q) v = v + w t + u x t with t = 2 u x v, u the quaternion's vector part.
inline Vector3 rotate(const Quaternion& q, const Vector3& v) {
  const Vector3 u = {q.x, q.y, q.z};
  const Vector3 t = 2.0 * math::cross(u, v);
  return v + q.w * t + math::cross(u, t);
}

// X_AC = X_AB X_BC
inline Pose compose(const Pose& X_AB, const Pose& X_BC) {
  return {X_AB.q * X_BC.q, X_AB.p + rotate(X_AB.q, X_BC.p)};
}

// X_AC = X_AB X_CB^-1, at the cost of a composition.
inline Pose compose_inverse(const Pose& X_AB, const Pose& X_CB) {
  const Quaternion q = X_AB.q * conjugate(X_CB.q);
  return {q, X_AB.p - rotate(q, X_CB.p)};
}

inline Pose invert(const Pose& X_AB) {
  const Quaternion q = conjugate(X_AB.q);
  return {q, -rotate(q, X_AB.p)};
}

// The rotation about z by q, and the translation along z: the joints of the normalised tree.
Pose revolute(double angle_rad);
Pose prismatic(double distance_m);

math::Pose<double> to_matrix(const Pose& pose);
Pose from_matrix(const math::Pose<double>& pose);  // precondition: R is a rotation
// The quaternion made unit length; false when its length differs from 1 by more than the tolerance,
// or a number is not finite.
inline constexpr double kQuaternionTolerance = 1e-6;
bool normalise(Pose& pose);

// Between two poses, share 0 .. 1 of the way. `slerp`: the point on a straight line, the rotation
// about one axis at constant rate (Shoemake 1985), the shorter way round. `screw`: the geodesic of
// SE(3), X_A exp(share log(X_A^-1 X_B)), as a body moves whose twist is constant.
Pose slerp(const Pose& from, const Pose& to, double share);
Pose screw(const Pose& from, const Pose& to, double share);

// The displacement after `seconds` of a body whose twist V, seen from itself, is constant: exp(V
// t).
Pose exponential(const Twist& V_B, double seconds);
// The constant twist, seen from the body, that leads from 1 to X within one second.
Twist logarithm(const Pose& X);

}  // namespace sinew::world
