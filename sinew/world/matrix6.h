// Six by six matrices for the module's own functions on uncertain poses: twists and covariances in
// the order and with the frames of gaussian_pose.h.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "sinew/world/gaussian_pose.h"

namespace sinew::world {

using Matrix6 = Covariance;
using Vector6 = std::array<double, 6>;

inline Matrix6 operator*(const Matrix6& a, const Matrix6& b) {
  Matrix6 c;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < 6; ++k) {
      for (std::size_t j = 0; j < 6; ++j) c(i, j) += a(i, k) * b(k, j);
    }
  }
  return c;
}

inline Vector6 operator*(const Matrix6& a, const Vector6& x) {
  Vector6 y = {};
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) y[i] += a(i, j) * x[j];
  }
  return y;
}

inline Matrix6 transpose(const Matrix6& a) {
  Matrix6 t;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) t(j, i) = a(i, j);
  }
  return t;
}

// a += scale b
inline void add(Matrix6& a, double scale, const Matrix6& b) {
  for (std::size_t i = 0; i < 36; ++i) a.entries[i] += scale * b.entries[i];
}

// a += scale x x^T
inline void add_square(Matrix6& a, double scale, const Vector6& x) {
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) a(i, j) += scale * x[i] * x[j];
  }
}

// Rounding must not make it less symmetric with every step.
inline Matrix6 symmetric(const Matrix6& a) {
  Matrix6 s;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) s(i, j) = 0.5 * (a(i, j) + a(j, i));
  }
  return s;
}

// Ad(X) = [R 0; [p]x R  R]
inline Matrix6 adjoint(const Pose& X) {
  Matrix6 ad;
  const Vector3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (std::size_t j = 0; j < 3; ++j) {
    const Vector3 r = rotate(X.q, axes[j]);
    const Vector3 m = math::cross(X.p, r);
    ad(0, j) = ad(3, j + 3) = r.x;
    ad(1, j) = ad(4, j + 3) = r.y;
    ad(2, j) = ad(5, j + 3) = r.z;
    ad(3, j) = m.x;
    ad(4, j) = m.y;
    ad(5, j) = m.z;
  }
  return ad;
}

inline Vector6 numbers_of(const Twist& xi) {
  return {xi.angular.x, xi.angular.y, xi.angular.z, xi.linear.x, xi.linear.y, xi.linear.z};
}
inline Twist twist_of(const Vector6& xi) { return {{xi[0], xi[1], xi[2]}, {xi[3], xi[4], xi[5]}}; }

// The twist that leads from one pose to another, seen from the first: log(from^-1 to).
inline Vector6 between(const Pose& from, const Pose& to) {
  return numbers_of(logarithm(compose(invert(from), to)));
}

// The J with log(exp(d) exp(xi)) = d + J xi + O(xi^2): the inverse of the right Jacobian of SE(3).
Matrix6 after_displacement(const Vector6& d);

// L with S = L L^T, for any covariance, also one without full rank.
Matrix6 root_of(const Covariance& S);

// Of a covariance that was widened (see kNarrowest): log of its determinant, and x^T S^-1 x.
struct Factored {
  explicit Factored(const Covariance& S);
  double log_determinant() const;
  double square_length(const Vector6& x) const;
  Matrix6 L;  // lower triangular
};

// What is exact has no density. Where one is needed, every axis counts as uncertain by this much
// [rad or m] at least: far below what sensors tell, far above rounding.
inline constexpr double kNarrowest = 1e-6;

}  // namespace sinew::world
