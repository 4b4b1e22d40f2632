#include "sinew/world/mesh_library.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <dlfcn.h>

#include "sinew/world/refuse.h"

namespace sinew::world {
namespace {

// The functions of Assimp's C interface that are used; null without the library.
struct Assimp {
  decltype(&aiCreatePropertyStore) create_settings = nullptr;
  decltype(&aiReleasePropertyStore) release_settings = nullptr;
  decltype(&aiSetImportPropertyInteger) set = nullptr;
  decltype(&aiImportFileExWithProperties) import = nullptr;
  decltype(&aiReleaseImport) release = nullptr;
  decltype(&aiGetErrorString) fault = nullptr;
  std::string missing;  // why it cannot be used

  explicit operator bool() const { return missing.empty(); }
};

template <typename Function>
void find(void* library, const char* name, Function& function, std::string& missing) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (function == nullptr) missing = std::string(SINEW_ASSIMP_NAME " has no ") + name;
}

Assimp load() {
  Assimp assimp;
  // Kept for the life of the process.
  void* const library = dlopen(SINEW_ASSIMP_NAME, RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr) {
    assimp.missing = dlerror();
    return assimp;
  }
  find(library, "aiCreatePropertyStore", assimp.create_settings, assimp.missing);
  find(library, "aiReleasePropertyStore", assimp.release_settings, assimp.missing);
  find(library, "aiSetImportPropertyInteger", assimp.set, assimp.missing);
  find(library, "aiImportFileExWithProperties", assimp.import, assimp.missing);
  find(library, "aiReleaseImport", assimp.release, assimp.missing);
  find(library, "aiGetErrorString", assimp.fault, assimp.missing);
  return assimp;
}

}  // namespace

std::shared_ptr<const aiScene> import_mesh(const std::string& path) {
  static const Assimp assimp = load();
  if (!assimp) {
    refuse(path, "the mesh is not read: " + assimp.missing, "Assimp (Debian's libassimp5)");
  }
  aiPropertyStore* const settings = assimp.create_settings();
  assimp.set(settings, AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
  // Everything else that it can do to a mesh is not asked for.
  const aiScene* const scene =
      assimp.import(path.c_str(), aiProcess_Triangulate, nullptr, settings);
  assimp.release_settings(settings);
  if (scene == nullptr) {
    refuse(path, "is no mesh: " + std::string(assimp.fault()), "STL, OBJ or DAE");
  }
  return {scene, assimp.release};
}

}  // namespace sinew::world
