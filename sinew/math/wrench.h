// Wrenches: a moment about the origin of the frame from which they are seen [N m], and a force [N].
#pragma once

#include "sinew/math/pose.h"

namespace sinew::math {

template <typename S>
struct Wrench {
  Vector3<S> moment;  // n [N m]
  Vector3<S> force;   // f [N]
};

// The same wrench seen from A and about A's origin: f_A = R f_B, n_A = R n_B + p x f_A.
template <typename S>
Wrench<S> transform_to_proximal(const Pose<S>& X_AB, const Wrench<S>& W_B) {
  const Vector3<S> f = X_AB.R * W_B.force;
  return {X_AB.R * W_B.moment + cross(X_AB.p, f), f};
}

// Sum of wrenches that are seen from the same frame.
template <typename S>
Wrench<S> add(const Wrench<S>& a, const Wrench<S>& b) {
  return {a.moment + b.moment, a.force + b.force};
}

// The same wrench, about the same point, seen from other directions: from B to A, and from A to B.
template <typename S>
Wrench<S> rotate_to_proximal(const Pose<S>& X_AB, const Wrench<S>& W_B) {
  return {X_AB.R * W_B.moment, X_AB.R * W_B.force};
}

template <typename S>
Wrench<S> rotate_to_distal(const Pose<S>& X_AB, const Wrench<S>& W_A) {
  return {transpose_times(X_AB.R, W_A.moment), transpose_times(X_AB.R, W_A.force)};
}

}  // namespace sinew::math
