#include "sinew/model/inertia.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sinew/model/rotation.h"

namespace sinew::model {
namespace {

using Symmetric3 = math::Symmetric3<double>;

Symmetric3 operator+(const Symmetric3& a, const Symmetric3& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
}

Matrix3 full(const Symmetric3& S) { return {S.xx, S.xy, S.xz, S.xy, S.yy, S.yz, S.xz, S.yz, S.zz}; }

// R S R^T
Symmetric3 rotated(const Matrix3& R, const Symmetric3& S) {
  if (is_identity(R)) return S;
  const Matrix3 M = R * full(S) * transpose(R);
  return {M.xx, 0.5 * (M.xy + M.yx), 0.5 * (M.xz + M.zx), M.yy, 0.5 * (M.yz + M.zy), M.zz};
}

// (a . b) 1 - (a b^T + b a^T) / 2
Symmetric3 symmetric_product(const Vector3& a, const Vector3& b) {
  return {a.y * b.y + a.z * b.z, -0.5 * (a.x * b.y + a.y * b.x), -0.5 * (a.x * b.z + a.z * b.x),
          a.x * b.x + a.z * b.z, -0.5 * (a.y * b.z + a.z * b.y), a.x * b.x + a.y * b.y};
}

}  // namespace

// With r from the new point to the old one: h' = h + m r, and
// I' = I + 2 ((r . h) 1 - (r h^T + h r^T) / 2) + m ((r . r) 1 - r r^T)   (Huygens and Steiner).
RigidBodyInertia transformed(const RigidBodyInertia& I, const Matrix3& R_FS, const Vector3& p_FP) {
  const Vector3 h = R_FS * I.first_moment;
  const Vector3& r = p_FP;
  const Vector3 arm = 2.0 * h + I.mass * r;
  return {I.mass, h + I.mass * r, rotated(R_FS, I.rotational) + symmetric_product(r, arm)};
}

RigidBodyInertia about_centre_of_mass(const RigidBodyInertia& I) {
  const Vector3 c = (1 / I.mass) * I.first_moment;
  RigidBodyInertia J = transformed(I, {1, 0, 0, 0, 1, 0, 0, 0, 1}, -c);
  J.first_moment = {0, 0, 0};
  return J;
}

RigidBodyInertia operator+(const RigidBodyInertia& a, const RigidBodyInertia& b) {
  return {a.mass + b.mass, a.first_moment + b.first_moment, a.rotational + b.rotational};
}

void snap(RigidBodyInertia& I, double tolerance, double length_tolerance) {
  for (double* h : {&I.first_moment.x, &I.first_moment.y, &I.first_moment.z}) {
    if (std::abs(*h) < length_tolerance * std::abs(I.mass)) *h = 0;
  }
  Symmetric3& S = I.rotational;
  const double largest = std::max({std::abs(S.xx), std::abs(S.yy), std::abs(S.zz)});
  for (double* entry : {&S.xx, &S.xy, &S.xz, &S.yy, &S.yz, &S.zz}) {
    if (std::abs(*entry) < tolerance * largest) *entry = 0;
  }
}

// The trigonometric solution for symmetric 3x3 matrices (Smith 1961).
Vector3 eigenvalues(const Symmetric3& S) {
  const double off = S.xy * S.xy + S.xz * S.xz + S.yz * S.yz;
  const double mean = (S.xx + S.yy + S.zz) / 3;
  const double dx = S.xx - mean, dy = S.yy - mean, dz = S.zz - mean;
  const double p = std::sqrt((dx * dx + dy * dy + dz * dz + 2 * off) / 6);
  if (p == 0) return {mean, mean, mean};
  const double bx = dx / p, by = dy / p, bz = dz / p;
  const double xy = S.xy / p, xz = S.xz / p, yz = S.yz / p;
  const double half_determinant =
      0.5 * (bx * (by * bz - yz * yz) - xy * (xy * bz - yz * xz) + xz * (xy * yz - by * xz));
  const double angle = std::acos(std::clamp(half_determinant, -1.0, 1.0)) / 3;
  const double largest = mean + 2 * p * std::cos(angle);
  const double smallest = mean + 2 * p * std::cos(angle + 2 * std::numbers::pi / 3);
  return {smallest, 3 * mean - largest - smallest, largest};
}

}  // namespace sinew::model
