// Articulated-body inertia (Featherstone 1983): how a body with everything that hangs on it through
// joints resists acceleration, for a robot at rest: n = J alpha + H a, f = H^T alpha + M a.
#pragma once

#include "sinew/math/inertia.h"

namespace sinew::math {

template <typename S>
struct ArticulatedInertia {
  Symmetric3<S> J;  // moment for angular acceleration [kg m^2]
  Matrix3<S> H;     // moment for linear acceleration, and transposed force for angular [kg m]
  Symmetric3<S> M;  // force for linear acceleration [kg]
};

// Of a body with nothing on it: H = [h]x, M = m 1.
template <typename S>
ArticulatedInertia<S> articulated(const RigidBodyInertia<S>& I) {
  const Vector3<S>& h = I.first_moment;
  const S zero(0);
  return {I.rotational,
          {zero, -h.z, h.y, h.z, zero, -h.x, -h.y, h.x, zero},
          {I.mass, zero, zero, I.mass, zero, I.mass}};
}

template <typename S>
ArticulatedInertia<S> add(const ArticulatedInertia<S>& a, const ArticulatedInertia<S>& b) {
  return {a.J + b.J, a.H + b.H, a.M + b.M};
}

// The wrench that accelerates it by one unit about its z, or along it: a column of the 6x6 matrix.
template <typename S>
Wrench<S> wrench_of_revolute(const ArticulatedInertia<S>& I) {
  return {{I.J.xz, I.J.yz, I.J.zz}, {I.H.zx, I.H.zy, I.H.zz}};
}

template <typename S>
Wrench<S> wrench_of_prismatic(const ArticulatedInertia<S>& I) {
  return {{I.H.xz, I.H.yz, I.H.zz}, {I.M.xz, I.M.yz, I.M.zz}};
}

// What of it the predecessor feels through a joint that is free to move: I - U U^T / D, with U the
// wrench of one unit of joint acceleration and D its component along the joint (Featherstone
// 2008, 7.32).
template <typename S>
ArticulatedInertia<S> project(const ArticulatedInertia<S>& I, const Wrench<S>& U, const S& D) {
  const Vector3<S>& n = U.moment;
  const Vector3<S>& f = U.force;
  const Vector3<S> gn = {n.x / D, n.y / D, n.z / D};
  const Vector3<S> gf = {f.x / D, f.y / D, f.z / D};
  const Symmetric3<S>& J = I.J;
  const Symmetric3<S>& M = I.M;
  const Matrix3<S>& H = I.H;
  return {{J.xx - n.x * gn.x, J.xy - n.x * gn.y, J.xz - n.x * gn.z, J.yy - n.y * gn.y,
           J.yz - n.y * gn.z, J.zz - n.z * gn.z},
          {H.xx - gn.x * f.x, H.xy - gn.x * f.y, H.xz - gn.x * f.z, H.yx - gn.y * f.x,
           H.yy - gn.y * f.y, H.yz - gn.y * f.z, H.zx - gn.z * f.x, H.zy - gn.z * f.y,
           H.zz - gn.z * f.z},
          {M.xx - f.x * gf.x, M.xy - f.x * gf.y, M.xz - f.x * gf.z, M.yy - f.y * gf.y,
           M.yz - f.y * gf.z, M.zz - f.z * gf.z}};
}

// The wrench that the predecessor feels when the joint gets the force u on top of the wrench W that
// the body needs at rest: W + U u / D. Along the axis that is u itself, unless D has a rotor's
// share.
template <typename S>
Wrench<S> project(const Wrench<S>& W, const Wrench<S>& U, const S& D, const S& u) {
  const S qdd = u / D;
  const auto share = [&](const S& unit) { return is_same(unit, D) ? u : qdd * unit; };
  return {{W.moment.x + qdd * U.moment.x, W.moment.y + qdd * U.moment.y,
           W.moment.z + share(U.moment.z)},
          {W.force.x + qdd * U.force.x, W.force.y + qdd * U.force.y, W.force.z + share(U.force.z)}};
}

// The joint's acceleration under force u while the predecessor accelerates the body with A:
// (u - U . A) / D.
template <typename S>
S joint_acceleration(const S& u, const Wrench<S>& U, const S& D, const AccelerationTwist<S>& A) {
  return (u - (dot(U.moment, A.angular) + dot(U.force, A.linear))) / D;
}

// The same seen from A and about A's origin: with P = [p]x, M_A = R M R^T, H_A = R H R^T + P M_A,
// J_A = R J R^T - (R H R^T) P + P H_A^T.
template <typename S>
ArticulatedInertia<S> transform_to_proximal(const Pose<S>& X_AB, const ArticulatedInertia<S>& I_B) {
  const Symmetric3<S> J = rotate(X_AB.R, I_B.J);
  const Matrix3<S> H = rotate(X_AB.R, I_B.H);
  const Symmetric3<S> M = rotate(X_AB.R, I_B.M);
  const Vector3<S>& p = X_AB.p;
  // P times the columns of M, and P times the rows of H_A; H times P is minus H's rows crossed with
  // p.
  const Vector3<S> x = cross(p, Vector3<S>{M.xx, M.xy, M.xz});
  const Vector3<S> y = cross(p, Vector3<S>{M.xy, M.yy, M.yz});
  const Vector3<S> z = cross(p, Vector3<S>{M.xz, M.yz, M.zz});
  const Matrix3<S> H_A = {H.xx + x.x, H.xy + y.x, H.xz + z.x, H.yx + x.y, H.yy + y.y,
                          H.yz + z.y, H.zx + x.z, H.zy + y.z, H.zz + z.z};
  const Vector3<S> hx = cross(p, Vector3<S>{H_A.xx, H_A.xy, H_A.xz});  // column x of P H_A^T
  const Vector3<S> hy = cross(p, Vector3<S>{H_A.yx, H_A.yy, H_A.yz});
  const Vector3<S> hz = cross(p, Vector3<S>{H_A.zx, H_A.zy, H_A.zz});
  const Vector3<S> rx = cross(p, Vector3<S>{H.xx, H.xy, H.xz});  // row x of -H P
  const Vector3<S> ry = cross(p, Vector3<S>{H.yx, H.yy, H.yz});
  const Vector3<S> rz = cross(p, Vector3<S>{H.zx, H.zy, H.zz});
  return {{J.xx + (rx.x + hx.x), J.xy + (rx.y + hy.x), J.xz + (rx.z + hz.x), J.yy + (ry.y + hy.y),
           J.yz + (ry.z + hz.y), J.zz + (rz.z + hz.z)},
          H_A,
          M};
}

}  // namespace sinew::math
