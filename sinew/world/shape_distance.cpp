// What two shapes have of each other: convex ones by their nearest points (convex_distance.h),
// meshes triangle by triangle, as far as the trees of boxes leave them open.
#include <algorithm>
#include <cmath>

#include "sinew/world/box_triangle.h"
#include "sinew/world/convex_distance.h"
#include "sinew/world/triangle_mesh.h"

namespace sinew::world {
namespace {

using math::dot;

const TriangleMesh* mesh_of(const Shape& shape) {
  const auto* mesh = std::get_if<Mesh>(&shape.geometry);
  return mesh ? mesh->triangles.get() : nullptr;
}

double box_distance(const Bounds3& a, const Bounds3& b) {
  const auto gap = [](double a_low, double a_high, double b_low, double b_high) {
    return std::max({0.0, b_low - a_high, a_low - b_high});
  };
  const double x = gap(a.minimum.x, a.maximum.x, b.minimum.x, b.maximum.x);
  const double y = gap(a.minimum.y, a.maximum.y, b.minimum.y, b.maximum.y);
  const double z = gap(a.minimum.z, a.maximum.z, b.minimum.z, b.maximum.z);
  return std::sqrt(x * x + y * y + z * z);
}

// The box around a box that is turned and moved.
Bounds3 turned(const math::Pose<double>& X, const Bounds3& box) {
  const Vector3 half = 0.5 * (box.maximum - box.minimum);
  const Vector3 centre = X.p + X.R * (box.minimum + half);
  const auto& R = X.R;
  const Vector3 reach = {
      std::abs(R.xx) * half.x + std::abs(R.xy) * half.y + std::abs(R.xz) * half.z,
      std::abs(R.yx) * half.x + std::abs(R.yy) * half.y + std::abs(R.yz) * half.z,
      std::abs(R.zx) * half.x + std::abs(R.zy) * half.y + std::abs(R.zz) * half.z};
  return {centre - reach, centre + reach};
}

// The nearest triangle of a mesh to a convex shape, both seen from the mesh; what is farther than
// `enough` is not looked for, and 0 ends the search.
struct NearestTriangle {
  const TriangleMesh& mesh;
  Shape shape;
  Bounds3 box = bounds(shape);
  ConvexShape convex{shape};
  BoxTriangle by_axes{shape};
  double best;

  NearestTriangle(const TriangleMesh& of, const Pose& X_mesh, const Shape& other, double enough)
      : mesh(of), shape(placed(invert(X_mesh), other)), best(enough) {}

  void triangle(std::uint32_t index) {
    const Triangle triangle{mesh.corners(index)};
    if (by_axes) {
      const auto verdict = by_axes.judge(triangle.corners, best);
      if (verdict == BoxTriangle::Verdict::kApart) return;
      if (verdict == BoxTriangle::Verdict::kOverlap) {
        best = 0;
        return;
      }
    }
    best = std::min(best, convex_distance(triangle, convex, best));
  }
  void visit(std::uint32_t index) {
    const TriangleMesh::Node& node = mesh.tree[index];
    for (std::uint32_t i = node.first; i < node.first + node.count && best > 0; ++i) triangle(i);
    if (node.count > 0) return;
    const double left = box_distance(mesh.tree[index + 1].box, box);
    const double right = box_distance(mesh.tree[node.first].box, box);
    const std::uint32_t near = left <= right ? index + 1 : node.first;
    const std::uint32_t far = left <= right ? node.first : index + 1;
    if (best > 0 && std::min(left, right) <= best) visit(near);
    if (best > 0 && std::max(left, right) <= best) visit(far);
  }
  double search() {
    if (box_distance(mesh.bounds(), box) <= best) visit(0);
    return best;
  }
};

// The nearest triangles of two meshes, seen from the first.
struct NearestTriangles {
  const TriangleMesh &a, &b;
  math::Pose<double> X_ab;
  double best;

