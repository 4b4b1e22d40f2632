// Vectors and matrices of three dimensions over any scalar: `double`, or the tracing scalar of
// `program`, so that each formula is written once. Plain values, no hidden cost: an expression does
// the operations that one reads, in the order in which one reads them.
#pragma once

namespace sinew::math {

template <typename S>
struct Vector3 {
  S x{}, y{}, z{};
};

// Row-major 3x3; `xy` is the entry of row x and column y.
template <typename S>
struct Matrix3 {
  S xx{}, xy{}, xz{};
  S yx{}, yy{}, yz{};
  S zx{}, zy{}, zz{};
};

// The upper triangle of a symmetric 3x3 matrix.
template <typename S>
struct Symmetric3 {
  S xx{}, xy{}, xz{};
  S yy{}, yz{};
  S zz{};
};

template <typename S>
Vector3<S> operator+(const Vector3<S>& a, const Vector3<S>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <typename S>
Vector3<S> operator-(const Vector3<S>& a, const Vector3<S>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <typename S>
Vector3<S> operator-(const Vector3<S>& a) {
  return {-a.x, -a.y, -a.z};
}

template <typename S>
Vector3<S> operator*(const S& s, const Vector3<S>& a) {
  return {s * a.x, s * a.y, s * a.z};
}

template <typename S>
Symmetric3<S> operator+(const Symmetric3<S>& a, const Symmetric3<S>& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
}

template <typename S>
Matrix3<S> operator+(const Matrix3<S>& a, const Matrix3<S>& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yx + b.yx, a.yy + b.yy,
          a.yz + b.yz, a.zx + b.zx, a.zy + b.zy, a.zz + b.zz};
}

template <typename S>
S dot(const Vector3<S>& a, const Vector3<S>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <typename S>
Vector3<S> cross(const Vector3<S>& a, const Vector3<S>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <typename S>
Vector3<S> operator*(const Matrix3<S>& M, const Vector3<S>& v) {
  return {M.xx * v.x + M.xy * v.y + M.xz * v.z, M.yx * v.x + M.yy * v.y + M.yz * v.z,
          M.zx * v.x + M.zy * v.y + M.zz * v.z};
}

// M^T v
template <typename S>
Vector3<S> transpose_times(const Matrix3<S>& M, const Vector3<S>& v) {
  return {M.xx * v.x + M.yx * v.y + M.zx * v.z, M.xy * v.x + M.yy * v.y + M.zy * v.z,
          M.xz * v.x + M.yz * v.y + M.zz * v.z};
}

template <typename S>
Matrix3<S> operator*(const Matrix3<S>& A, const Matrix3<S>& B) {
  const Vector3<S> x = A * Vector3<S>{B.xx, B.yx, B.zx};
  const Vector3<S> y = A * Vector3<S>{B.xy, B.yy, B.zy};
  const Vector3<S> z = A * Vector3<S>{B.xz, B.yz, B.zz};
  return {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
}

template <typename S>
Matrix3<S> transpose(const Matrix3<S>& M) {
  return {M.xx, M.yx, M.zx, M.xy, M.yy, M.zy, M.xz, M.yz, M.zz};
}

}  // namespace sinew::math
