#include "sinew/world/pose.h"

#include <cmath>

#include "sinew/world/slerp.h"

namespace sinew::world {
namespace {

// (1 - cos a) / a^2 and (a - sin a) / a^3, without cancellation where a is small.
struct ScrewFactors {
  double b, c;
};
ScrewFactors screw_factors(double angle) {
  const double a2 = angle * angle;
  if (a2 < 1e-2) {
    // Taylor; the first term left out is below 1e-17.
    return {0.5 - a2 * (1.0 / 24 - a2 * (1.0 / 720 - a2 * (1.0 / 40320 - a2 / 3628800))),
            1.0 / 6 - a2 * (1.0 / 120 - a2 * (1.0 / 5040 - a2 * (1.0 / 362880 - a2 / 39916800)))};
  }
  return {(1.0 - std::cos(angle)) / a2, (angle - std::sin(angle)) / (a2 * angle)};
}

}  // namespace

void wide_slerp_factors(const Quaternion& a, const Quaternion& b, double share, double& of_a,
                        double& of_b) {
  // atan2 of the half sum and half difference loses nothing where c is near 1 or 0.
  const Quaternion d = {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w};
  const Quaternion s = {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
  const double angle = 2.0 * std::atan2(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z + d.w * d.w),
                                        std::sqrt(s.x * s.x + s.y * s.y + s.z * s.z + s.w * s.w));
  const double sine = std::sin(angle);
  of_a = std::sin((1.0 - share) * angle) / sine;
  of_b = std::sin(share * angle) / sine;
}

Pose slerp(const Pose& from, const Pose& to, double share) {
  return slerp_in_line(from, to, share);
}

Pose revolute(double angle_rad) {
  return {{0, 0, std::sin(0.5 * angle_rad), std::cos(0.5 * angle_rad)}, {}};
}

Pose prismatic(double distance_m) { return {{}, {0, 0, distance_m}}; }

math::Pose<double> to_matrix(const Pose& pose) {
  const auto& [x, y, z, w] = pose.q;
  return {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),  //
           2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),  //
           2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)},
          pose.p};
}

// Shepperd 1978: the largest of the four components comes from the diagonal, the others from it.
Pose from_matrix(const math::Pose<double>& X) {
  const auto& R = X.R;
  const double trace = R.xx + R.yy + R.zz;
  Quaternion q;
  if (trace >= R.xx && trace >= R.yy && trace >= R.zz) {
    q = {R.zy - R.yz, R.xz - R.zx, R.yx - R.xy, 1 + trace};
  } else if (R.xx >= R.yy && R.xx >= R.zz) {
    q = {1 + R.xx - R.yy - R.zz, R.xy + R.yx, R.xz + R.zx, R.zy - R.yz};
  } else if (R.yy >= R.zz) {
    q = {R.xy + R.yx, 1 - R.xx + R.yy - R.zz, R.yz + R.zy, R.xz - R.zx};
  } else {
    q = {R.xz + R.zx, R.yz + R.zy, 1 - R.xx - R.yy + R.zz, R.yx - R.xy};
  }
  const double scale = 1.0 / std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return {{scale * q.x, scale * q.y, scale * q.z, scale * q.w}, X.p};
}

bool normalise(Pose& pose) {
  auto& [x, y, z, w] = pose.q;
  const double length = std::sqrt(x * x + y * y + z * z + w * w);
  if (!(std::abs(length - 1.0) <= kQuaternionTolerance)) return false;
  if (!std::isfinite(pose.p.x) || !std::isfinite(pose.p.y) || !std::isfinite(pose.p.z)) {
    return false;
  }
  // One that is unit to round-off stays bit for bit what it is.
  if (std::abs(length - 1.0) > 4e-16) {
    const double scale = 1.0 / length;
    x *= scale, y *= scale, z *= scale, w *= scale;
  }
  return true;
}

Pose exponential(const Twist& V, double seconds) {
  const Vector3 w = seconds * V.angular;
  const Vector3 v = seconds * V.linear;
  const double angle = std::sqrt(math::dot(w, w));
  const auto [b, c] = screw_factors(angle);
  // sin(a / 2) / a
  const double half = angle < 1e-8 ? 0.5 : std::sin(0.5 * angle) / angle;
  const Vector3 wv = math::cross(w, v);
  return {{half * w.x, half * w.y, half * w.z, std::cos(0.5 * angle)},
          v + b * wv + c * math::cross(w, wv)};
}

Twist logarithm(const Pose& X) {
  Quaternion q = X.q;
  if (q.w < 0) q = {-q.x, -q.y, -q.z, -q.w};
  const double sine = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
  const double angle = 2.0 * std::atan2(sine, q.w);
  const double scale = sine < 1e-12 ? 2.0 / q.w : angle / sine;
  const Vector3 w = scale * Vector3{q.x, q.y, q.z};
  // V^-1 = 1 - [w]x / 2 + k [w]x [w]x, k = (1 - a sin a / (2 (1 - cos a))) / a^2.
  const double a2 = angle * angle;
  const double k = a2 < 1e-2 ? 1.0 / 12 + a2 * (1.0 / 720 + a2 * (1.0 / 30240 + a2 / 1209600))
                             : (1.0 - 0.5 * angle / std::tan(0.5 * angle)) / a2;
  const Vector3 wp = math::cross(w, X.p);
  return {w, X.p - 0.5 * wp + k * math::cross(w, wp)};
}

Pose screw(const Pose& from, const Pose& to, double share) {
  return compose(from, exponential(logarithm(compose(invert(from), to)), share));
}

}  // namespace sinew::world
