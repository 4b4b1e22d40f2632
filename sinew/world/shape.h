// Shapes of objects and areas, for queries about space. Each shape is convex but for meshes, which
// are their triangles; what is not convex is a mesh, or several shapes, of which it is the union.
// Lengths are in metres.
//
//   const Shape top = {Box{{1.2, 0.8, 0.05}}, placement};     check_shape(top.geometry, iri)
//   distance(cup, top)      how far the two are apart; 0 where they touch or overlap
//   protrusion(cup, top)    by how much a point of the first is outside the second, at most
//   inside(cup, box)        no point of the first is outside the second
//   bounds(cup)             the smallest box along the axes that holds it
//
// The shapes of a question are placed in one frame. Overlap and distance come from Gilbert, Johnson
// and Keerthi 1988 ("A fast procedure for computing the distance between complex objects"), of
// meshes triangle by triangle (triangle_mesh.h).
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "sinew/world/pose.h"

namespace sinew::world {

struct Box {
  Vector3 size;  // about its middle
};
struct Sphere {
  double radius = 0;
};
struct Cylinder {  // about z, with the middle of its axis at the origin
  double radius = 0, height = 0;
};
struct Polygon {  // convex, anticlockwise in x and y, from `bottom` to `top` along z
  std::vector<std::array<double, 2>> outline;
  double bottom = 0, top = 0;
};
struct MeshBounds {  // of a mesh that is not looked at: the box along its axes that holds it
  Vector3 minimum, maximum;
};
struct TriangleMesh;
struct Mesh {  // never null; where it is closed, a solid
  std::shared_ptr<const TriangleMesh> triangles;
};
using Geometry = std::variant<Box, Sphere, Cylinder, Polygon, MeshBounds, Mesh>;

struct Shape {
  Geometry geometry;
  Pose placement;  // of the geometry's axes in the frame that the shape is described in
};

struct Bounds3 {
  Vector3 minimum, maximum;
};

// Two shapes that are nearer than this touch [m]; distances are exact to a tenth of it.
inline constexpr double kTouchingDistance = 1e-6;
inline constexpr std::size_t kMaximumPolygonCorners = 1000;

// Throws Error naming `iri` where a size is not positive or not finite, or an outline not convex.
void check_shape(const Geometry& geometry, std::string_view iri);
MeshBounds mesh_bounds(std::span<const Vector3> vertices);  // Error where there are none

// The shape seen from another frame: X_AB, and the shape in B.
Shape placed(const Pose& X_AB, const Shape& shape_B);
// The point of the shape that is farthest along the direction.
Vector3 support(const Shape& shape, const Vector3& direction);
Vector3 middle(const Shape& shape);  // of its bounds along its own axes
Bounds3 bounds(const Shape& shape);
Bounds3 bounds(const std::vector<Shape>& shapes);  // of all; at least one
double distance(const Shape& a, const Shape& b);
bool touch(const Shape& a, const Shape& b);
// Negative: inside with room to spare. Out of a mesh is out of its bounds: what is in a bin is in
// none of the bin's material.
double protrusion(const Shape& a, const Shape& b);
// To the distance that counts as touching. In a mesh is in the solid that it encloses; nothing is
// in one that is open, nor a mesh in a mesh whose surface it touches.
bool inside(const Shape& a, const Shape& b);
bool is_open_mesh(const Shape& shape);

}  // namespace sinew::world
