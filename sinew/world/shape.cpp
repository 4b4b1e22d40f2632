#include "sinew/world/shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "sinew/world/refuse.h"
#include "sinew/world/triangle_mesh.h"

namespace sinew::world {
namespace {

using math::cross;
using math::dot;

double length(const Vector3& v) { return std::sqrt(dot(v, v)); }
bool positive(double value) { return std::isfinite(value) && value > 0; }

void check_positive(double value, std::string_view what, std::string_view iri) {
  if (!positive(value)) {
    refuse(iri, std::string(what) + " is " + std::to_string(value), "a finite length above 0 m");
  }
}

// On which side of the line from a to b the point c is: left positive, on it 0.
double side(const std::array<double, 2>& a, const std::array<double, 2>& b,
            const std::array<double, 2>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Two sides of the outline that are no neighbours and cross, if there are any.
std::optional<std::pair<std::size_t, std::size_t>> crossing_sides(
    const std::vector<std::array<double, 2>>& outline) {
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto &a = outline[i], &b = outline[(i + 1) % n];
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n == i) continue;
      const auto &c = outline[j], &d = outline[(j + 1) % n];
      if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) {
        return std::pair{i, j};
      }
    }
  }
  return std::nullopt;
}

struct Check {
  std::string_view iri;

  void operator()(const Box& box) const {
    check_positive(box.size.x, "the box's size along x", iri);
    check_positive(box.size.y, "the box's size along y", iri);
    check_positive(box.size.z, "the box's size along z", iri);
  }
  void operator()(const Sphere& sphere) const {
    check_positive(sphere.radius, "the sphere's radius", iri);
  }
  void operator()(const Cylinder& cylinder) const {
    check_positive(cylinder.radius, "the cylinder's radius", iri);
    check_positive(cylinder.height, "the cylinder's height", iri);
  }
  void operator()(const MeshBounds& mesh) const {
    const Vector3 size = mesh.maximum - mesh.minimum;
    const double numbers[] = {size.x, size.y, size.z};
    for (const double number : numbers) {
      if (!std::isfinite(number) || number < 0) {
        refuse(iri, "the mesh's bounds are not finite or not in order", "minimum below maximum");
      }
    }
  }
  void operator()(const Mesh& mesh) const {  // make_mesh has checked the rest
    if (!mesh.triangles) refuse(iri, "a mesh without its triangles", "make_mesh");
  }
  void operator()(const Polygon& polygon) const {
    const std::size_t n = polygon.outline.size();
    if (n < 3 || n > kMaximumPolygonCorners) {
      refuse(iri, "the outline has " + std::to_string(n) + " corners",
             "3 to " + std::to_string(kMaximumPolygonCorners));
    }
    check_positive(polygon.top - polygon.bottom, "the polygon's height", iri);
    if (const auto sides = crossing_sides(polygon.outline)) {
      refuse(iri,
             "the outline crosses itself: side " + std::to_string(sides->first) + " meets side " +
                 std::to_string(sides->second),
             "a convex outline; side i leads from corner i, counted from 0, to the next");
    }
    double turns = 0;  // all of them: 2 pi where the outline goes round once
    for (std::size_t i = 0; i < n; ++i) {
      const auto& a = polygon.outline[i];
      const auto& b = polygon.outline[(i + 1) % n];
      const auto& c = polygon.outline[(i + 2) % n];
      const double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - b[0], vy = c[1] - b[1];
      const double turn = std::atan2(ux * vy - uy * vx, ux * vx + uy * vy);
      turns += turn;
      if (!(turn >= 0) || (ux == 0 && uy == 0)) {
        refuse(
            iri,
            "the outline is not convex and anticlockwise at corner " + std::to_string((i + 1) % n),
            "a convex outline, or several of them");
      }
    }
    if (turns > 3 * std::numbers::pi) {
      refuse(iri, "the outline goes round more than once", "a convex outline");
    }
  }
};

Vector3 corner_along(const Vector3& minimum, const Vector3& maximum, const Vector3& d) {
  return {d.x < 0 ? minimum.x : maximum.x, d.y < 0 ? minimum.y : maximum.y,
          d.z < 0 ? minimum.z : maximum.z};
}

// The farthest point along d, seen from the geometry's own axes.
struct Support {
  const Vector3& d;

