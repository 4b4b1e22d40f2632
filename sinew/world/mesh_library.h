// Assimp, loaded when the first mesh is read. Internal to `world`.
#pragma once

#include <memory>
#include <string>

struct aiScene;

namespace sinew::world {

// What the file holds, as it is: axes are those of the file (Assimp would turn a DAE whose z is
// up). Throws Error if the file is no mesh that Assimp reads, or Assimp is not installed.
std::shared_ptr<const aiScene> import_mesh(const std::string& path);

}  // namespace sinew::world
