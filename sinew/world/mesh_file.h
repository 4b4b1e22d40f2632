// How far a mesh reaches, from its file: STL (text and binary), OBJ or DAE.
//
// Files are named as models name them: by a path, by file:, or by package://NAME/PATH. Nothing is
// looked for: a package has a declared root, a relative path a declared directory, and without them
// it is an error that says which is missing.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "sinew/world/shape.h"

namespace sinew::world {

inline constexpr std::size_t kMaximumMeshBytes = std::size_t{256} << 20;
inline constexpr std::size_t kMaximumMeshVertices = std::size_t{1} << 24;

struct MeshFiles {
  std::map<std::string, std::string> packages;  // the root of each, by name
  std::string directory;                        // of relative paths; empty: they are refused
};

// The file's path. Throws Error with the name, and what would be right.
std::string resolve_mesh(const std::string& name, const MeshFiles& files);

// The vertices of all its meshes where the file puts them, in the file's own unit, times `scale`.
// What a DAE says of its unit counts (metres then); STL and OBJ have none, and are taken as they
// are. Throws Error with the path where there is no such file, it is no mesh, it is larger than the
// limits, or it has a number that is not finite.
std::vector<Vector3> load_mesh(const std::string& path, const Vector3& scale);

}  // namespace sinew::world
