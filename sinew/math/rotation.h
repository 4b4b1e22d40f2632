// Rotated matrices, R M R^T, at the cost of the rotation at hand: joints turn about one axis, and
// normalisation chooses frames so that most constant rotations do as well, or turn by quarters.
#pragma once

#include "sinew/math/vector.h"

namespace sinew::math {

// Whether a scalar is known to be this number. A tracing scalar has an overload of its own, which
// knows the constants only.
inline bool is_exactly(double scalar, double value) { return scalar == value; }
// Whether two scalars are known to be the same.
inline bool is_same(double a, double b) { return a == b; }

// A rotation that leaves one axis in its place, perhaps reversed: about it turn the other two, in
// cyclic order, by the angle of cosine c and sine s, after the second has been reversed if `sign`
// is -1.
template <typename S>
struct PlaneRotation {
  S c{}, s{};
  double sign = 1.0;
};

// [xx xy; yx yy] in the plane that turns.
template <typename S>
struct Matrix2 {
  S xx{}, xy{}, yx{}, yy{};
};

// Q M Q^T with four multiplications instead of fourteen: what turns is the difference of the
// diagonal and the sum of the other two, k = c (xx - yy) - s (xy + yx); the trace and the
// difference xy - yx stay.
template <typename S>
Matrix2<S> rotate(const PlaneRotation<S>& Q, const Matrix2<S>& M) {
  const S sign(Q.sign);
  const S xy = sign * M.xy;
  const S yx = sign * M.yx;
  const S k = Q.c * (M.xx - M.yy) - Q.s * (xy + yx);
  return {M.yy + Q.c * k, xy + Q.s * k, yx + Q.s * k, M.xx - Q.c * k};
}

// The axis (0, 1, 2) that R leaves in its place, or -1.
template <typename S>
int fixed_axis(const Matrix3<S>& R) {
  const auto unit = [](const S& entry) {
    return is_exactly(entry, 1.0) || is_exactly(entry, -1.0);
  };
  const auto zero = [](const S& a, const S& b, const S& c, const S& d) {
    return is_exactly(a, 0.0) && is_exactly(b, 0.0) && is_exactly(c, 0.0) && is_exactly(d, 0.0);
  };
  if (unit(R.zz) && zero(R.xz, R.yz, R.zx, R.zy)) return 2;
  if (unit(R.xx) && zero(R.xy, R.xz, R.yx, R.zx)) return 0;
  if (unit(R.yy) && zero(R.xy, R.zy, R.yx, R.yz)) return 1;
  return -1;
}

// R M R^T
template <typename S>
Matrix3<S> rotate(const Matrix3<S>& R, const Matrix3<S>& M) {
  const int axis = fixed_axis(R);
  if (axis < 0) return R * M * transpose(R);
  // Entries in cyclic order from the axis: a is the axis itself, b and c turn.
  const auto at = [axis](const Matrix3<S>& A, int row, int column) -> const S& {
    const S* const rows[3][3] = {
        {&A.xx, &A.xy, &A.xz}, {&A.yx, &A.yy, &A.yz}, {&A.zx, &A.zy, &A.zz}};
    return *rows[(axis + row) % 3][(axis + column) % 3];
  };
  const PlaneRotation<S> Q = {at(R, 1, 1), at(R, 2, 1), is_exactly(at(R, 0, 0), 1.0) ? 1.0 : -1.0};
  const S sign(Q.sign);
  const Matrix2<S> plane = rotate(Q, {at(M, 1, 1), at(M, 1, 2), at(M, 2, 1), at(M, 2, 2)});
  // The row and the column of the axis turn as vectors.
  const S ab = sign * at(M, 0, 1), ac = at(M, 0, 2), ba = sign * at(M, 1, 0), ca = at(M, 2, 0);
  const S turned[3][3] = {{at(M, 0, 0), Q.c * ab - Q.s * ac, Q.s * ab + Q.c * ac},
                          {Q.c * ba - Q.s * ca, plane.xx, plane.xy},
                          {Q.s * ba + Q.c * ca, plane.yx, plane.yy}};
  const auto entry = [&](int row, int column) {
    return turned[(row - axis + 3) % 3][(column - axis + 3) % 3];
  };
  return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 0), entry(1, 1),
          entry(1, 2), entry(2, 0), entry(2, 1), entry(2, 2)};
}

// R M R^T of a symmetric matrix.
template <typename S>
Symmetric3<S> rotate(const Matrix3<S>& R, const Symmetric3<S>& M) {
  const Matrix3<S> full =
      rotate(R, Matrix3<S>{M.xx, M.xy, M.xz, M.xy, M.yy, M.yz, M.xz, M.yz, M.zz});
  return {full.xx, full.xy, full.xz, full.yy, full.yz, full.zz};
}

}  // namespace sinew::math
