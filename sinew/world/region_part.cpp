#include "sinew/world/region_part.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::world {
namespace {

// What is so far apart does not touch, by distances that are exact to a tenth of it as well.
constexpr double kApartBy = 1.2 * kTouchingDistance;
// Edges whose angle has a smaller sine count as parallel.
constexpr double kParallel = 1e-6;

bool is_box(const Shape& shape) {
  return std::holds_alternative<Box>(shape.geometry) ||
         std::holds_alternative<MeshBounds>(shape.geometry);
}

using Rows = std::array<std::array<double, 3>, 3>;

}  // namespace

TurnedBox turned_box(const Bounds3& box) {
  TurnedBox result;
  result.half = 0.5 * (box.maximum - box.minimum);
  result.middle = box.minimum + result.half;
  return result;
}

TurnedBox turned_box(const Shape& shape) {
  TurnedBox result;
  result.R = to_matrix(shape.placement).R;
  result.middle = shape.placement.p;
  if (const auto* box = std::get_if<Box>(&shape.geometry)) {
    result.half = 0.5 * box->size;
    return result;
  }
  const Bounds3 own = bounds(Shape{shape.geometry, {}});
  result.half = 0.5 * (own.maximum - own.minimum);
  result.middle = result.middle + rotate(shape.placement.q, own.minimum + result.half);
  return result;
}

RegionPart::RegionPart(const Shape& part)
    : part_(&part), box_(turned_box(part)), is_box_(is_box(part)) {}

RegionPart::Verdict RegionPart::judge(const TurnedBox& box, bool is_all_of_it) const {
  const auto& A = box_.R;
  const auto& B = box.R;
  const Vector3 d = box.middle - box_.middle;
  const double t[3] = {A.xx * d.x + A.yx * d.y + A.zx * d.z, A.xy * d.x + A.yy * d.y + A.zy * d.z,
                       A.xz * d.x + A.yz * d.y + A.zz * d.z};
  // C = A^T B
  const Rows C = {
      {{A.xx * B.xx + A.yx * B.yx + A.zx * B.zx, A.xx * B.xy + A.yx * B.yy + A.zx * B.zy,
        A.xx * B.xz + A.yx * B.yz + A.zx * B.zz},
       {A.xy * B.xx + A.yy * B.yx + A.zy * B.zx, A.xy * B.xy + A.yy * B.yy + A.zy * B.zy,
        A.xy * B.xz + A.yy * B.yz + A.zy * B.zz},
       {A.xz * B.xx + A.yz * B.yx + A.zz * B.zx, A.xz * B.xy + A.yz * B.yy + A.zz * B.zy,
        A.xz * B.xz + A.yz * B.yz + A.zz * B.zz}}};
  Rows size;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) size[i][j] = std::abs(C[i][j]);
  }
  const double e[3] = {box_.half.x, box_.half.y, box_.half.z};
  const double f[3] = {box.half.x, box.half.y, box.half.z};

  double gap = -std::numeric_limits<double>::infinity(),
         overshoot = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const double reach = f[0] * size[i][0] + f[1] * size[i][1] + f[2] * size[i][2];
    gap = std::max(gap, std::abs(t[i]) - (e[i] + reach));
    overshoot = std::max(overshoot, std::abs(t[i]) + reach - e[i]);
  }
  if (gap > kApartBy) return Verdict::kApart;
  if (is_box_ && overshoot <= 0) return Verdict::kWithin;
  for (std::size_t j = 0; j < 3; ++j) {
    const double along = t[0] * C[0][j] + t[1] * C[1][j] + t[2] * C[2][j];
    gap = std::max(
        gap, std::abs(along) - (f[j] + e[0] * size[0][j] + e[1] * size[1][j] + e[2] * size[2][j]));
  }
  if (gap > kApartBy) return Verdict::kApart;
  bool parallel = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double square = 1 - C[i][j] * C[i][j];
      if (!(square > kParallel * kParallel)) {
        parallel = true;
        continue;
      }
      const double across =
          std::abs(t[i2] * C[i1][j] - t[i1] * C[i2][j]) -
          (e[i1] * size[i2][j] + e[i2] * size[i1][j] + f[j1] * size[i][j2] + f[j2] * size[i][j1]);
      // Longer than the gap by the axis' own length, which is below one.
      if (across > kApartBy) return Verdict::kApart;
      gap = std::max(gap, across);
    }
  }
  if (!is_box_ || !is_all_of_it || overshoot <= kApartBy) return Verdict::kUnknown;
  // Of nearly parallel edges the projection across them was left out: no more than the boxes' sizes
  // times their angle is lost by that.
  const double lost = parallel ? 2 * kParallel * (e[0] + e[1] + e[2] + f[0] + f[1] + f[2]) : 0;
  return gap <= -lost ? Verdict::kAcross : Verdict::kUnknown;
}

RegionPart::Verdict RegionPart::judge(const Shape& shape) const {
  return judge(turned_box(shape), is_box(shape));
}

bool RegionPart::touches(const Shape& shape) const {
  const Verdict verdict = judge(shape);
  return verdict == Verdict::kUnknown ? touch(shape, *part_) : verdict != Verdict::kApart;
}

bool RegionPart::holds(const Shape& shape) const {
  const Verdict verdict = judge(shape);
  return verdict == Verdict::kUnknown ? inside(shape, *part_) : verdict == Verdict::kWithin;
}

}  // namespace sinew::world
