// Joints of several degrees of freedom, and numbers that depend on each other: the pose of a
// spherical or floating joint, coupled coordinates, and the mass matrix' factors.
#pragma once

#include <cmath>

#include "sinew/math/floating.h"

namespace sinew::math {

// A unit quaternion: how the successor is turned in the predecessor.
template <typename S>
struct SphericalPosition {
  Vector3<S> v;  // vector part
  S w{};         // scalar part
};

// A spherical or floating joint is made of turns and slides about and along the successor's axes.
// The first one carries the whole pose; its frames are turned so that z is the joint's x: with the
// turn P of x to y, y to z, z to x, P^T X P.
template <typename S>
Pose<S> first_part_pose(const FloatingPosition<S>& q) {
  return floating_pose(FloatingPosition<S>{{q.p.y, q.p.z, q.p.x}, {q.v.y, q.v.z, q.v.x}, q.w});
}

template <typename S>
Pose<S> first_part_pose(const SphericalPosition<S>& q) {
  return first_part_pose(FloatingPosition<S>{{S(0), S(0), S(0)}, q.v, q.w});
}

// The lower triangular L of M = L^T L, in place of M (n x n, row by row; above the diagonal zeros).
// From the last joint to the first, so that an entry of joints on different branches stays zero
// (Featherstone 2008, table 6.3).
template <typename S>
void factorise_mass_matrix(S* M, int n) {
  using std::sqrt;
  for (int k = n - 1; k >= 0; --k) {
    M[k * n + k] = sqrt(M[k * n + k]);
    for (int i = 0; i < k; ++i) M[k * n + i] = M[k * n + i] / M[k * n + k];
    for (int i = 0; i < k; ++i)
      for (int j = 0; j <= i; ++j) M[i * n + j] = M[i * n + j] - M[k * n + i] * M[k * n + j];
    for (int i = k + 1; i < n; ++i) M[k * n + i] = S(0);
  }
}

// M = L^T D L with 1 on the diagonal of L (the same, without square roots), in place of M: L below
// the diagonal, D on it. Above it M stays.
template <typename S>
void decompose_mass_matrix(S* M, int n) {
  for (int k = n - 1; k >= 0; --k) {
    for (int i = k - 1; i >= 0; --i) {
      const S a = M[k * n + i] / M[k * n + k];
      for (int j = i; j >= 0; --j) M[i * n + j] = M[i * n + j] - a * M[k * n + j];
      M[k * n + i] = a;
    }
  }
}

// x = L^-T x: of forces of all coordinates, what drives each one while those after it give way.
template <typename S>
void drive_decomposed(const S* M, int n, S* x) {
  for (int k = n - 1; k >= 0; --k)
    for (int i = 0; i < k; ++i) x[i] = x[i] - M[k * n + i] * x[k];
}

// x = L^-1 D^-1 x: the accelerations, from what drives each coordinate.
template <typename S>
void accelerate_decomposed(const S* M, int n, S* x) {
  for (int k = 0; k < n; ++k) {
    x[k] = x[k] / M[k * n + k];
    for (int i = 0; i < k; ++i) x[k] = x[k] - M[k * n + i] * x[i];
  }
}

// x = M^-1 x, with the L and D of M.
template <typename S>
void solve_decomposed(const S* M, int n, S* x) {
  drive_decomposed(M, n, x);
  accelerate_decomposed(M, n, x);
}

// x^T D^-1 y of two drives: the acceleration energy of one along the other.
template <typename S>
S energy_decomposed(const S* M, int n, const S* x, const S* y) {
  S sum(0);
  for (int k = 0; k < n; ++k) sum = sum + x[k] * (y[k] / M[k * n + k]);
  return sum;
}

// The n x n matrix G^T (M + diag(rotor)) G of m coordinates from that of n joints; G is n x m.
template <typename S>
void couple_mass_matrix(const S* M, const S* G, const S* rotor, int n, int m, S* out) {
  for (int a = 0; a < m; ++a) {
    for (int b = 0; b < m; ++b) {
      S sum(0);
      for (int i = 0; i < n; ++i) {
        S row = rotor[i] * G[i * m + b];
        for (int j = 0; j < n; ++j) row = row + M[i * n + j] * G[j * m + b];
        sum = sum + G[i * m + a] * row;
      }
      out[a * m + b] = sum;
    }
  }
}

// J G for a matrix of n columns; G is n x m.
template <typename S>
void couple_columns(const S* J, const S* G, int rows, int n, int m, S* out) {
  for (int r = 0; r < rows; ++r) {
    for (int b = 0; b < m; ++b) {
      S sum(0);
      for (int j = 0; j < n; ++j) sum = sum + J[r * n + j] * G[j * m + b];
      out[r * m + b] = sum;
    }
  }
}

}  // namespace sinew::math
