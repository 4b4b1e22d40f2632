#include "sinew/world/gaussian_pose.h"

#include <algorithm>
#include <cmath>

#include "sinew/world/matrix6.h"

namespace sinew::world {
namespace {

// The Lie bracket with the i-th unit twist, as a matrix: ad(xi) = [[w]x 0; [v]x [w]x].
Matrix6 bracket_with_unit(std::size_t i) {
  Matrix6 ad;
  const std::size_t axis = i % 3, y = (axis + 1) % 3, z = (axis + 2) % 3;
  // [e]x has -1 at (y, z) and +1 at (z, y).
  if (i < 3) {
    ad(y, z) = ad(y + 3, z + 3) = -1;
    ad(z, y) = ad(z + 3, y + 3) = 1;
  } else {
    ad(y + 3, z) = -1;
    ad(z + 3, y) = 1;
  }
  return ad;
}

const std::array<Matrix6, 6>& unit_brackets() {
  static const std::array<Matrix6, 6> all = [] {
    std::array<Matrix6, 6> made;
    for (std::size_t i = 0; i < 6; ++i) made[i] = bracket_with_unit(i);
    return made;
  }();
  return all;
}

// E[ad(a) ad(a)] = sum over i, j of S_ij ad(e_i) ad(e_j)
Matrix6 mean_double_bracket(const Covariance& S) {
  const auto& ad = unit_brackets();
  Matrix6 sum;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      if (S(i, j) != 0) add(sum, S(i, j), ad[i] * ad[j]);
    }
  }
  return sum;
}

// E[[a, b] [a, b]^T] = sum over i, j of Sa_ij ad(e_i) Sb ad(e_j)^T
Matrix6 bracket_covariance(const Covariance& Sa, const Covariance& Sb) {
  const auto& ad = unit_brackets();
  Matrix6 sum;
  for (std::size_t i = 0; i < 6; ++i) {
    const Matrix6 left = ad[i] * Sb;
    for (std::size_t j = 0; j < 6; ++j) {
      if (Sa(i, j) != 0) add(sum, Sa(i, j), left * transpose(ad[j]));
    }
  }
  return sum;
}

// The covariance of log(exp(a) exp(b)).
Covariance of_product(const Covariance& Sa, const Covariance& Sb, Order order) {
  Covariance S = Sa;
  add(S, 1, Sb);
  if (order == Order::kFourth) {
    // log = a + b + [a, b] / 2 + [a, [a, b]] / 12 + [b, [b, a]] / 12 + ...; odd moments vanish.
    const Matrix6 Pa = mean_double_bracket(Sa) * Sb, Pb = mean_double_bracket(Sb) * Sa;
    add(S, 1.0 / 4, bracket_covariance(Sa, Sb));
    add(S, 1.0 / 12, Pa);
    add(S, 1.0 / 12, transpose(Pa));
    add(S, 1.0 / 12, Pb);
    add(S, 1.0 / 12, transpose(Pb));
  }
  return symmetric(S);
}

}  // namespace

Covariance isotropic(double angular_deviation_rad, double linear_deviation_m) {
  Covariance S;
  for (std::size_t i = 0; i < 3; ++i) {
    S(i, i) = angular_deviation_rad * angular_deviation_rad;
    S(i + 3, i + 3) = linear_deviation_m * linear_deviation_m;
  }
  return S;
}

bool is_covariance(const Covariance& S) {
  double largest = 0;
  for (const double entry : S.entries) {
    if (!std::isfinite(entry)) return false;
    largest = std::max(largest, std::abs(entry));
  }
  const double tolerance = kSymmetryTolerance * largest;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (std::abs(S(i, j) - S(j, i)) > tolerance) return false;
    }
  }
  // LDL^T, the largest pivot first. Where it is nothing, all that remains has to be nothing.
  Matrix6 rest = S;
  std::array<bool, 6> done = {};
  for (int step = 0; step < 6; ++step) {
    std::size_t pivot = 6;
    for (std::size_t i = 0; i < 6; ++i) {
      if (!done[i] && (pivot == 6 || rest(i, i) > rest(pivot, pivot))) pivot = i;
    }
    done[pivot] = true;
    const double d = rest(pivot, pivot);
    for (std::size_t i = 0; i < 6; ++i) {
      if (done[i]) continue;
      if (rest(i, i) < -tolerance) return false;
      if (d <= tolerance && std::abs(rest(i, pivot)) > tolerance) return false;
    }
    if (d < -tolerance) return false;
    if (d <= tolerance) continue;
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) {
        if (!done[i] && !done[j]) rest(i, j) -= rest(i, pivot) * rest(pivot, j) / d;
      }
    }
  }
  return true;
}

Covariance seen_from(const Pose& X_AB, const Covariance& S_B) {
  const Matrix6 ad = adjoint(X_AB);
  return symmetric(ad * S_B * transpose(ad));
}

GaussianPose compose(const GaussianPose& X_AB, const GaussianPose& X_BC, Order order) {
  return {compose(X_AB.mean, X_BC.mean),
          of_product(seen_from(invert(X_BC.mean), X_AB.covariance), X_BC.covariance, order)};
}

GaussianPose invert(const GaussianPose& X_AB) {
  return {invert(X_AB.mean), seen_from(X_AB.mean, X_AB.covariance)};
}

GaussianPose compose(const Pose& X_AB, const GaussianPose& X_BC) {
  return {compose(X_AB, X_BC.mean), X_BC.covariance};
}

GaussianPose compose(const GaussianPose& X_AB, const Pose& X_BC) {
  return {compose(X_AB.mean, X_BC), seen_from(invert(X_BC), X_AB.covariance)};
}

}  // namespace sinew::world
