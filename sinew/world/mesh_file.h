// Meshes from their files: STL (text and binary), OBJ or DAE.
//
// Files are named as models name them: by a path, by file:, or by package://NAME/PATH. Nothing is
// looked for: a package has a declared root, a relative path a declared directory, and without them
// it is an error that says which is missing.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "sinew/world/triangle_mesh.h"

namespace sinew::world {

inline constexpr std::size_t kMaximumMeshBytes = std::size_t{256} << 20;
// Deeper scenes of nodes are no mesh of a robot.
inline constexpr std::size_t kMaximumMeshDepth = 64;
struct MeshLimits {
  std::size_t bytes = kMaximumMeshBytes, depth = kMaximumMeshDepth;
  std::size_t vertices = kMaximumMeshVertices, triangles = kMaximumMeshTriangles;
};

struct MeshFiles {
  std::map<std::string, std::string> packages;  // the root of each, by name
  std::string directory;                        // of relative paths; empty: they are refused
};

// The file's path. Throws Error with the name, and what would be right.
std::string resolve_mesh(const std::string& name, const MeshFiles& files);

// All of its meshes where the file puts them, in the file's own unit, times `scale`; faces with
// more corners are cut into triangles. What a DAE says of its unit counts (metres then); STL and
// OBJ have none, and are taken as they are. Throws Error with the path where there is no such file,
// it is no mesh, it is larger than the limits, or it has a number that is not finite.
Mesh load_mesh(const std::string& path, const Vector3& scale, const MeshLimits& limits = {});

}  // namespace sinew::world
