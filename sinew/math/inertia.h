// Rigid-body inertia about the origin of the frame from which it is seen, and the wrench that moves
// it.
#pragma once

#include "sinew/math/rotation.h"
#include "sinew/math/twist.h"
#include "sinew/math/wrench.h"

namespace sinew::math {

template <typename S>
struct RigidBodyInertia {
  S mass{};                 // m [kg]
  Vector3<S> first_moment;  // h = m c [kg m]
  Symmetric3<S>
      rotational;  // I about the frame's origin [kg m^2]; products with their sign in the matrix
};

// Second moments S = (tr I / 2) 1 - I, the sum of m r r^T over the body's points. They turn as I
// does.
template <typename S>
Symmetric3<S> second_moments(const Symmetric3<S>& I) {
  const S half(0.5);
  return {half * (I.yy + I.zz - I.xx), -I.xy, -I.xz,
          half * (I.xx + I.zz - I.yy), -I.yz, half * (I.xx + I.yy - I.zz)};
}

// The sum of m r x (U r) over the body's points, vee(U S - (U S)^T), where U is the gradient of the
// acceleration field of a body that turns with omega: U.zz - U.yy = omega.z^2 - omega.y^2 and so
// on. `squares` are those of omega's components.
template <typename S>
Vector3<S> moment_of_turning(const Symmetric3<S>& M, const Matrix3<S>& U,
                             const Vector3<S>& squares) {
  return {M.yy * U.zy - M.zz * U.yz + M.xy * U.zx - M.xz * U.yx + M.yz * (squares.z - squares.y),
          M.zz * U.xz - M.xx * U.zx + M.yz * U.xy - M.xy * U.zy + M.xz * (squares.x - squares.z),
          M.xx * U.yx - M.yy * U.xy + M.xz * U.yz - M.yz * U.xz + M.xy * (squares.y - squares.x)};
}

// The wrench that gives a body with velocity V the acceleration A (Newton and Euler, body frame):
//   f = m a + U h,   n = I alpha + omega x I omega + h x a.
// The first two terms of n are computed from the second moments: with U at hand it takes 15
// products instead of 24 (Balafoutis, Patel and Misra 1988), and a body whose S is sparse takes
// fewer.
template <typename S>
Wrench<S> newton_euler(const RigidBodyInertia<S>& I, const VelocityTwist<S>& V,
                       const AccelerationTwist<S>& A) {
  const Matrix3<S> U = acceleration_gradient(V.angular, A.angular);
  const Vector3<S>& w = V.angular;
  const Vector3<S> n =
      moment_of_turning(second_moments(I.rotational), U, {w.x * w.x, w.y * w.y, w.z * w.z});
  return {n + cross(I.first_moment, A.linear), I.mass * A.linear + U * I.first_moment};
}

// The same wrench of a body behind a revolute joint, seen from the joint's frame A in the
// predecessor instead of the body's own frame B, from how the predecessor moves there and the joint
// turns. Nothing but the inertia changes its directions, and of the predecessor's U at A only what
// the joint's turning adds has to be computed: with q' and q'' about z, the column of z stays, the
// row gets 2 q' omega.x and 2 q' omega.y. For a body on which nothing hangs that takes fewer
// operations than turning its velocity and acceleration there and the wrench back.
template <typename S>
Wrench<S> newton_euler_across_revolute(const Pose<S>& X_AB, const RigidBodyInertia<S>& I_B,
                                       const VelocityTwist<S>& V_A,
                                       const VelocityTwist<S>& V_relative,
                                       const AccelerationTwist<S>& A_A,
                                       const AccelerationTwist<S>& A_relative) {
  const Vector3<S>& w = V_A.angular;
  const Vector3<S>& alpha = A_A.angular;
  const S wz = w.z + V_relative.angular.z;
  const S alpha_z = alpha.z + A_relative.angular.z;
  const S twice = S(2) * V_relative.angular.z;
  const S xx = w.x * w.x;
  const S yy = w.y * w.y;
  const S zz = wz * wz;
  const S xy = w.x * w.y;
  const S xz = w.x * w.z;
  const S yz = w.y * w.z;
  const Matrix3<S> U = {-(yy + zz),
                        xy - alpha_z,
                        xz + alpha.y,  //
                        xy + alpha_z,
                        -(xx + zz),
                        yz - alpha.x,  //
                        (xz - alpha.y) + twice * w.x,
                        (yz + alpha.x) + twice * w.y,
                        -(xx + yy)};
  const Vector3<S> h = X_AB.R * I_B.first_moment;
  const Vector3<S> n =
      moment_of_turning(rotate(X_AB.R, second_moments(I_B.rotational)), U, {xx, yy, zz});
  return {n + cross(h, A_A.linear), I_B.mass * A_A.linear + U * h};
}

// The same for a body at rest: f = m a + alpha x h, n = I alpha + h x a.
template <typename S>
Wrench<S> newton_euler_at_rest(const RigidBodyInertia<S>& I, const AccelerationTwist<S>& A) {
  const Symmetric3<S>& J = I.rotational;
  const Vector3<S>& al = A.angular;
  const Vector3<S> rotation = {J.xx * al.x + J.xy * al.y + J.xz * al.z,
                               J.xy * al.x + J.yy * al.y + J.yz * al.z,
                               J.xz * al.x + J.yz * al.y + J.zz * al.z};
  return {rotation + cross(I.first_moment, A.linear),
          I.mass * A.linear + cross(al, I.first_moment)};
}

// Both at once: a body at rest, behind a revolute joint, seen from the joint's frame. The rotated
// second moments are those that newton_euler_across_revolute needs; I = tr(S) 1 - S.
template <typename S>
Wrench<S> newton_euler_at_rest_across_revolute(const Pose<S>& X_AB, const RigidBodyInertia<S>& I_B,
                                               const AccelerationTwist<S>& A_A,
                                               const AccelerationTwist<S>& A_relative) {
  const Symmetric3<S> M = rotate(X_AB.R, second_moments(I_B.rotational));
  const Vector3<S> h = X_AB.R * I_B.first_moment;
  const Vector3<S> al = {A_A.angular.x, A_A.angular.y, A_A.angular.z + A_relative.angular.z};
  const Vector3<S> rotation = {(M.yy + M.zz) * al.x - M.xy * al.y - M.xz * al.z,
                               (M.xx + M.zz) * al.y - M.xy * al.x - M.yz * al.z,
                               I_B.rotational.zz * al.z - M.xz * al.x - M.yz * al.y};
  return {rotation + cross(h, A_A.linear), I_B.mass * A_A.linear + cross(al, h)};
}

// The same inertia seen from A and about A's origin: with h_A = R h + m p,
// I_A = R I R^T + (h_R . p + p . h_A) 1 - p h_R^T - h_A p^T where h_R = R h (Steiner's theorem).
template <typename S>
RigidBodyInertia<S> transform_to_proximal(const Pose<S>& X_AB, const RigidBodyInertia<S>& I_B) {
  const Vector3<S>& p = X_AB.p;
  const Symmetric3<S> J = rotate(X_AB.R, I_B.rotational);
  const Vector3<S> h = X_AB.R * I_B.first_moment;
  const Vector3<S> h_A = h + I_B.mass * p;
  const Vector3<S> g = h + h_A;
  const S xx = p.x * g.x;
  const S yy = p.y * g.y;
  const S zz = p.z * g.z;
  return {I_B.mass,
          h_A,
          {J.xx + (yy + zz), J.xy - (p.x * h.y + h_A.x * p.y), J.xz - (p.x * h.z + h_A.x * p.z),
           J.yy + (xx + zz), J.yz - (p.y * h.z + h_A.y * p.z), J.zz + (xx + yy)}};
}

// Of two bodies that are fixed to each other, seen from the same frame.
template <typename S>
RigidBodyInertia<S> add(const RigidBodyInertia<S>& a, const RigidBodyInertia<S>& b) {
  return {a.mass + b.mass, a.first_moment + b.first_moment, a.rotational + b.rotational};
}

// The wrench that accelerates a body at rest by one unit about its z, or along it.
template <typename S>
Wrench<S> wrench_of_revolute(const RigidBodyInertia<S>& I) {
  const Vector3<S>& h = I.first_moment;
  return {{I.rotational.xz, I.rotational.yz, I.rotational.zz}, {-h.y, h.x, S(0)}};
}

template <typename S>
Wrench<S> wrench_of_prismatic(const RigidBodyInertia<S>& I) {
  const Vector3<S>& h = I.first_moment;
  return {{h.y, -h.x, S(0)}, {S(0), S(0), I.mass}};
}

}  // namespace sinew::math
