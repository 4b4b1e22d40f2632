#include "sinew/world/box_triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::world {
namespace {

using math::cross;
using math::dot;

// Two edges, the sine of whose angle is below, count as parallel. Rounding moves a projection by
// less than this share of the sizes.
constexpr double kParallel = 1e-6;
constexpr double kRounding = 1e-12;

}  // namespace

BoxTriangle::BoxTriangle(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape.geometry)) {
    half_ = 0.5 * box->size;
  } else if (const auto* bounds = std::get_if<MeshBounds>(&shape.geometry)) {
    half_ = 0.5 * (bounds->maximum - bounds->minimum);
  } else {
    return;
  }
  is_box_ = true;
  X_box_ = invert({shape.placement.q, middle(shape)});
}

BoxTriangle::Verdict BoxTriangle::judge(const std::array<Vector3, 3>& corners, double by) const {
  std::array<Vector3, 3> v;
  for (std::size_t i = 0; i < 3; ++i) v[i] = X_box_.p + rotate(X_box_.q, corners[i]);
  const std::array<Vector3, 3> edges = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  double size = half_.x + half_.y + half_.z;
  for (const Vector3& corner : v) {
    size = std::max(size, std::abs(corner.x) + std::abs(corner.y) + std::abs(corner.z));
  }

  double gap = -std::numeric_limits<double>::infinity();
  // Along d, of length one times `length`: from the box's end to the triangle's.
  const auto project = [&](const Vector3& d, double length) {
    const double a = dot(v[0], d), b = dot(v[1], d), c = dot(v[2], d);
    const double reach =
        half_.x * std::abs(d.x) + half_.y * std::abs(d.y) + half_.z * std::abs(d.z);
    gap = std::max(gap, (std::max(std::min({a, b, c}), -std::max({a, b, c})) - reach) / length);
    return gap > by + kRounding * size;
  };
  if (project({1, 0, 0}, 1) || project({0, 1, 0}, 1) || project({0, 0, 1}, 1)) {
    return Verdict::kApart;
  }
  bool is_parallel = false;
  const auto across = [&](const Vector3& d, double scale) {
    const double length = std::sqrt(dot(d, d));
    if (!(length > kParallel * scale)) {
      is_parallel = true;
      return false;
    }
    return project(d, length);
  };
  std::array<double, 3> lengths;
  for (std::size_t i = 0; i < 3; ++i) lengths[i] = std::sqrt(dot(edges[i], edges[i]));
  if (across(cross(edges[0], edges[1]), lengths[0] * lengths[1])) return Verdict::kApart;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3& e = edges[i];
    if (across({0, -e.z, e.y}, lengths[i]) || across({e.z, 0, -e.x}, lengths[i]) ||
        across({-e.y, e.x, 0}, lengths[i])) {
      return Verdict::kApart;
    }
  }
  // Without the direction across edges that are nearly parallel no more is lost than the sizes
  // times their angle.
  const double lost = (kRounding + (is_parallel ? 2 * kParallel : 0)) * size;
  return gap <= -lost ? Verdict::kOverlap : Verdict::kUnknown;
}

}  // namespace sinew::world