  void leaves(const TriangleMesh::Node& of_a, const TriangleMesh::Node& of_b) {
    for (std::uint32_t j = of_b.first; j < of_b.first + of_b.count; ++j) {
      Triangle second{b.corners(j)};
      for (Vector3& corner : second.corners) corner = X_ab.p + X_ab.R * corner;
      for (std::uint32_t i = of_a.first; i < of_a.first + of_a.count && best > 0; ++i) {
        best = std::min(best, convex_distance(Triangle{a.corners(i)}, second, best));
      }
    }
  }
  double apart(std::uint32_t i, std::uint32_t j) const {
    return box_distance(a.tree[i].box, turned(X_ab, b.tree[j].box));
  }
  void visit(std::uint32_t i, std::uint32_t j) {
    const TriangleMesh::Node &of_a = a.tree[i], &of_b = b.tree[j];
    if (of_a.count > 0 && of_b.count > 0) return leaves(of_a, of_b);
    const auto size = [](const Bounds3& box) {
      const Vector3 d = box.maximum - box.minimum;
      return dot(d, d);
    };
    const bool split_a = of_b.count > 0 || (of_a.count == 0 && size(of_a.box) >= size(of_b.box));
    std::array<std::pair<std::uint32_t, std::uint32_t>, 2> pairs =
        split_a ? std::array{std::pair{i + 1, j}, std::pair{of_a.first, j}}
                : std::array{std::pair{i, j + 1}, std::pair{i, of_b.first}};
    std::array<double, 2> gap = {apart(pairs[0].first, pairs[0].second),
                                 apart(pairs[1].first, pairs[1].second)};
    if (gap[1] < gap[0]) std::swap(gap[0], gap[1]), std::swap(pairs[0], pairs[1]);
    for (std::size_t k = 0; k < 2; ++k) {
      if (best > 0 && gap[k] <= best) visit(pairs[k].first, pairs[k].second);
    }
  }
  double search() {
    if (apart(0, 0) <= best) visit(0, 0);
    return best;
  }
};

// A part of the first mesh lies within the second; their surfaces are apart.
bool has_part_in(const TriangleMesh& a, const TriangleMesh& b, const Pose& X_ba) {
  return b.is_closed && std::any_of(a.parts.begin(), a.parts.end(), [&](std::uint32_t vertex) {
           return encloses(b, X_ba.p + rotate(X_ba.q, a.vertices[vertex]));
         });
}

double surface_distance(const TriangleMesh& a, const Pose& X_a, const TriangleMesh& b,
                        const Pose& X_b, double enough) {
  return NearestTriangles{a, b, to_matrix(compose(invert(X_a), X_b)), enough}.search();
}

double mesh_distance(const Shape& of_mesh, const Shape& other, double enough) {
  const TriangleMesh& mesh = *mesh_of(of_mesh);
  const Pose& X_mesh = of_mesh.placement;
  if (const TriangleMesh* const second = mesh_of(other)) {
    const double apart = surface_distance(mesh, X_mesh, *second, other.placement, enough);
    const Pose X = compose(invert(X_mesh), other.placement);  // of the second in the first
    const bool within =
        apart > 0 && (has_part_in(*second, mesh, X) || has_part_in(mesh, *second, invert(X)));
    return within ? 0 : apart;
  }
  NearestTriangle nearest(mesh, X_mesh, other, enough);
  const double apart = nearest.search();
  return apart > 0 && encloses(mesh, support(nearest.shape, {1, 0, 0})) ? 0 : apart;
}

// Each side of the outline moved inwards: what is left of the outline, side by side (Sutherland and
// Hodgman 1974).
std::vector<std::array<double, 2>> inner(const std::vector<std::array<double, 2>>& outline,
                                         double by) {
  std::vector<std::array<double, 2>> left = outline;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto &from = outline[i], &to = outline[(i + 1) % outline.size()];
    const double x = to[0] - from[0], y = to[1] - from[1], size = std::hypot(x, y);
    const auto inside = [&](const std::array<double, 2>& p) {
      return (x * (p[1] - from[1]) - y * (p[0] - from[0])) / size - by;
    };
    std::vector<std::array<double, 2>> clipped;
    for (std::size_t k = 0; k < left.size(); ++k) {
      const auto &a = left[k], &b = left[(k + 1) % left.size()];
      const double of_a = inside(a), of_b = inside(b);
      if (of_a >= 0) clipped.push_back(a);
      if ((of_a < 0) != (of_b < 0)) {
        const double share = of_a / (of_a - of_b);
        clipped.push_back({a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])});
      }
    }
    left = std::move(clipped);
  }
  return left;
}

