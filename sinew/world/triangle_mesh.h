// Triangles of a mesh with a tree of boxes around them, made once and shared by all the shapes that
// have the mesh; and whether a point is enclosed by them.
//
// A mesh whose every edge is passed as often in one direction as in the other has an inside: it is
// a solid, and a point is in it where the surface winds around the point. Any other mesh is a
// surface that encloses nothing. Vertices at the same place are one; lines and points count as
// triangles without a face.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "sinew/world/shape.h"

namespace sinew::world {

inline constexpr std::size_t kMaximumMeshVertices = std::size_t{1} << 24;
inline constexpr std::size_t kMaximumMeshTriangles = std::size_t{1} << 22;

using Corners = std::array<std::uint32_t, 3>;  // of a triangle, by vertex

struct TriangleMesh {
  // Nodes lie in the order of a walk that goes left first: a node's left child is the next one.
  struct Node {
    Bounds3 box;
    std::uint32_t first = 0;  // of a leaf its first triangle, otherwise the right child
    std::uint32_t count = 0;  // triangles of a leaf; 0: no leaf
  };
  std::vector<Vector3> vertices;  // in the mesh's own axes
  std::vector<Corners> triangles;
  std::vector<Node> tree;            // the root first
  std::vector<std::uint32_t> parts;  // a vertex of each connected part
  bool is_closed = false;

  const Bounds3& bounds() const { return tree.front().box; }
  std::array<Vector3, 3> corners(std::uint32_t triangle) const {
    const auto& [a, b, c] = triangles[triangle];
    return {vertices[a], vertices[b], vertices[c]};
  }
};

// Throws Error where there is no triangle, there are more than the limits, a corner is no vertex,
// or a number is not finite.
std::shared_ptr<const TriangleMesh> make_mesh(std::span<const Vector3> vertices,
                                              std::span<const Corners> triangles);

// Whether the solid has this point, seen from the mesh's axes. Which side of the surface a point
// is on that is nearer to it than what touches (kTouchingDistance) is not decided.
bool encloses(const TriangleMesh& mesh, const Vector3& point);

// The vertex for which `value` is largest. `most` bounds it for all that is in a box.
template <typename Most, typename Value>
Vector3 farthest_vertex(const TriangleMesh& mesh, const Most& most, const Value& value) {
  double best = -std::numeric_limits<double>::infinity();
  Vector3 found = mesh.vertices.front();
  const auto visit = [&](const auto& self, std::uint32_t index) -> void {
    const TriangleMesh::Node& node = mesh.tree[index];
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      for (const std::uint32_t corner : mesh.triangles[i]) {
        const double here = value(mesh.vertices[corner]);
        if (here > best) best = here, found = mesh.vertices[corner];
      }
    }
    if (node.count > 0) return;
    const double left = most(mesh.tree[index + 1].box), right = most(mesh.tree[node.first].box);
    const std::uint32_t near = left >= right ? index + 1 : node.first;
    const std::uint32_t far = left >= right ? node.first : index + 1;
    if (std::max(left, right) > best) self(self, near);
    if (std::min(left, right) > best) self(self, far);
  };
  visit(visit, 0);
  return found;
}

}  // namespace sinew::world
