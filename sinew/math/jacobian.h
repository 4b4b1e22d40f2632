// Columns of geometric Jacobians: the twist of a point for one unit of a joint's velocity.
#pragma once

#include "sinew/math/pose.h"
#include "sinew/math/twist.h"

namespace sinew::math {

// Seen from R, of the origin of frame B, for a joint about z of frame C: (z, z x (p_B - p_C)).
template <typename S>
VelocityTwist<S> jacobian_column_revolute(const Pose<S>& X_RC, const Pose<S>& X_RB) {
  const Vector3<S> z = {X_RC.R.xz, X_RC.R.yz, X_RC.R.zz};
  return {z, cross(z, X_RB.p - X_RC.p)};
}

// For a joint along z of frame C: (0, z).
template <typename S>
VelocityTwist<S> jacobian_column_prismatic(const Pose<S>& X_RC, const Pose<S>&) {
  return {{S(0), S(0), S(0)}, {X_RC.R.xz, X_RC.R.yz, X_RC.R.zz}};
}

}  // namespace sinew::math
