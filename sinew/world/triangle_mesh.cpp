#include "sinew/world/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <unordered_map>

#include "sinew/world/refuse.h"

namespace sinew::world {
namespace {

using math::cross;
using math::dot;

constexpr std::size_t kLeafTriangles = 4;

struct SamePlace {
  std::size_t operator()(const Vector3& v) const {
    std::size_t hash = 0;
    for (const double x : {v.x, v.y, v.z}) {
      hash = (hash ^ std::hash<double>()(x)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return hash;
  }
  bool operator()(const Vector3& a, const Vector3& b) const {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
};

double coordinate(const Vector3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

void include(Bounds3& box, const Vector3& v) {
  box.minimum = {std::min(box.minimum.x, v.x), std::min(box.minimum.y, v.y),
                 std::min(box.minimum.z, v.z)};
  box.maximum = {std::max(box.maximum.x, v.x), std::max(box.maximum.y, v.y),
                 std::max(box.maximum.z, v.z)};
}

// Halves at the median of the middles along the longest side: as deep as the logarithm of their
// number.
struct TreeBuilder {
  TriangleMesh& mesh;
  std::vector<Vector3> middles;      // three times
  std::vector<std::uint32_t> order;  // of the triangles

  void build(std::uint32_t first, std::uint32_t count) {
    const auto index = static_cast<std::uint32_t>(mesh.tree.size());
    mesh.tree.emplace_back();
    const Vector3 start = mesh.corners(order[first])[0];
    Bounds3 box = {start, start}, of_middles = {middles[order[first]], middles[order[first]]};
    for (std::uint32_t i = first; i < first + count; ++i) {
      for (const Vector3& corner : mesh.corners(order[i])) include(box, corner);
      include(of_middles, middles[order[i]]);
    }
    mesh.tree[index].box = box;
    if (count <= kLeafTriangles) {
      mesh.tree[index].first = first;
      mesh.tree[index].count = count;
      return;
    }
    const Vector3 size = of_middles.maximum - of_middles.minimum;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t half = count / 2;
    std::nth_element(order.begin() + first, order.begin() + first + half,
                     order.begin() + first + count, [&](std::uint32_t a, std::uint32_t b) {
                       return coordinate(middles[a], axis) < coordinate(middles[b], axis);
                     });
    build(first, half);
    mesh.tree[index].first = static_cast<std::uint32_t>(mesh.tree.size());
    build(first + half, count - half);
  }
};

void build_tree(TriangleMesh& mesh) {
  TreeBuilder builder{mesh, {}, std::vector<std::uint32_t>(mesh.triangles.size())};
  builder.middles.reserve(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, c] = mesh.corners(i);
    builder.middles.push_back(a + b + c);
  }
  std::iota(builder.order.begin(), builder.order.end(), 0u);
  builder.build(0, static_cast<std::uint32_t>(mesh.triangles.size()));
  std::vector<Corners> sorted;
  sorted.reserve(mesh.triangles.size());
  for (const std::uint32_t i : builder.order) sorted.push_back(mesh.triangles[i]);
  mesh.triangles = std::move(sorted);
}

// Each edge as often there as back.
bool closed(const TriangleMesh& mesh) {
  std::vector<std::pair<std::uint64_t, int>> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Corners& corners : mesh.triangles) {
    const auto& [a, b, c] = corners;
    if (a == b || b == c || c == a) continue;
    for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) {
      const std::uint64_t key = std::uint64_t{std::min(from, to)} << 32 | std::max(from, to);
      edges.emplace_back(key, from < to ? 1 : -1);
    }
  }
  if (edges.empty()) return false;
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();) {
    const std::uint64_t key = edges[i].first;
    int balance = 0;
    for (; i < edges.size() && edges[i].first == key; ++i) balance += edges[i].second;
    if (balance != 0) return false;
  }
  return true;
}

// A vertex of each set of triangles that share vertices, by a forest with halved paths.
std::vector<std::uint32_t> connected_parts(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> above(mesh.vertices.size());
  std::iota(above.begin(), above.end(), 0u);
  const auto root = [&](std::uint32_t vertex) {
    while (above[vertex] != vertex) vertex = above[vertex] = above[above[vertex]];
    return vertex;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    above[root(b)] = root(a);
    above[root(c)] = root(a);
  }
  std::vector<std::uint32_t> parts;
  for (std::uint32_t vertex = 0; vertex < above.size(); ++vertex) {
    if (above[vertex] == vertex) parts.push_back(vertex);
  }
  return parts;
}

// ---- how often the surface winds around a point ----

// Crossings of a ray, those that lead out less those that lead in; nothing where the ray comes so
// near to an edge, or so nearly along a face, that it is not certain. Möller and Trumbore 1997.
std::optional<int> crossings(const TriangleMesh& mesh, const Vector3& origin, const Vector3& d) {
  constexpr double kUncertain = 1e-9;  // of the triangle's size
  int sum = 0;
  bool is_certain = true;
  const auto meets = [&](const Bounds3& box) {
    double enter = 0, leave = INFINITY;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = coordinate(origin, axis), along = coordinate(d, axis);
      const double slack = kUncertain * (1 + std::abs(at));
      const double low = (coordinate(box.minimum, axis) - slack - at) / along;
      const double high = (coordinate(box.maximum, axis) + slack - at) / along;
      enter = std::max(enter, std::min(low, high));
      leave = std::min(leave, std::max(low, high));
    }
    return enter <= leave;
  };
  const auto cross_triangle = [&](std::uint32_t triangle) {
    const auto [a, b, c] = mesh.corners(triangle);
    const Vector3 u = b - a, v = c - a, h = cross(d, v), normal = cross(u, v);
    const double size = std::sqrt(dot(normal, normal));
    if (size == 0) return;  // no face
    const double determinant = dot(u, h);
    if (std::abs(determinant) <= kUncertain * size) {
      is_certain = false;
      return;
    }
    const Vector3 s = origin - a, q = cross(s, u);
    const double of_u = dot(s, h) / determinant, of_v = dot(d, q) / determinant;
    const double least = std::min({of_u, of_v, 1 - of_u - of_v});
    if (least < -kUncertain || dot(v, q) / determinant < 0) return;
    is_certain = is_certain && least > kUncertain;
    sum += determinant < 0 ? 1 : -1;
  };
  const auto visit = [&](const auto& self, std::uint32_t index) -> void {
    const TriangleMesh::Node& node = mesh.tree[index];
    if (!is_certain || !meets(node.box)) return;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) cross_triangle(i);
    if (node.count > 0) return;
    self(self, index + 1);
    self(self, node.first);
  };
  visit(visit, 0);
  return is_certain ? std::optional(sum) : std::nullopt;
}