  Vector3 operator()(const Box& box) const {
    const Vector3 half = 0.5 * box.size;
    return corner_along(-half, half, d);
  }
  Vector3 operator()(const MeshBounds& mesh) const {
    return corner_along(mesh.minimum, mesh.maximum, d);
  }
  Vector3 operator()(const Mesh& mesh) const {
    return farthest_vertex(
        *mesh.triangles,
        [&](const Bounds3& box) { return dot(d, corner_along(box.minimum, box.maximum, d)); },
        [&](const Vector3& vertex) { return dot(d, vertex); });
  }
  Vector3 operator()(const Sphere& sphere) const {
    const double size = length(d);
    return size > 0 ? (sphere.radius / size) * d : Vector3{sphere.radius, 0, 0};
  }
  Vector3 operator()(const Cylinder& cylinder) const {
    const double size = std::hypot(d.x, d.y);
    const double scale = size > 0 ? cylinder.radius / size : 0;
    return {scale * d.x, scale * d.y, (d.z < 0 ? -0.5 : 0.5) * cylinder.height};
  }
  Vector3 operator()(const Polygon& polygon) const {
    const std::array<double, 2>* best = &polygon.outline.front();
    for (const auto& corner : polygon.outline) {
      if (d.x * (corner[0] - (*best)[0]) + d.y * (corner[1] - (*best)[1]) > 0) best = &corner;
    }
    return {(*best)[0], (*best)[1], d.z < 0 ? polygon.bottom : polygon.top};
  }
};

struct Middle {
  Vector3 operator()(const Box&) const { return {}; }
  Vector3 operator()(const Sphere&) const { return {}; }
  Vector3 operator()(const Cylinder&) const { return {}; }
  Vector3 operator()(const MeshBounds& mesh) const { return 0.5 * (mesh.minimum + mesh.maximum); }
  Vector3 operator()(const Mesh& mesh) const {
    const Bounds3& box = mesh.triangles->bounds();
    return 0.5 * (box.minimum + box.maximum);
  }
  Vector3 operator()(const Polygon& polygon) const {
    const Geometry geometry = polygon;
    const Bounds3 box = bounds(Shape{geometry, {}});
    return 0.5 * (box.minimum + box.maximum);
  }
};

// ---- by how much one shape is outside another ----

std::vector<Vector3> box_corners(const Vector3& minimum, const Vector3& maximum) {
  std::vector<Vector3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back({i & 1 ? maximum.x : minimum.x, i & 2 ? maximum.y : minimum.y,
                       i & 4 ? maximum.z : minimum.z});
  }
  return corners;
}

// The largest |P v| over the points v of a shape, where P drops z or nothing: a convex function,
// which is largest at a corner or on a rim.
struct Farthest {
  const Pose& X;  // of the geometry's axes in the frame in which P is taken
  bool drop_z;

  double reach(const Vector3& point) const {
    return drop_z ? std::hypot(point.x, point.y) : length(point);
  }
  double corners(const std::vector<Vector3>& points) const {
    double farthest = 0;
    for (const Vector3& point : points) {
      farthest = std::max(farthest, reach(X.p + rotate(X.q, point)));
    }
    return farthest;
  }
  double operator()(const Box& box) const {
    const Vector3 half = 0.5 * box.size;
    return corners(box_corners(-half, half));
  }
  double operator()(const MeshBounds& mesh) const {
    return corners(box_corners(mesh.minimum, mesh.maximum));
  }
  double operator()(const Mesh& mesh) const {
    const Vector3 point = farthest_vertex(
        *mesh.triangles,
        [&](const Bounds3& box) { return corners(box_corners(box.minimum, box.maximum)); },
        [&](const Vector3& vertex) { return reach(X.p + rotate(X.q, vertex)); });
    return reach(X.p + rotate(X.q, point));
  }
  double operator()(const Polygon& polygon) const {
    std::vector<Vector3> points;
    for (const auto& [x, y] : polygon.outline) {
      points.push_back({x, y, polygon.bottom});
      points.push_back({x, y, polygon.top});
    }
    return corners(points);
  }
  double operator()(const Sphere& sphere) const { return reach(X.p) + sphere.radius; }
  // |P(c + r cos(t) u + r sin(t) v)|^2 is a trigonometric polynomial of degree two, with two
  // maxima at most: the best of kRimSamples, then golden-section search around it.
  double operator()(const Cylinder& cylinder) const {
    constexpr int kRimSamples = 64;
    constexpr double kStep = 2 * std::numbers::pi / kRimSamples;
    constexpr int kSearchSteps = 40;
    double farthest = 0;
    for (const double z : {-0.5 * cylinder.height, 0.5 * cylinder.height}) {
      const auto at = [&](double t) {
        return reach(
            X.p + rotate(X.q, {cylinder.radius * std::cos(t), cylinder.radius * std::sin(t), z}));
      };
      int best = 0;
      for (int i = 1; i < kRimSamples; ++i) {
        if (at(i * kStep) > at(best * kStep)) best = i;
      }
      double low = (best - 1) * kStep, high = (best + 1) * kStep;
      for (int i = 0; i < kSearchSteps; ++i) {
        const double step = (high - low) / std::numbers::phi;
        const double left = high - step, right = low + step;
        if (at(left) > at(right)) {
          high = right;
        } else {
          low = left;
        }
      }
      farthest = std::max(farthest, at(0.5 * (low + high)));
    }
    return farthest;
  }
};

