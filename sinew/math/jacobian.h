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

// The six columns of a floating base, whose velocity is seen from itself: angular ones (R_k, R_k x
// r) with r = p_B - p_C, then linear ones (0, R_k).
template <typename S>
struct JacobianBlock {
  VelocityTwist<S> columns[6];
};

template <typename S>
JacobianBlock<S> jacobian_columns_floating(const Pose<S>& X_RC, const Pose<S>& X_RB) {
  const Matrix3<S>& R = X_RC.R;
  const Vector3<S> axes[3] = {{R.xx, R.yx, R.zx}, {R.xy, R.yy, R.zy}, {R.xz, R.yz, R.zz}};
  const Vector3<S> r = X_RB.p - X_RC.p;
  JacobianBlock<S> block;
  for (int k = 0; k < 3; ++k) {
    block.columns[k] = {axes[k], cross(axes[k], r)};
    block.columns[3 + k] = {{S(0), S(0), S(0)}, axes[k]};
  }
  return block;
}

}  // namespace sinew::math
