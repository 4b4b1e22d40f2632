#include "sinew/world/mesh_file.h"

#include <assimp/scene.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "sinew/world/mesh_library.h"
#include "sinew/world/refuse.h"

namespace sinew::world {
namespace {

struct MeshCollector {
  const aiScene& scene;
  const Vector3& scale;
  const MeshLimits& limits;
  const std::string& path;
  std::vector<Vector3> vertices = {};
  std::vector<Corners> triangles = {};

  void collect(const aiMesh& mesh, const aiMatrix4x4& at) {
    if (mesh.mNumVertices > limits.vertices - vertices.size()) {
      refuse(path, "more than " + std::to_string(limits.vertices) + " vertices", "a coarser mesh");
    }
    if (mesh.mNumFaces > limits.triangles - triangles.size()) {
      refuse(path, "more than " + std::to_string(limits.triangles) + " triangles",
             "a coarser mesh");
    }
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D p = at * mesh.mVertices[v];
      vertices.push_back({scale.x * static_cast<double>(p.x), scale.y * static_cast<double>(p.y),
                          scale.z * static_cast<double>(p.z)});
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices == 0) continue;
      const auto corner = [&](unsigned k) {  // a line's last corner is there twice
        return first + face.mIndices[std::min(k, face.mNumIndices - 1)];
      };
      triangles.push_back({corner(0), corner(1), corner(2)});
    }
  }
  void collect(const aiNode& node, const aiMatrix4x4& above, std::size_t depth) {
    if (depth > limits.depth) {
      refuse(path, "nodes within nodes, more than " + std::to_string(limits.depth) + " deep",
             "a flatter mesh");
    }
    const aiMatrix4x4 at = above * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) collect(*scene.mMeshes[node.mMeshes[i]], at);
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      collect(*node.mChildren[i], at, depth + 1);
    }
  }
};

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

Mesh load_mesh(const std::string& path, const Vector3& scale, const MeshLimits& limits) {
  std::error_code fault;
  const auto size = std::filesystem::file_size(path, fault);
  if (fault) refuse(path, "the mesh is not read: " + fault.message(), "a file that there is");
  if (size > limits.bytes) {
    refuse(path, std::to_string(size) + " bytes", "at most " + std::to_string(limits.bytes));
  }
  const std::shared_ptr<const aiScene> scene = import_mesh(path);
  if (!scene->mRootNode) refuse(path, "is a mesh without nodes", "STL, OBJ or DAE");
  MeshCollector collector{*scene, scale, limits, path};
  collector.collect(*scene->mRootNode, aiMatrix4x4(), 0);
  try {
    return {make_mesh(collector.vertices, collector.triangles)};
  } catch (const Error& error) {
    const Problem& problem = error.problems().front();
    refuse(path, problem.what, problem.remedy);
  }
}

}  // namespace sinew::world