double farthest(const Shape& a, const Pose& X_B, bool drop_z) {
  const Pose X_BA = compose(invert(X_B), a.placement);
  return std::visit(Farthest{X_BA, drop_z}, a.geometry);
}

struct Protrusion {
  const Shape& a;
  const Pose& X_B;

  // Over the face with this outward normal that lies at `offset` along it, seen from B.
  double over(const Vector3& normal, double offset) const {
    const Vector3 direction = rotate(X_B.q, normal);
    return dot(support(a, direction) - X_B.p, direction) - offset;
  }
  double over_box(const Vector3& minimum, const Vector3& maximum) const {
    return std::max({over({1, 0, 0}, maximum.x), over({-1, 0, 0}, -minimum.x),
                     over({0, 1, 0}, maximum.y), over({0, -1, 0}, -minimum.y),
                     over({0, 0, 1}, maximum.z), over({0, 0, -1}, -minimum.z)});
  }
  double operator()(const Box& box) const { return over_box(-0.5 * box.size, 0.5 * box.size); }
  double operator()(const MeshBounds& mesh) const { return over_box(mesh.minimum, mesh.maximum); }
  double operator()(const Mesh& mesh) const {
    const Bounds3& box = mesh.triangles->bounds();
    return over_box(box.minimum, box.maximum);
  }
  double operator()(const Sphere& sphere) const { return farthest(a, X_B, false) - sphere.radius; }
  double operator()(const Cylinder& cylinder) const {
    return std::max({over({0, 0, 1}, 0.5 * cylinder.height),
                     over({0, 0, -1}, 0.5 * cylinder.height),
                     farthest(a, X_B, true) - cylinder.radius});
  }
  double operator()(const Polygon& polygon) const {
    double most = std::max(over({0, 0, 1}, polygon.top), over({0, 0, -1}, -polygon.bottom));
    const std::size_t n = polygon.outline.size();
    for (std::size_t i = 0; i < n; ++i) {
      const auto& from = polygon.outline[i];
      const auto& to = polygon.outline[(i + 1) % n];
      const double size = std::hypot(to[0] - from[0], to[1] - from[1]);
      const Vector3 normal = {(to[1] - from[1]) / size, (from[0] - to[0]) / size, 0};
      most = std::max(most, over(normal, normal.x * from[0] + normal.y * from[1]));
    }
    return most;
  }
};

}  // namespace

void check_shape(const Geometry& geometry, std::string_view iri) {
  std::visit(Check{iri}, geometry);
}

MeshBounds mesh_bounds(std::span<const Vector3> vertices) {
  if (vertices.empty()) refuse({}, "a mesh without vertices has no bounds", "at least one vertex");
  MeshBounds result = {vertices[0], vertices[0]};
  for (const Vector3& v : vertices) {
    result.minimum = {std::min(result.minimum.x, v.x), std::min(result.minimum.y, v.y),
                      std::min(result.minimum.z, v.z)};
    result.maximum = {std::max(result.maximum.x, v.x), std::max(result.maximum.y, v.y),
                      std::max(result.maximum.z, v.z)};
  }
  return result;
}

Shape placed(const Pose& X_AB, const Shape& shape_B) {
  return {shape_B.geometry, compose(X_AB, shape_B.placement)};
}

Vector3 support(const Shape& shape, const Vector3& direction) {
  const Vector3 seen = rotate(conjugate(shape.placement.q), direction);
  return shape.placement.p + rotate(shape.placement.q, std::visit(Support{seen}, shape.geometry));
}

Vector3 middle(const Shape& shape) {
  return shape.placement.p + rotate(shape.placement.q, std::visit(Middle{}, shape.geometry));
}

Bounds3 bounds(const Shape& shape) {
  return {
      {support(shape, {-1, 0, 0}).x, support(shape, {0, -1, 0}).y, support(shape, {0, 0, -1}).z},
      {support(shape, {1, 0, 0}).x, support(shape, {0, 1, 0}).y, support(shape, {0, 0, 1}).z}};
}

Bounds3 bounds(const std::vector<Shape>& shapes) {
  Bounds3 all = bounds(shapes.front());
  for (const Shape& shape : shapes) {
    const auto [low, high] = bounds(shape);
    all.minimum = {std::min(all.minimum.x, low.x), std::min(all.minimum.y, low.y),
                   std::min(all.minimum.z, low.z)};
    all.maximum = {std::max(all.maximum.x, high.x), std::max(all.maximum.y, high.y),
                   std::max(all.maximum.z, high.z)};
  }
  return all;
}

bool is_open_mesh(const Shape& shape) {
  const auto* mesh = std::get_if<Mesh>(&shape.geometry);
  return mesh && !mesh->triangles->is_closed;
}

double protrusion(const Shape& a, const Shape& b) {
  return std::visit(Protrusion{a, b.placement}, b.geometry);
}

}  // namespace sinew::world
