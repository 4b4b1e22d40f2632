// Random shapes of all kinds for the tests, points within them, and whether a point is within one,
// by the definition of each.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "random_poses.h"
#include "sinew/world/shape.h"

namespace sinew::world {

inline Shape random_shape(std::mt19937_64& random) {
  std::uniform_real_distribution<double> size(0.1, 1.5);
  const Pose X = random_pose(random);
  switch (random() % 5) {
    case 0:
      return {Box{{size(random), size(random), size(random)}}, X};
    case 1:
      return {Sphere{0.5 * size(random)}, X};
    case 2:
      return {Cylinder{0.5 * size(random), size(random)}, X};
    case 3: {  // corners in order on an ellipse
      Polygon polygon;
      const double a = size(random), b = size(random), start = size(random);
      const int corners = 3 + static_cast<int>(random() % 6);
      for (int i = 0; i < corners; ++i) {
        const double t = start + 2 * M_PI * i / corners;
        polygon.outline.push_back({0.5 * a * std::cos(t), 0.2 + 0.5 * b * std::sin(t)});
      }
      polygon.bottom = -size(random);
      polygon.top = size(random);
      return {polygon, X};
    }
    default:
      return {MeshBounds{{-size(random), 0, 0.1}, {0, size(random), 0.2 + size(random)}}, X};
  }
}

inline bool contains(const Shape& shape, const Vector3& point) {
  const Vector3 p = compose(invert(shape.placement), {{}, point}).p;
  const auto within = [&p](const Vector3& low, const Vector3& high) {
    constexpr double kSlack = 1e-9;
    return p.x >= low.x - kSlack && p.x <= high.x + kSlack && p.y >= low.y - kSlack &&
           p.y <= high.y + kSlack && p.z >= low.z - kSlack && p.z <= high.z + kSlack;
  };
  if (const auto* box = std::get_if<Box>(&shape.geometry)) {
    return within(-0.5 * box->size, 0.5 * box->size);
  }
  if (const auto* mesh = std::get_if<MeshBounds>(&shape.geometry)) {
    return within(mesh->minimum, mesh->maximum);
  }
  if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
    return math::dot(p, p) <= sphere->radius * sphere->radius;
  }
  if (const auto* cylinder = std::get_if<Cylinder>(&shape.geometry)) {
    return std::hypot(p.x, p.y) <= cylinder->radius && std::abs(p.z) <= cylinder->height / 2;
  }
  const auto& polygon = std::get<Polygon>(shape.geometry);
  if (p.z < polygon.bottom || p.z > polygon.top) return false;
  for (std::size_t i = 0; i < polygon.outline.size(); ++i) {
    const auto& a = polygon.outline[i];
    const auto& b = polygon.outline[(i + 1) % polygon.outline.size()];
    if ((b[0] - a[0]) * (p.y - a[1]) - (b[1] - a[1]) * (p.x - a[0]) < -1e-9) return false;
  }
  return true;
}

inline Vector3 random_point_in(const Shape& shape, std::mt19937_64& random) {
  const Bounds3 box = bounds(shape);
  std::uniform_real_distribution<double> share(0, 1);
  for (;;) {
    const Vector3 size = box.maximum - box.minimum;
    const Vector3 point = {box.minimum.x + share(random) * size.x,
                           box.minimum.y + share(random) * size.y,
                           box.minimum.z + share(random) * size.z};
    if (contains(shape, point)) return point;
  }
}

}  // namespace sinew::world
