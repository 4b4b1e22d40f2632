#include "output.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

#include "sinew/base/error.h"

namespace sinew::cli {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error({{path, 0, 0}, "", what, std::strerror(errno), Severity::kError, {}});
}

}  // namespace

void write_output(const std::string& path, const std::string& text) {
  if (path.empty()) {
    std::cout << text << std::flush;
    if (!std::cout) fail("standard output", "cannot be written");
    return;
  }
  namespace fs = std::filesystem;
  const fs::path target(path);
  std::error_code ignored;
  if (target.has_parent_path()) fs::create_directories(target.parent_path(), ignored);
  // A device or a pipe is written to; only a file may be replaced by another one.
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) {
    std::ofstream file(target, std::ios::binary);
    file << text << std::flush;
    if (!file) fail(path, "cannot be written");
    return;
  }
  const fs::path part = target.string() + ".part";
  {
    std::ofstream file(part, std::ios::binary);
    file << text << std::flush;
    if (!file) {
      fs::remove(part, ignored);
      fail(path, "cannot be written");
    }
  }
  std::error_code renamed;
  fs::rename(part, target, renamed);
  if (renamed) {
    fs::remove(part, ignored);
    errno = renamed.value();
    fail(path, "cannot be written");
  }
}

std::string read_input(const std::string& path) {
  if (path == "-") return {std::istreambuf_iterator<char>(std::cin), {}};
  if (std::filesystem::is_directory(path)) {
    errno = EISDIR;
    fail(path, "cannot be read");
  }
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || (file.peek() != std::ifstream::traits_type::eof() && !(text << file.rdbuf()))) {
    fail(path, "cannot be read");
  }
  return std::move(text).str();
}

}  // namespace sinew::cli
