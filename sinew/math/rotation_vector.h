// The logarithm of a pose: the constant twist that leads in one unit of time from one frame to
// another. It is the pose error of an impedance controller.
//
//   log(R, p) = (phi, V(phi)^-1 p),   V^-1 = 1 - [phi]x / 2 + k(theta) [phi]x^2,
//   k(theta) = (1 - (theta / 2) cot(theta / 2)) / theta^2
//   R. M. Murray, Z. Li, S. S. Sastry, A Mathematical Introduction to Robotic Manipulation (1994),
//   section 2.3 and appendix A.
//
// Here all goes by way of the unit quaternion (v, w) of R with w >= 0, with |v| = sin(theta / 2)
// and w = cos(theta / 2). So nothing is divided by an angle, and the result is smooth at angle
// zero. It is exact up to half a turn; at half a turn itself the axis has two directions and one is
// taken.
#pragma once

#include <cmath>

#include "sinew/math/choice.h"
#include "sinew/math/pose.h"

namespace sinew::math {

// The difference of two poses: what one must turn [rad] and move [m] to become the other.
template <typename S>
struct PoseError {
  Vector3<S> angular;
  Vector3<S> linear;
};

template <typename S>
struct UnitQuaternion {
  Vector3<S> v;
  S w{};
};

// Of the four columns of 4 q q^T, the one with the largest diagonal entry, made one long: S. W.
// Shepperd, Quaternion from rotation matrix, J. Guidance and Control 1 (1978).
template <typename S>
UnitQuaternion<S> unit_quaternion(const Matrix3<S>& R) {
  using std::sqrt;
  const S one(1);
  const S wx = R.zy - R.yz, wy = R.xz - R.zx, wz = R.yx - R.xy;
  const S xy = R.xy + R.yx, xz = R.xz + R.zx, yz = R.yz + R.zy;
  const S ww = one + R.xx + R.yy + R.zz;
  const S xx = one + R.xx - R.yy - R.zz;
  const S yy = one - R.xx + R.yy - R.zz;
  const S zz = one - R.xx - R.yy + R.zz;
  S q[4] = {wx, wy, wz, ww};
  S largest = ww;
  const auto take = [&](const S& diagonal, const S& x, const S& y, const S& z, const S& w) {
    const S entries[4] = {x, y, z, w};
    for (int i = 0; i < 4; ++i) q[i] = select_less(largest, diagonal, entries[i], q[i]);
    largest = maximum(largest, diagonal);
  };
  take(xx, xx, xy, xz, wx);
  take(yy, xy, yy, yz, wy);
  take(zz, xz, yz, zz, wz);
  const S length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  // w >= 0
  const S scale = select_less(q[3], S(0), S(-1), one) / length;
  return {{q[0] * scale, q[1] * scale, q[2] * scale}, q[3] * scale};
}

// theta / sin(theta / 2) for a unit quaternion with w >= 0. With t = tan(theta / 4) = |v| / (1 +
// w), halved twice more by tan(a / 2) = tan(a) / (1 + sqrt(1 + tan(a)^2)), the series of atan ends
// beyond the last bit: its argument is at most tan(pi / 16) = 0.199.
template <typename S>
S angle_over_half_sine(const UnitQuaternion<S>& q) {
  using std::sqrt;
  const S one(1);
  const S first = one / (one + q.w);
  const S t_squared = dot(q.v, q.v) * first * first;
  const S second = one / (one + sqrt(one + t_squared));
  const S u_squared = t_squared * second * second;
  const S third = one / (one + sqrt(one + u_squared));
  const S x = u_squared * third * third;
  // atan(y) / y = 1 - x / 3 + x^2 / 5 - ..., x = y^2 <= 0.0396: the next term is below 2e-18.
  constexpr int kTerms = 12;
  S series(0);
  for (int k = kTerms; k-- > 0;) series = S((k % 2 == 0 ? 1.0 : -1.0) / (2 * k + 1)) + x * series;
  return S(16) * first * second * third * series;
}

// The rotation vector phi: R = exp [phi]x, |phi| <= pi.
template <typename S>
Vector3<S> rotation_vector(const Matrix3<S>& R) {
  const UnitQuaternion<S> q = unit_quaternion(R);
  return angle_over_half_sine(q) * q.v;
}

template <typename S>
PoseError<S> logarithm(const Pose<S>& X) {
  const UnitQuaternion<S> q = unit_quaternion(X.R);
  const S ratio = angle_over_half_sine(q);  // theta / |v|
  // k(theta) theta^2 / |v|^2 = (1 - ratio w / 2) / s with s = |v|^2; where s is small, its series
  // (that of 1 - asin(y) sqrt(1 - y^2) / y, y^2 = s), which ends beyond the last bit.
  constexpr double kSmall = 2.5e-3;
  constexpr double kSeries[] = {1.0 / 3,    2.0 / 15,     8.0 / 105,
                                16.0 / 315, 128.0 / 3465, 256.0 / 9009};
  const S s = dot(q.v, q.v);
  S series(0);
  for (int k = 6; k-- > 0;) series = S(kSeries[k]) + s * series;
  const S direct = (S(1) - S(0.5) * ratio * q.w) / maximum(s, S(kSmall));
  const S k = select_less(s, S(kSmall), series, direct);
  const Vector3<S> once = cross(q.v, X.p);
  return {ratio * q.v, X.p - S(0.5) * ratio * once + k * cross(q.v, once)};
}

// The pose error from A to B, seen from A: log(X_AB).
template <typename S>
PoseError<S> pose_error(const Pose<S>& X_RA, const Pose<S>& X_RB) {
  return logarithm(compose(invert(X_RA), X_RB));
}

}  // namespace sinew::math
