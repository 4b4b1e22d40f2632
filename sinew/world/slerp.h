// SLERP in line, for the reading of chains: what lies between two entries is usually a small turn,
// for which a short series replaces the three sines and the angle.
#pragma once

#include "sinew/world/pose.h"

namespace sinew::world {

// sin(share a) / sin(a) for cos(a) = c near 1, as a series in x = c - 1 (Eberly 2011, "A fast and
// accurate algorithm for computing SLERP"): the product of factors (u_i share^2 - v_i) x, with
// u_i = 1 / (i (2 i + 1)) and v_i = i / (2 i + 1). Its terms shrink like (-x / 2)^i.
struct SeriesFactors {
  double u, v;
};
constexpr SeriesFactors factors(int i) {
  return {1.0 / (i * (2.0 * i + 1.0)), i / (2.0 * i + 1.0)};
}
inline constexpr SeriesFactors kSeries[] = {factors(1), factors(2), factors(3), factors(4),
                                            factors(5), factors(6), factors(7), factors(8)};
inline constexpr double kSeriesLimit =
    0.01;  // 1 - c: 16 degrees of rotation; 8 terms leave out < 1e-18
inline constexpr double kShortLimit = 1e-4;  // 4 terms are as good
template <int kTerms>
inline double sine_ratio(double share, double x) {
  const double square = share * share;
  double sum = 0;
#pragma GCC unroll 8
  for (int i = kTerms - 1; i >= 0; --i) {
    sum = (kSeries[i].u * square - kSeries[i].v) * x * (1.0 + sum);
  }
  return share * (1.0 + sum);
}

// The same where the angle is large.
void wide_slerp_factors(const Quaternion& a, const Quaternion& b, double share, double& of_a,
                        double& of_b);

inline Quaternion slerp(const Quaternion& a, Quaternion b, double share) {
  double c = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
  if (c < 0) {
    c = -c;
    b = {-b.x, -b.y, -b.z, -b.w};
  }
  double of_a = 0, of_b = 0;
  if (1.0 - c < kShortLimit) {
    of_a = sine_ratio<4>(1.0 - share, c - 1.0);
    of_b = sine_ratio<4>(share, c - 1.0);
  } else if (1.0 - c < kSeriesLimit) {
    of_a = sine_ratio<8>(1.0 - share, c - 1.0);
    of_b = sine_ratio<8>(share, c - 1.0);
  } else {
    wide_slerp_factors(a, b, share, of_a, of_b);
  }
  return {of_a * a.x + of_b * b.x, of_a * a.y + of_b * b.y, of_a * a.z + of_b * b.z,
          of_a * a.w + of_b * b.w};
}

inline Pose slerp_in_line(const Pose& from, const Pose& to, double share) {
  return {slerp(from.q, to.q, share), from.p + share * (to.p - from.p)};
}

}  // namespace sinew::world
