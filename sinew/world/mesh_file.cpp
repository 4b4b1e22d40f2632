#include "sinew/world/mesh_file.h"

#include <assimp/scene.h>

#include <cmath>
#include <filesystem>
#include <string_view>

#include "sinew/world/mesh_library.h"
#include "sinew/world/refuse.h"

namespace sinew::world {
namespace {

// Deeper scenes of nodes are no mesh of a robot.
constexpr int kMaximumMeshDepth = 64;

void collect(const aiScene& scene, const aiNode& node, const aiMatrix4x4& above,
             const Vector3& scale, int depth, const std::string& path,
             std::vector<Vector3>& vertices) {
  if (depth > kMaximumMeshDepth) {
    refuse(path, "nodes within nodes, " + std::to_string(kMaximumMeshDepth) + " deep",
           "a flatter mesh");
  }
  const aiMatrix4x4 at = above * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
    if (vertices.size() + mesh.mNumVertices > kMaximumMeshVertices) {
      refuse(path, "more than " + std::to_string(kMaximumMeshVertices) + " vertices",
             "a coarser mesh");
    }
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D p = at * mesh.mVertices[v];
      const Vector3 seen = {scale.x * static_cast<double>(p.x), scale.y * static_cast<double>(p.y),
                            scale.z * static_cast<double>(p.z)};
      if (!std::isfinite(seen.x) || !std::isfinite(seen.y) || !std::isfinite(seen.z)) {
        refuse(path, "a vertex that is not finite", "finite numbers");
      }
      vertices.push_back(seen);
    }
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    collect(scene, *node.mChildren[i], at, scale, depth + 1, path, vertices);
  }
}

}  // namespace

std::string resolve_mesh(const std::string& name, const MeshFiles& files) {
  constexpr std::string_view kPackage = "package://", kFile = "file:";
  std::string path = name;
  if (name.starts_with(kPackage)) {
    const std::size_t slash = name.find('/', kPackage.size());
    const std::string package = name.substr(kPackage.size(), slash - kPackage.size());
    const auto root = files.packages.find(package);
    if (slash == std::string::npos || package.empty()) {
      refuse(name, "names no file of a package", "package://NAME/PATH");
    }
    if (root == files.packages.end()) {
      refuse(name, "the root of the package '" + package + "' is not declared",
             "where the package is, or the file's path");
    }
    return (std::filesystem::path(root->second) / name.substr(slash + 1)).string();
  }
  if (name.starts_with(kFile)) {
    path = name.substr(kFile.size());
    if (path.starts_with("//")) path = path.substr(2);
  } else if (name.find("://") != std::string::npos) {
    refuse(name, "is no file here", "file:, package://NAME/PATH, or a path");
  }
  if (path.empty()) refuse(name, "names no file", "the file of the mesh");
  if (std::filesystem::path(path).is_absolute()) return path;
  if (files.directory.empty()) {
    refuse(name, "is a relative path, and it is not said to what",
           "the directory of meshes, or an absolute path");
  }
  return (std::filesystem::path(files.directory) / path).string();
}

std::vector<Vector3> load_mesh(const std::string& path, const Vector3& scale) {
  std::error_code fault;
  const auto size = std::filesystem::file_size(path, fault);
  if (fault) refuse(path, "the mesh is not read: " + fault.message(), "a file that there is");
  if (size > kMaximumMeshBytes) {
    refuse(path, std::to_string(size) + " bytes", "at most " + std::to_string(kMaximumMeshBytes));
  }
  const std::shared_ptr<const aiScene> scene = import_mesh(path);
  if (!scene->mRootNode) refuse(path, "is a mesh without nodes", "STL, OBJ or DAE");
  std::vector<Vector3> vertices;
  collect(*scene, *scene->mRootNode, aiMatrix4x4(), scale, 0, path, vertices);
  if (vertices.empty()) refuse(path, "a mesh without a vertex", "one with triangles");
  return vertices;
}

}  // namespace sinew::world
