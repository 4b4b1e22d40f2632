// Magnitudes of constraint forces: L x = r, where L is symmetric and positive semidefinite (the
// acceleration that each unit constraint force causes along each constraint), and what is to happen
// where L is singular. Fixed work, no branches on values; the result is always a number.
//
// All of them first scale each constraint so that its own entry of L is 1, which makes tolerances
// free of units: x_i = s_i y_i, r_i -> s_i r_i, L_ij -> s_i L_ij s_j, s_i = 1 / sqrt(L_ii). A
// constraint whose entry is zero cannot be moved by anything; its magnitude is 0.
#pragma once

#include <cmath>

#include "sinew/math/select.h"

namespace sinew::math {

// Sizes of the tables on the stack: so many constraints at most.
inline constexpr int kMostConstraints = 24;
// The eigenvalue iteration's work grows with the cube of their number.
inline constexpr int kMostTruncatedConstraints = 12;
// Cyclic Jacobi iteration converges quadratically; for up to 12 rows, 8 passes leave less than
// round-off.
inline constexpr int kJacobiPasses = 8;

template <typename S>
struct ConstraintSystem {
  int count = 0;
  S L[kMostConstraints][kMostConstraints];  // the lower triangle counts
  S r[kMostConstraints];
};

// One by one in their order, by elimination (L D L^T): a constraint of which less than `tolerance`
// is left once those before it are met is dropped, and its magnitude is 0. Earlier ones win.
template <typename S>
void solve_in_order(ConstraintSystem<S>& system, const S& tolerance, S* x) {
  const int n = system.count;
  auto& L = system.L;
  S inverse[kMostConstraints], own[kMostConstraints];
  const S zero(0), one(1);
  for (int k = 0; k < n; ++k) own[k] = tolerance * L[k][k];
  for (int k = 0; k < n; ++k) {
    // The divisor is never zero, also where its quotient is not taken.
    const S pivot = select_less(own[k], L[k][k], L[k][k], one);
    inverse[k] = select_less(own[k], L[k][k], one / pivot, zero);
    for (int i = k + 1; i < n; ++i) {
      const S l = L[i][k] * inverse[k];
      for (int j = k + 1; j <= i; ++j) L[i][j] = L[i][j] - l * L[j][k];
      system.r[i] = system.r[i] - l * system.r[k];
    }
  }
  for (int k = n - 1; k >= 0; --k) {
    x[k] = system.r[k];
    for (int i = k + 1; i < n; ++i) x[k] = x[k] - L[i][k] * x[i];
    x[k] = x[k] * inverse[k];
  }
}

// Unit diagonal; returns the scales.
template <typename S>
void scale_to_unit_diagonal(ConstraintSystem<S>& system, S* scale) {
  using std::sqrt;
  const int n = system.count;
  const S zero(0), one(1);
  for (int i = 0; i < n; ++i) {
    const S root = sqrt(select_less(zero, system.L[i][i], system.L[i][i], one));
    scale[i] = select_less(zero, system.L[i][i], one / root, zero);
  }
  for (int i = 0; i < n; ++i) {
    system.r[i] = scale[i] * system.r[i];
    for (int j = 0; j < i; ++j) system.L[i][j] = scale[i] * system.L[i][j] * scale[j];
    system.L[i][i] = scale[i] * system.L[i][i] * scale[i];
    for (int j = 0; j < i; ++j) system.L[j][i] = system.L[i][j];
  }
}

// Damped least squares (Wampler 1986, Nakamura and Hanafusa 1986): the y that makes
// |L y - r|^2 + damping^2 |y|^2 smallest, (L L + damping^2 1) y = L r.
template <typename S>
void solve_damped(ConstraintSystem<S>& system, const S& damping, S* x) {
  S scale[kMostConstraints];
  scale_to_unit_diagonal(system, scale);
  const int n = system.count;
  ConstraintSystem<S> normal;
  normal.count = n;
  for (int i = 0; i < n; ++i) {
    normal.r[i] = S(0);
    for (int k = 0; k < n; ++k) normal.r[i] = normal.r[i] + system.L[i][k] * system.r[k];
    for (int j = 0; j <= i; ++j) {
      normal.L[i][j] = i == j ? damping * damping : S(0);
      for (int k = 0; k < n; ++k) normal.L[i][j] = normal.L[i][j] + system.L[i][k] * system.L[k][j];
    }
  }
  solve_in_order(normal, S(0), x);
  for (int i = 0; i < n; ++i) x[i] = scale[i] * x[i];
}

// The smallest of the x that come nearest: along the directions (eigenvectors of the scaled L)
// whose eigenvalue is not above `tolerance`, x is 0. Eigenvalues by Jacobi's rotations (Golub and
// Van Loan 2013, section 8.5) that are applied to r on the way and undone on the way back.
template <typename S>
void solve_truncated(ConstraintSystem<S>& system, const S& tolerance, S* x) {
  using std::sqrt;
  S scale[kMostConstraints];
  scale_to_unit_diagonal(system, scale);
  const int n = system.count;
  auto& A = system.L;
  S* const r = system.r;
  constexpr int kMostRotations =
      kJacobiPasses * kMostTruncatedConstraints * (kMostTruncatedConstraints - 1) / 2;
  S cosine[kMostRotations], sine[kMostRotations];
  const S zero(0), one(1);
  int at = 0;
  for (int pass = 0; pass < kJacobiPasses; ++pass) {
    for (int p = 0; p < n; ++p) {
      for (int q = p + 1; q < n; ++q, ++at) {
        const S h = A[q][q] - A[p][p];
        const S g = S(2) * A[p][q];
        const S size = select_less(h, zero, -h, h) + sqrt(h * h + g * g);
        const S t = select_less(h, zero, -g, g) / select_less(zero, size, size, one);
        const S c = one / sqrt(t * t + one);
        const S s = t * c;
        cosine[at] = c, sine[at] = s;
        A[p][p] = A[p][p] - t * A[p][q];
        A[q][q] = A[q][q] + t * A[p][q];
        A[p][q] = A[q][p] = zero;
        for (int k = 0; k < n; ++k) {
          if (k == p || k == q) continue;
          const S kp = A[k][p], kq = A[k][q];
          A[k][p] = A[p][k] = c * kp - s * kq;
          A[k][q] = A[q][k] = s * kp + c * kq;
        }
        const S rp = r[p], rq = r[q];
        r[p] = c * rp - s * rq;
        r[q] = s * rp + c * rq;
      }
    }
  }
  for (int i = 0; i < n; ++i) {
    const S value = select_less(tolerance, A[i][i], A[i][i], one);
    x[i] = select_less(tolerance, A[i][i], r[i] / value, zero);
  }
  for (int pass = 0; pass < kJacobiPasses; ++pass) {
    for (int p = n - 1; p >= 0; --p) {
      for (int q = n - 1; q > p; --q) {
        --at;
        const S xp = x[p], xq = x[q];
        x[p] = cosine[at] * xp + sine[at] * xq;
        x[q] = cosine[at] * xq - sine[at] * xp;
      }
    }
  }
  for (int i = 0; i < n; ++i) x[i] = scale[i] * x[i];
}

}  // namespace sinew::math