// The sum of the solid angles under which the triangles are seen (van Oosterom and Strackee 1983),
// in turns: a pass over all of them, and certain.
double solid_angles(const TriangleMesh& mesh, const Vector3& point) {
  double sum = 0;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    auto [a, b, c] = mesh.corners(i);
    a = a - point, b = b - point, c = c - point;
    const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
    sum += std::atan2(dot(a, cross(b, c)),
                      la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (2 * std::numbers::pi);
}

}  // namespace

std::shared_ptr<const TriangleMesh> make_mesh(std::span<const Vector3> vertices,
                                              std::span<const Corners> triangles) {
  if (triangles.empty()) refuse({}, "a mesh without triangles", "at least one");
  if (triangles.size() > kMaximumMeshTriangles || vertices.size() > kMaximumMeshVertices) {
    refuse({},
           "a mesh of " + std::to_string(triangles.size()) + " triangles and " +
               std::to_string(vertices.size()) + " vertices",
           "at most " + std::to_string(kMaximumMeshTriangles) + " and " +
               std::to_string(kMaximumMeshVertices));
  }
  auto mesh = std::make_shared<TriangleMesh>();
  std::unordered_map<Vector3, std::uint32_t, SamePlace, SamePlace> numbers;
  numbers.reserve(vertices.size());
  mesh->triangles.reserve(triangles.size());
  for (const Corners& corners : triangles) {
    Corners welded{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (corners[k] >= vertices.size()) {
        refuse({}, "corner " + std::to_string(corners[k]) + " of a triangle is no vertex",
               "below " + std::to_string(vertices.size()));
      }
      const Vector3& v = vertices[corners[k]];
      if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
        refuse({}, "a vertex that is not finite", "finite numbers");
      }
      const auto [found, fresh] =
          numbers.try_emplace(v, static_cast<std::uint32_t>(mesh->vertices.size()));
      if (fresh) mesh->vertices.push_back(v);
      welded[k] = found->second;
    }
    mesh->triangles.push_back(welded);
  }
  build_tree(*mesh);
  mesh->is_closed = closed(*mesh);
  mesh->parts = connected_parts(*mesh);
  return mesh;
}

bool encloses(const TriangleMesh& mesh, const Vector3& point) {
  if (!mesh.is_closed) return false;
  const auto& [low, high] = mesh.bounds();
  if (point.x < low.x || point.y < low.y || point.z < low.z || point.x > high.x ||
      point.y > high.y || point.z > high.z) {
    return false;
  }
  constexpr Vector3 kDirections[] = {
      {0.8017, 0.4532, 0.3897}, {-0.3571, 0.7213, -0.5934}, {0.2719, -0.6151, -0.7402}};
  for (const Vector3& direction : kDirections) {
    if (const auto windings = crossings(mesh, point, direction)) return *windings != 0;
  }
  return std::abs(solid_angles(mesh, point)) > 0.5;
}

}  // namespace sinew::world
