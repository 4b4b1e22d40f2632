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

Output::Output(const std::string& path) : path_(path), out_(&std::cout) {
  if (path.empty()) return;
  namespace fs = std::filesystem;
  const fs::path target(path);
  std::error_code ignored;
  if (target.has_parent_path()) fs::create_directories(target.parent_path(), ignored);
  // A device or a pipe is written to; only a file may be replaced by another one.
  if (!fs::exists(target, ignored) || fs::is_regular_file(target, ignored)) part_ = path + ".part";
  file_.open(part_.empty() ? path : part_, std::ios::binary);
  out_ = &file_;
  require(file_.is_open());
}

Output::~Output() {
  std::error_code ignored;
  if (!part_.empty()) std::filesystem::remove(part_, ignored);
}

void Output::require(bool good) const {
  if (!good) fail(path_.empty() ? "standard output" : path_, "cannot be written");
}

void Output::write(const std::string& text) {
  *out_ << text << std::flush;
  require(out_->good());
}

void Output::end() {
  if (path_.empty()) return;
  file_.close();
  require(file_.good());
  if (part_.empty()) return;
  std::error_code fault;
  std::filesystem::rename(part_, path_, fault);
  errno = fault.value();
  require(!fault);
  part_.clear();
}

void write_output(const std::string& path, const std::string& text) {
  Output output(path);
  output.write(text);
  output.end();
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
