#include "sinew/model/rotation.h"

#include <algorithm>
#include <cmath>

namespace sinew::model {
namespace {

// Sine and cosine with the dust of a rounded multiple of pi/2 cleared.
struct Angle {
  explicit Angle(double radians)
      : s(snap(std::sin(radians), kAngleTolerance)), c(snap(std::cos(radians), kAngleTolerance)) {}
  double s, c;
};

Matrix3 from_columns(const Vector3& x, const Vector3& y, const Vector3& z) {
  return {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
}

double determinant(const Matrix3& R) {
  return R.xx * (R.yy * R.zz - R.yz * R.zy) - R.xy * (R.yx * R.zz - R.yz * R.zx) +
         R.xz * (R.yx * R.zy - R.yy * R.zx);
}

// det(R) R^-T
Matrix3 cofactors(const Matrix3& R) {
  return {R.yy * R.zz - R.yz * R.zy, R.yz * R.zx - R.yx * R.zz, R.yx * R.zy - R.yy * R.zx,
          R.xz * R.zy - R.xy * R.zz, R.xx * R.zz - R.xz * R.zx, R.xy * R.zx - R.xx * R.zy,
          R.xy * R.yz - R.xz * R.yy, R.xz * R.yx - R.xx * R.yz, R.xx * R.yy - R.xy * R.yx};
}

// (R + k C) / 2, entry by entry.
Matrix3 mean(const Matrix3& R, const Matrix3& C, double k) {
  const auto m = [k](double r, double c) { return 0.5 * (r + k * c); };
  return {m(R.xx, C.xx), m(R.xy, C.xy), m(R.xz, C.xz), m(R.yx, C.yx), m(R.yy, C.yy),
          m(R.yz, C.yz), m(R.zx, C.zx), m(R.zy, C.zy), m(R.zz, C.zz)};
}

}  // namespace

Matrix3 identity_rotation() { return {1, 0, 0, 0, 1, 0, 0, 0, 1}; }

Pose identity_pose() { return {identity_rotation(), {0, 0, 0}}; }

bool is_identity(const Matrix3& R) {
  const bool turns_nothing =
      R.xy == 0 && R.xz == 0 && R.yx == 0 && R.yz == 0 && R.zx == 0 && R.zy == 0;
  return turns_nothing && R.xx == 1 && R.yy == 1 && R.zz == 1;
}

bool is_identity(const Pose& X) {
  return is_identity(X.R) && X.p.x == 0 && X.p.y == 0 && X.p.z == 0;
}

Matrix3 rotation_about_z(double angle) {
  const Angle a(angle);
  return {a.c, -a.s, 0, a.s, a.c, 0, 0, 0, 1};
}

Matrix3 rotation_from_rpy(double roll, double pitch, double yaw) {
  const Angle r(roll), p(pitch), y(yaw);
  Matrix3 R = {y.c * p.c,
               y.c * p.s * r.s - y.s * r.c,
               y.c * p.s * r.c + y.s * r.s,
               y.s * p.c,
               y.s * p.s * r.s + y.c * r.c,
               y.s * p.s * r.c - y.c * r.s,
               -p.s,
               p.c * r.s,
               p.c * r.c};
  snap(R, kAngleTolerance);
  return R;
}

Matrix3 rotation_with_z(const Vector3& axis) {
  const Vector3& z = axis;
  if (z.x == 0 && z.y == 0) {
    return z.z > 0 ? identity_rotation() : Matrix3{1, 0, 0, 0, -1, 0, 0, 0, -1};
  }
  // Tilts whose squares vanish beside 1: the frame stays where it would be without them, so that
  // no more than its z has entries of their size.
  const double n = std::hypot(z.x, z.y);
  if (n <= kSnapTolerance) {
    return z.z > 0 ? Matrix3{1, 0, z.x, 0, 1, z.y, -z.x, -z.y, 1}
                   : Matrix3{1, 0, z.x, 0, -1, z.y, z.x, -z.y, -1};
  }
  // x is perpendicular to z and to the model's z, so that it has no z entry; where z lies in the
  // model's x-y plane, x is the model's z itself.
  if (std::abs(z.z) <= kSnapTolerance) {
    const Vector3 x = {-z.z * z.x, -z.z * z.y, 1};
    return from_columns(x, cross(z, x), z);
  }
  const Vector3 x = {-z.y / n, z.x / n, 0};
  return from_columns(x, cross(z, x), z);
}

double orthonormality_error(const Matrix3& R) {
  if (!(determinant(R) > 0)) return 2;
  const Matrix3 S = transpose(R) * R;
  double error = 0;
  for (const double entry : {S.xx - 1, S.yy - 1, S.zz - 1, S.xy, S.xz, S.yz, S.yx, S.zx, S.zy}) {
    error = std::max(error, std::abs(entry));
    if (!(entry == entry)) return 2;
  }
  return error;
}

// Newton's iteration R <- (R + R^-T) / 2 (Higham 1986); quadratic, so six steps are plenty.
Matrix3 nearest_rotation(const Matrix3& R) {
  Matrix3 Q = R;
  for (int step = 0; step < 6; ++step) Q = mean(Q, cofactors(Q), 1 / determinant(Q));
  return Q;
}

double snap(double value, double tolerance) {
  for (const double target : {0.0, 1.0, -1.0}) {
    if (std::abs(value - target) < tolerance) return target;
  }
  return value;
}

void snap(Matrix3& R, double tolerance) {
  for (double* entry : {&R.xx, &R.xy, &R.xz, &R.yx, &R.yy, &R.yz, &R.zx, &R.zy, &R.zz}) {
    *entry = snap(*entry, tolerance);
  }
}

void snap(Pose& X, double tolerance, double length_tolerance) {
  snap(X.R, tolerance);
  for (double* entry : {&X.p.x, &X.p.y, &X.p.z}) {
    if (std::abs(*entry) < length_tolerance) *entry = 0;
  }
}

}  // namespace sinew::model
