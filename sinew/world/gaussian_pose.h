// Uncertain poses: a Gaussian on SE(3), X_AB = mean exp(xi) with xi normal about zero, a twist seen
// from B, angular first: (rx ry rz, x y z) in rad and m.
//
// Covariances are carried to other frames by the adjoint, Ad(X_AB) = [R 0; [p]x R  R] for this
// order of the numbers: the twist seen from A, of which the one seen from B is xi, is Ad(X_AB) xi.
//
//   frame change   X exp(xi) = exp(Ad(X) xi) X, hence S_A = Ad(X_AB) S_B Ad(X_AB)^T
//   inversion      (X exp(xi))^-1 = X^-1 exp(-Ad(X) xi), hence the same
//   composition    X1 exp(a) X2 exp(b) = X1 X2 exp(a') exp(b) with a' = Ad(X2^-1) a, and
//                  exp(a') exp(b) by the Baker-Campbell-Hausdorff series: to second order
//                  S = S_a' + S_b; to fourth order the terms of Barfoot and Furgale 2014
//                  ("Associating uncertainty with three-dimensional poses for use in estimation
//                  problems", IEEE T-RO 30(3), section IV), with a and b independent.
#pragma once

#include <array>
#include <cstddef>

#include "sinew/world/pose.h"

namespace sinew::world {

// Six by six, by rows; symmetric.
struct Covariance {
  std::array<double, 36> entries = {};
  double& operator()(std::size_t row, std::size_t column) { return entries[6 * row + column]; }
  double operator()(std::size_t row, std::size_t column) const { return entries[6 * row + column]; }
};

// Equal deviations about and along the three axes, without correlation.
Covariance isotropic(double angular_deviation_rad, double linear_deviation_m);
// Whether all is finite, it is symmetric to kSymmetryTolerance (relative to its largest entry), and
// no variance along any axis is negative beyond that tolerance (by an LDL^T decomposition).
inline constexpr double kSymmetryTolerance = 1e-9;
bool is_covariance(const Covariance& S);

struct GaussianPose {
  Pose mean;              // X_AB
  Covariance covariance;  // seen from B
};

enum class Order { kSecond, kFourth };

// X_AC of X_AB and X_BC, which are independent.
GaussianPose compose(const GaussianPose& X_AB, const GaussianPose& X_BC,
                     Order order = Order::kFourth);
GaussianPose invert(const GaussianPose& X_AB);
// With one of the two exactly known.
GaussianPose compose(const Pose& X_AB, const GaussianPose& X_BC);
GaussianPose compose(const GaussianPose& X_AB, const Pose& X_BC);

// The covariance of the same twist seen from A instead of from B.
Covariance seen_from(const Pose& X_AB, const Covariance& S_B);

}  // namespace sinew::world
