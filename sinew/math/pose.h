// Poses: X_AB is the pose of frame B in frame A, that is p_A = R p_B + p. The columns of R are B's
// axes seen from A, and p is B's origin seen from A [m].
#pragma once

#include "sinew/math/vector.h"

namespace sinew::math {

template <typename S>
struct Pose {
  Matrix3<S> R;
  Vector3<S> p;
};

// X_AC = X_AB X_BC
template <typename S>
Pose<S> compose(const Pose<S>& X_AB, const Pose<S>& X_BC) {
  return {X_AB.R * X_BC.R, X_AB.R * X_BC.p + X_AB.p};
}

// X_BA = X_AB^-1
template <typename S>
Pose<S> invert(const Pose<S>& X_AB) {
  return {transpose(X_AB.R), -transpose_times(X_AB.R, X_AB.p)};
}

}  // namespace sinew::math
