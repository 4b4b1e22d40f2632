// The distance of two convex sets after Gilbert, Johnson and Keerthi 1988: the point v of the set
// of differences A - B that is nearest to the origin, approached from within a simplex of at most
// four support points. Internal to `world`.
//
// A set is what has
//
//   double radius() const                            it is its core, and all that is so near to it
//   Vector3 support_along(const Vector3& d) const    the point of the core that is farthest along d
//   Vector3 start() const                            any point of the core
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sinew/world/shape.h"

namespace sinew::world {

// The distance's lower bound |v| - (v . (v - w)) / |v| must be this near.
inline constexpr double kDistanceTolerance = 0.1 * kTouchingDistance;
// A shape with a curved side converges slowly; polytopes are done after a dozen.
inline constexpr int kMaximumDistanceSteps = 256;

struct Simplex {
  std::array<Vector3, 4> points;
  std::size_t size = 0;
};

// The nearest point of the simplex to the origin; it is reduced to the face that the point lies in.
Vector3 reduce(Simplex& simplex);

// A shape that is no mesh. A sphere is its middle with a radius around it, which is exact and
// converges at once.
struct ConvexShape {
  const Shape& shape;
  const Sphere* sphere = std::get_if<Sphere>(&shape.geometry);

  double radius() const { return sphere ? sphere->radius : 0; }
  Vector3 support_along(const Vector3& d) const {
    return sphere ? shape.placement.p : support(shape, d);
  }
  Vector3 start() const { return middle(shape); }
};

struct Triangle {
  std::array<Vector3, 3> corners;

  double radius() const { return 0; }
  Vector3 support_along(const Vector3& d) const {
    const double a = math::dot(corners[0], d), b = math::dot(corners[1], d),
                 c = math::dot(corners[2], d);
    return a >= b && a >= c ? corners[0] : b >= c ? corners[1] : corners[2];
  }
  Vector3 start() const { return corners[0]; }
};

// 0 where they touch or overlap. What is farther apart than `enough` is not looked at more closely:
// then the answer is some lower bound above `enough`.
template <typename A, typename B>
double convex_distance(const A& a, const B& b, double enough = INFINITY) {
  const double radii = a.radius() + b.radius();
  Simplex simplex;
  Vector3 v = a.start() - b.start();
  if (math::dot(v, v) == 0) v = {1, 0, 0};
  double nearest = INFINITY;
  for (int step = 0; step < kMaximumDistanceSteps; ++step) {
    const Vector3 w = a.support_along(-v) - b.support_along(v);
    if (simplex.size > 0) {
      const double least = math::dot(v, w) / nearest;
      if (nearest - least <= kDistanceTolerance) break;
      if (least - radii > enough) return least - radii;
    }
    simplex.points[simplex.size++] = w;
    v = reduce(simplex);
    const double size = std::sqrt(math::dot(v, v));
    if (size >= nearest) break;  // no progress: as exact as the numbers are
    nearest = size;
    if (simplex.size == 4 || size <= kDistanceTolerance) return 0;
  }
  return std::max(0.0, nearest - radii);
}

}  // namespace sinew::world
