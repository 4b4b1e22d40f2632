#include "sinew/runtime/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "sinew/base/error.h"

namespace sinew::runtime {

OutputFile::OutputFile(const std::string& path)
    : path_(path), file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)) {
  if (file_ < 0) {
    throw Error(Problem{{path, 0, 0},
                        "",
                        std::string("cannot be written: ") + std::strerror(errno),
                        "name a file in a folder that exists and may be written",
                        {},
                        {}});
  }
  buffer_.reserve(2 * kBuffer);
}

OutputFile::~OutputFile() { close(); }

bool OutputFile::write(std::string_view bytes) {
  if (!fault_.empty()) return false;
  buffer_ += bytes;
  position_ += bytes.size();
  return buffer_.size() < kBuffer || flush();
}

bool OutputFile::flush() {
  if (!fault_.empty()) return false;
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t written = ::write(file_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      fault_ = path_ + ": " + std::strerror(errno);
      buffer_.clear();
      return false;
    }
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  buffer_.clear();
  return true;
}

bool OutputFile::close() {
  if (file_ < 0) return fault_.empty();
  flush();
  if (::close(file_) != 0 && fault_.empty()) fault_ = path_ + ": " + std::strerror(errno);
  file_ = -1;
  return fault_.empty();
}

}  // namespace sinew::runtime
