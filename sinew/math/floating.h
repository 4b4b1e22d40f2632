// The joint that leaves a body free: between the world and a floating base. Its position is that of
// the base's frame in the world and a unit quaternion; velocity is the base's twist, seen from
// itself; acceleration is the time derivative of those six numbers; force is the wrench on the
// base, seen from it.
#pragma once

#include "sinew/math/articulated_inertia.h"

namespace sinew::math {

template <typename S>
struct FloatingPosition {
  Vector3<S> p;  // of the base's origin in the world [m]
  Vector3<S> v;  // vector part of the quaternion
  S w{};         // its scalar part
};

// R = 1 + 2 w [v]x + 2 [v]x [v]x, for a quaternion of length 1.
template <typename S>
Pose<S> floating_pose(const FloatingPosition<S>& q) {
  const S two(2);
  const S x = two * q.v.x;
  const S y = two * q.v.y;
  const S z = two * q.v.z;
  const S xx = x * q.v.x;
  const S yy = y * q.v.y;
  const S zz = z * q.v.z;
  const S xy = x * q.v.y;
  const S xz = x * q.v.z;
  const S yz = y * q.v.z;
  const S wx = x * q.w;
  const S wy = y * q.w;
  const S wz = z * q.w;
  const S one(1);
  return {{one - (yy + zz), xy - wz, xz + wy,  //
           xy + wz, one - (xx + zz), yz - wx,  //
           xz - wy, yz + wx, one - (xx + yy)},
          q.p};
}

// From the derivative of the six numbers of V to the classical acceleration: a = dv/dt + omega x v.
template <typename S>
AccelerationTwist<S> floating_acceleration(const AccelerationTwist<S>& derivative,
                                           const VelocityTwist<S>& V) {
  return {derivative.angular, derivative.linear + cross(V.angular, V.linear)};
}

// The acceleration that a wrench gives an articulated body at rest: I^-1 W, by factorisation
// L D L^T without pivoting (I is positive definite).
template <typename S>
AccelerationTwist<S> solve(const ArticulatedInertia<S>& I, const Wrench<S>& W) {
  S A[6][6] = {{I.J.xx, I.J.xy, I.J.xz, I.H.xx, I.H.xy, I.H.xz},
               {I.J.xy, I.J.yy, I.J.yz, I.H.yx, I.H.yy, I.H.yz},
               {I.J.xz, I.J.yz, I.J.zz, I.H.zx, I.H.zy, I.H.zz},
               {I.H.xx, I.H.yx, I.H.zx, I.M.xx, I.M.xy, I.M.xz},
               {I.H.xy, I.H.yy, I.H.zy, I.M.xy, I.M.yy, I.M.yz},
               {I.H.xz, I.H.yz, I.H.zz, I.M.xz, I.M.yz, I.M.zz}};
  S b[6] = {W.moment.x, W.moment.y, W.moment.z, W.force.x, W.force.y, W.force.z};
  // Column k of L times D stays in A below the diagonal until it has been used.
  for (int k = 0; k < 6; ++k) {
    for (int i = k + 1; i < 6; ++i) {
      const S l = A[i][k] / A[k][k];
      for (int j = k + 1; j <= i; ++j) A[i][j] = A[i][j] - l * A[j][k];
      b[i] = b[i] - l * b[k];
    }
  }
  for (int k = 5; k >= 0; --k) {
    for (int i = k + 1; i < 6; ++i) b[k] = b[k] - A[i][k] * b[i];
    b[k] = b[k] / A[k][k];
  }
  return {{b[0], b[1], b[2]}, {b[3], b[4], b[5]}};
}

}  // namespace sinew::math
