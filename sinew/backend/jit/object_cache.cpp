#include "sinew/backend/jit/object_cache.h"

#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

namespace sinew::backend {
namespace {

// FNV-1a (Fowler, Noll & Vo). The folder is trusted; accidents are what this finds.
std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char byte : bytes) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  }
  return hash;
}

// The first line of the file: its own name, and the checksum of what follows.
std::string seal(const std::filesystem::path& path, std::string_view object) {
  return "sinew-object 1 " + path.filename().string() + " " + std::to_string(checksum(object)) +
         "\n";
}

}  // namespace

std::string read_cached(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  if (!std::getline(file, line)) return {};
  std::string object{std::istreambuf_iterator<char>(file), {}};
  if (line + "\n" != seal(path, object)) return {};
  return object;
}

void write_cached(const std::filesystem::path& path, const std::string& object) {
  static std::atomic<unsigned> count = 0;  // threads write parts of their own
  std::error_code ignored;
  std::filesystem::create_directories(path.parent_path(), ignored);
  const std::filesystem::path part =
      path.string() + "." + std::to_string(getpid()) + "." + std::to_string(count++);
  {
    std::ofstream file(part, std::ios::binary);
    file << seal(path, object) << object;
    if (!file.flush()) {
      file.close();
      std::filesystem::remove(part, ignored);
      return;
    }
  }
  std::filesystem::rename(part, path, ignored);
  if (ignored) std::filesystem::remove(part, ignored);
}

}  // namespace sinew::backend
