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

// The wrench that gives a body with velocity V the acceleration A (Newton and Euler, body frame):
//   f = m a + U h,   n = I alpha + omega x I omega + h x a.
// The first two terms of n are computed from the second moments S = (tr I / 2) 1 - I as the sum of
// r x (U r) over the body's points, n = vee(U S - (U S)^T): with U at hand it takes 15 products
// instead of 24 (Balafoutis, Patel and Misra 1988), and a body whose S is sparse takes fewer.
template <typename S>
Wrench<S> newton_euler(const RigidBodyInertia<S>& I, const VelocityTwist<S>& V,
                       const AccelerationTwist<S>& A) {
  const Matrix3<S> U = acceleration_gradient(V.angular, A.angular);
  const Vector3<S>& w = V.angular;
  const Symmetric3<S>& J = I.rotational;
  const S half(0.5);
  const S Sxx = half * (J.yy + J.zz - J.xx);
  const S Syy = half * (J.xx + J.zz - J.yy);
  const S Szz = half * (J.xx + J.yy - J.zz);
  // U.zz - U.yy = w.z^2 - w.y^2 and so on; S.xy = -J.xy and so on.
  const S wxx = w.x * w.x;
  const S wyy = w.y * w.y;
  const S wzz = w.z * w.z;
  const Vector3<S> rotation = {
      Syy * U.zy - Szz * U.yz - J.xy * U.zx + J.xz * U.yx - J.yz * (wzz - wyy),
      Szz * U.xz - Sxx * U.zx - J.yz * U.xy + J.xy * U.zy - J.xz * (wxx - wzz),
      Sxx * U.yx - Syy * U.xy - J.xz * U.yz + J.yz * U.xz - J.xy * (wyy - wxx)};
  return {rotation + cross(I.first_moment, A.linear), I.mass * A.linear + U * I.first_moment};
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