// The shape without what is nearer to its surface than `by`. What is thinner than that has nothing
// left, and stays as it is.
Shape shrunk(const Shape& shape, double by) {
  struct Shrink {
    double by;
    Geometry operator()(const Box& box) const {
      const Vector3 size = box.size - Vector3{2 * by, 2 * by, 2 * by};
      return Box{{std::max(size.x, 0.0), std::max(size.y, 0.0), std::max(size.z, 0.0)}};
    }
    Geometry operator()(const Sphere& sphere) const {
      return Sphere{std::max(0.0, sphere.radius - by)};
    }
    Geometry operator()(const Cylinder& cylinder) const {
      return Cylinder{std::max(0.0, cylinder.radius - by), std::max(0.0, cylinder.height - 2 * by)};
    }
    Geometry operator()(const Polygon& polygon) const {
      auto outline = inner(polygon.outline, by);
      if (outline.empty()) outline = polygon.outline;
      const double middle = 0.5 * (polygon.bottom + polygon.top);
      return Polygon{std::move(outline), std::min(middle, polygon.bottom + by),
                     std::max(middle, polygon.top - by)};
    }
    Geometry operator()(const MeshBounds& mesh) const {
      const Vector3 margin = {by, by, by}, middle = 0.5 * (mesh.minimum + mesh.maximum);
      const Vector3 low = mesh.minimum + margin, high = mesh.maximum - margin;
      return MeshBounds{
          {std::min(low.x, middle.x), std::min(low.y, middle.y), std::min(low.z, middle.z)},
          {std::max(high.x, middle.x), std::max(high.y, middle.y), std::max(high.z, middle.z)}};
    }
    Geometry operator()(const Mesh& mesh) const { return mesh; }
  };
  return {std::visit(Shrink{by}, shape.geometry), shape.placement};
}

bool inside_mesh(const Shape& a, const Shape& of_mesh) {
  const TriangleMesh& mesh = *mesh_of(of_mesh);
  if (!mesh.is_closed) return false;
  if (const TriangleMesh* const second = mesh_of(a)) {
    const Pose X = compose(invert(of_mesh.placement), a.placement);
    return surface_distance(mesh, of_mesh.placement, *second, a.placement, INFINITY) >
               kTouchingDistance &&
           std::all_of(second->parts.begin(), second->parts.end(),
                       [&](std::uint32_t vertex) {
                         return encloses(mesh, X.p + rotate(X.q, second->vertices[vertex]));
                       }) &&
           !has_part_in(mesh, *second, invert(X));
  }
  const Shape core = shrunk(a, kTouchingDistance);
  NearestTriangle nearest(mesh, of_mesh.placement, core, kTouchingDistance);
  if (nearest.search() <= 0) return false;
  Vector3 within;  // of six points on the surface the mean
  for (const Vector3& d : {Vector3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
    within = within + (1.0 / 6) * (support(nearest.shape, d) + support(nearest.shape, -d));
  }
  return encloses(mesh, within);
}

}  // namespace

double distance(const Shape& a, const Shape& b) {
  if (mesh_of(a)) return mesh_distance(a, b, INFINITY);
  if (mesh_of(b)) return mesh_distance(b, a, INFINITY);
  return convex_distance(ConvexShape{a}, ConvexShape{b});
}

bool touch(const Shape& a, const Shape& b) {
  // Just above: a search that finds nothing nearer gives back what it was told to be enough.
  constexpr double kEnough = 2 * kTouchingDistance;
  const double apart = mesh_of(a)   ? mesh_distance(a, b, kEnough)
                       : mesh_of(b) ? mesh_distance(b, a, kEnough)
                                    : convex_distance(ConvexShape{a}, ConvexShape{b}, kEnough);
  return apart <= kTouchingDistance;
}

bool inside(const Shape& a, const Shape& b) {
  return mesh_of(b) ? inside_mesh(a, b) : protrusion(a, b) <= kTouchingDistance;
}

}  // namespace sinew::world
