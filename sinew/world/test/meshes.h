// Meshes for the tests: of a box, of a torus, and of an angle (an L with a height).
#pragma once

#include <cmath>
#include <vector>

#include "sinew/world/triangle_mesh.h"

namespace sinew::world {

struct MeshData {
  std::vector<Vector3> vertices;
  std::vector<Corners> triangles;

  // A face whose corners are seen anticlockwise from outside.
  void face(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  }
  Mesh mesh() const { return {make_mesh(vertices, triangles)}; }
};

// A prism over an anticlockwise outline, whose lids are the given quadrangles.
inline MeshData prism(const std::vector<std::array<double, 2>>& outline, double bottom, double top,
                      const std::vector<std::array<std::uint32_t, 4>>& lids) {
  MeshData data;
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const double z : {bottom, top}) {
    for (const auto& [x, y] : outline) data.vertices.push_back({x, y, z});
  }
  for (std::uint32_t i = 0; i < n; ++i) data.face(i, (i + 1) % n, n + (i + 1) % n, n + i);
  for (const auto& [a, b, c, d] : lids) {
    data.face(d, c, b, a);
    data.face(n + a, n + b, n + c, n + d);
  }
  return data;
}

inline MeshData box_mesh(const Vector3& size) {
  const double x = size.x / 2, y = size.y / 2;
  return prism({{-x, -y}, {x, -y}, {x, y}, {-x, y}}, -size.z / 2, size.z / 2, {{0, 1, 2, 3}});
}

// From the origin `length` along x and along y, both arms `width` wide, `height` high.
inline MeshData angle_mesh(double length, double width, double height) {
  return prism({{0, 0},
                {width, 0},
                {length, 0},
                {length, width},
                {width, width},
                {width, length},
                {0, length},
                {0, width}},
               0, height, {{0, 1, 4, 7}, {1, 2, 3, 4}, {7, 4, 5, 6}});
}

// About z: a tube whose middle is `ring` from the axis. Its corners lie on the true torus.
inline MeshData torus_mesh(double ring, double tube, std::uint32_t around, std::uint32_t across) {
  MeshData data;
  for (std::uint32_t i = 0; i < around; ++i) {
    const double u = 2 * M_PI * i / around;
    for (std::uint32_t k = 0; k < across; ++k) {
      const double v = 2 * M_PI * k / across, far = ring + tube * std::cos(v);
      data.vertices.push_back({far * std::cos(u), far * std::sin(u), tube * std::sin(v)});
    }
  }
  const auto at = [&](std::uint32_t i, std::uint32_t k) {
    return i % around * across + k % across;
  };
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t k = 0; k < across; ++k) {
      data.face(at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
    }
  }
  return data;
}

}  // namespace sinew::world
