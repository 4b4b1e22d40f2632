#include "sinew/world/matrix6.h"

#include <algorithm>

namespace sinew::world {
namespace {

// ad(d) = [[w]x 0; [v]x [w]x]
Matrix6 bracket_with(const Vector6& d) {
  Matrix6 ad;
  const auto cross = [&](std::size_t row, std::size_t column, std::size_t from) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t y = (axis + 1) % 3, z = (axis + 2) % 3;
      ad(row + y, column + z) = -d[from + axis];
      ad(row + z, column + y) = d[from + axis];
    }
  };
  cross(0, 0, 0);
  cross(3, 3, 0);
  cross(3, 0, 3);
  return ad;
}

Matrix6 identity() {
  Matrix6 one;
  for (std::size_t i = 0; i < 6; ++i) one(i, i) = 1;
  return one;
}

// Gauss-Jordan with row pivoting; precondition: regular.
Matrix6 inverse(Matrix6 a) {
  Matrix6 result = identity();
  for (std::size_t column = 0; column < 6; ++column) {
    std::size_t pivot = column;
    for (std::size_t i = column; i < 6; ++i) {
      if (std::abs(a(i, column)) > std::abs(a(pivot, column))) pivot = i;
    }
    for (std::size_t j = 0; j < 6; ++j) {
      std::swap(a(column, j), a(pivot, j));
      std::swap(result(column, j), result(pivot, j));
    }
    const double scale = 1 / a(column, column);
    for (std::size_t j = 0; j < 6; ++j) a(column, j) *= scale, result(column, j) *= scale;
    for (std::size_t i = 0; i < 6; ++i) {
      if (i == column) continue;
      const double share = a(i, column);
      for (std::size_t j = 0; j < 6; ++j) {
        a(i, j) -= share * a(column, j);
        result(i, j) -= share * result(column, j);
      }
    }
  }
  return result;
}

}  // namespace

Matrix6 after_displacement(const Vector6& d) {
  // J_r = sum over n of (-ad(d))^n / (n + 1)!: entire, and below rounding after this many terms for
  // angles up to pi, which logarithms do not exceed. Regular there: it is singular at 2 pi first.
  constexpr int kTerms = 30;
  const Matrix6 ad = bracket_with(d);
  Matrix6 term = identity(), sum = identity();
  for (int n = 1; n < kTerms; ++n) {
    Matrix6 next = term * ad;
    for (double& entry : next.entries) entry /= -(n + 1);
    term = next;
    add(sum, 1, term);
  }
  return inverse(sum);
}

Matrix6 root_of(const Covariance& S) {
  // Cholesky's, the largest pivot first; it ends where nothing is left.
  Matrix6 L, rest = S;
  double largest = 0;
  for (std::size_t i = 0; i < 6; ++i) largest = std::max(largest, S(i, i));
  std::array<bool, 6> done = {};
  for (std::size_t column = 0; column < 6; ++column) {
    std::size_t pivot = 6;
    for (std::size_t i = 0; i < 6; ++i) {
      if (!done[i] && (pivot == 6 || rest(i, i) > rest(pivot, pivot))) pivot = i;
    }
    done[pivot] = true;
    if (rest(pivot, pivot) <= 1e-15 * largest) break;
    const double root = std::sqrt(rest(pivot, pivot));
    for (std::size_t i = 0; i < 6; ++i) L(i, column) = rest(i, pivot) / root;
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) rest(i, j) -= L(i, column) * L(j, column);
    }
  }
  return L;
}

Factored::Factored(const Covariance& S) {
  Matrix6 widened = S;
  for (std::size_t i = 0; i < 6; ++i) widened(i, i) += kNarrowest * kNarrowest;
  for (std::size_t j = 0; j < 6; ++j) {
    for (std::size_t i = j; i < 6; ++i) {
      double sum = widened(i, j);
      for (std::size_t k = 0; k < j; ++k) sum -= L(i, k) * L(j, k);
      // Rounding of what has no full rank may leave less than was added.
      L(i, j) = i == j ? std::sqrt(std::max(sum, kNarrowest * kNarrowest)) : sum / L(j, j);
    }
  }
}

double Factored::log_determinant() const {
  double sum = 0;
  for (std::size_t i = 0; i < 6; ++i) sum += 2 * std::log(L(i, i));
  return sum;
}

double Factored::square_length(const Vector6& x) const {
  Vector6 y = {};
  double sum = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    double value = x[i];
    for (std::size_t k = 0; k < i; ++k) value -= L(i, k) * y[k];
    y[i] = value / L(i, i);
    sum += y[i] * y[i];
  }
  return sum;
}

}  // namespace sinew::world
