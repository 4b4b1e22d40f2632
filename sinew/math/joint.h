// Joints of one degree of freedom, between a predecessor frame and a successor frame that coincide
// at position zero and have their z on the joint's axis. q [rad or m], its derivatives, and the
// force along the axis [N m or N].
#pragma once

#include <cmath>

#include "sinew/math/pose.h"
#include "sinew/math/twist.h"
#include "sinew/math/wrench.h"

namespace sinew::math {

// Pose of the successor in the predecessor: a rotation about z.
template <typename S>
Pose<S> revolute_pose(const S& q) {
  using std::cos;
  using std::sin;
  const S s = sin(q);
  const S c = cos(q);
  return {{c, -s, S(0), s, c, S(0), S(0), S(0), S(1)}, {S(0), S(0), S(0)}};
}

// Pose of the successor in the predecessor: a translation along z.
template <typename S>
Pose<S> prismatic_pose(const S& q) {
  return {{S(1), S(0), S(0), S(0), S(1), S(0), S(0), S(0), S(1)}, {S(0), S(0), q}};
}

// Velocity of the successor with respect to the predecessor, seen from the successor.
template <typename S>
VelocityTwist<S> revolute_velocity(const S& qd) {
  return {{S(0), S(0), qd}, {S(0), S(0), S(0)}};
}

template <typename S>
VelocityTwist<S> prismatic_velocity(const S& qd) {
  return {{S(0), S(0), S(0)}, {S(0), S(0), qd}};
}

// The part of the successor's acceleration that the joint's acceleration makes, seen from the
// successor.
template <typename S>
AccelerationTwist<S> revolute_acceleration(const S& qdd) {
  return {{S(0), S(0), qdd}, {S(0), S(0), S(0)}};
}

template <typename S>
AccelerationTwist<S> prismatic_acceleration(const S& qdd) {
  return {{S(0), S(0), S(0)}, {S(0), S(0), qdd}};
}

// The joint force that balances a wrench on the successor, seen from the successor (or
// predecessor).
template <typename S>
S revolute_force(const Wrench<S>& W) {
  return W.moment.z;
}

template <typename S>
S prismatic_force(const Wrench<S>& W) {
  return W.force.z;
}

}  // namespace sinew::math
