// Momentum, energy and centre of mass of rigid bodies.
#pragma once

#include "sinew/math/inertia.h"

namespace sinew::math {

// Angular momentum about the frame's origin [kg m^2/s], and linear momentum [kg m/s].
template <typename S>
struct Momentum {
  Vector3<S> angular;
  Vector3<S> linear;
};

// L = I w + h x v, p = m v + w x h
template <typename S>
Momentum<S> momentum(const RigidBodyInertia<S>& I, const VelocityTwist<S>& V) {
  const Symmetric3<S>& J = I.rotational;
  const Vector3<S>& w = V.angular;
  const Vector3<S> Iw = {J.xx * w.x + J.xy * w.y + J.xz * w.z, J.xy * w.x + J.yy * w.y + J.yz * w.z,
                         J.xz * w.x + J.yz * w.y + J.zz * w.z};
  return {Iw + cross(I.first_moment, V.linear), I.mass * V.linear + cross(w, I.first_moment)};
}

// The same momentum seen from A and about A's origin: p_A = R p_B, L_A = R L_B + p x p_A.
template <typename S>
Momentum<S> transform_to_proximal(const Pose<S>& X_AB, const Momentum<S>& P_B) {
  const Vector3<S> linear = X_AB.R * P_B.linear;
  return {X_AB.R * P_B.angular + cross(X_AB.p, linear), linear};
}

template <typename S>
Momentum<S> add(const Momentum<S>& a, const Momentum<S>& b) {
  return {a.angular + b.angular, a.linear + b.linear};
}

// (w . L + v . p) / 2
template <typename S>
S kinetic_energy(const VelocityTwist<S>& V, const Momentum<S>& P) {
  return S(0.5) * (dot(V.angular, P.angular) + dot(V.linear, P.linear));
}

// -g . h, where the root accelerates with a = -g as seen from free fall; zero at the frame's
// origin.
template <typename S>
S potential_energy(const RigidBodyInertia<S>& I, const AccelerationTwist<S>& A) {
  return dot(A.linear, I.first_moment);
}

template <typename S>
Vector3<S> center_of_mass(const RigidBodyInertia<S>& I) {
  return {I.first_moment.x / I.mass, I.first_moment.y / I.mass, I.first_moment.z / I.mass};
}

// Of what has this momentum and this inertia: p / m.
template <typename S>
Vector3<S> center_of_mass_velocity(const RigidBodyInertia<S>& I, const Momentum<S>& P) {
  return {P.linear.x / I.mass, P.linear.y / I.mass, P.linear.z / I.mass};
}

// The velocity of the centre of all mass, seen from R, for one unit of velocity of a joint about,
// or along, z of frame C that moves the inertia I (seen from C): R (z x h) / m_total, and z m /
// m_total.
template <typename S>
Vector3<S> center_of_mass_column_revolute(const Pose<S>& X_RC, const RigidBodyInertia<S>& I,
                                          const RigidBodyInertia<S>& total) {
  const Vector3<S> v = {-I.first_moment.y / total.mass, I.first_moment.x / total.mass, S(0)};
  return X_RC.R * v;
}

template <typename S>
Vector3<S> center_of_mass_column_prismatic(const Pose<S>& X_RC, const RigidBodyInertia<S>& I,
                                           const RigidBodyInertia<S>& total) {
  return (I.mass / total.mass) * Vector3<S>{X_RC.R.xz, X_RC.R.yz, X_RC.R.zz};
}

// The six columns of a floating base: R (e_k x h) / m_total, then R e_k m / m_total.
template <typename S>
struct LinearBlock {
  Vector3<S> columns[6];
};

template <typename S>
LinearBlock<S> center_of_mass_columns_floating(const Pose<S>& X_RC, const RigidBodyInertia<S>& I,
                                               const RigidBodyInertia<S>& total) {
  const Matrix3<S>& R = X_RC.R;
  const Vector3<S> axes[3] = {{R.xx, R.yx, R.zx}, {R.xy, R.yy, R.zy}, {R.xz, R.yz, R.zz}};
  const Vector3<S> h = R * I.first_moment;
  LinearBlock<S> block;
  for (int k = 0; k < 3; ++k) {
    const Vector3<S> v = cross(axes[k], h);
    block.columns[k] = {v.x / total.mass, v.y / total.mass, v.z / total.mass};
    block.columns[3 + k] = (I.mass / total.mass) * axes[k];
  }
  return block;
}

// The same momentum about another point, which is at c seen from the frame: L - c x p.
template <typename S>
Momentum<S> about(const Momentum<S>& P, const Vector3<S>& c) {
  return {P.angular - cross(c, P.linear), P.linear};
}

// The momentum of all mass about its centre c, seen from R, for one unit of velocity of a joint
// about, or along, z of frame C that moves the inertia I (seen from C). Orin and Goswami 2008,
// "Centroidal momentum matrix of a humanoid robot".
template <typename S>
Momentum<S> centroidal_momentum_column_revolute(const Pose<S>& X_RC, const RigidBodyInertia<S>& I,
                                                const Vector3<S>& c) {
  const Vector3<S>& h = I.first_moment;
  const Symmetric3<S>& J = I.rotational;
  const Vector3<S> linear = X_RC.R * Vector3<S>{-h.y, h.x, S(0)};
  return {X_RC.R * Vector3<S>{J.xz, J.yz, J.zz} + cross(X_RC.p - c, linear), linear};
}

template <typename S>
Momentum<S> centroidal_momentum_column_prismatic(const Pose<S>& X_RC, const RigidBodyInertia<S>& I,
                                                 const Vector3<S>& c) {
  const Vector3<S>& h = I.first_moment;
  const Vector3<S> linear = I.mass * Vector3<S>{X_RC.R.xz, X_RC.R.yz, X_RC.R.zz};
  return {X_RC.R * Vector3<S>{h.y, -h.x, S(0)} + cross(X_RC.p - c, linear), linear};
}

// Six of them, of a floating base.
template <typename S>
struct MomentumBlock {
  Momentum<S> columns[6];
};

template <typename S>
MomentumBlock<S> centroidal_momentum_columns_floating(const Pose<S>& X_RC,
                                                      const RigidBodyInertia<S>& I,
                                                      const Vector3<S>& c) {
  const S zero(0), one(1);
  const Vector3<S> none = {zero, zero, zero};
  const Vector3<S> axes[3] = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
  MomentumBlock<S> block;
  for (int k = 0; k < 3; ++k) {
    block.columns[k] =
        about(transform_to_proximal(X_RC, momentum(I, VelocityTwist<S>{axes[k], none})), c);
    block.columns[3 + k] =
        about(transform_to_proximal(X_RC, momentum(I, VelocityTwist<S>{none, axes[k]})), c);
  }
  return block;
}

}  // namespace sinew::math
