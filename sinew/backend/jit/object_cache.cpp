#include "sinew/backend/jit/object_cache.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>

namespace sinew::backend {
namespace {

// FNV-1a (Fowler, Noll & Vo): accidents are what this finds.
std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char byte : bytes) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  }
  return hash;
}

// The first line, without its end.
std::string seal(std::string_view file_name, std::string_view object) {
  return "sinew-object 1 " + std::string(file_name) + " " + std::to_string(checksum(object));
}

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags)
      : number_(::open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0600)) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  bool is_open() const { return number_ >= 0; }
  int get() const { return number_; }

 private:
  int number_;
};

// A file that only this user and root can have written.
bool is_own(const Descriptor& file, struct stat& about) {
  return ::fstat(file.get(), &about) == 0 && S_ISREG(about.st_mode) &&
         (about.st_uid == ::geteuid() || about.st_uid == 0) &&
         (about.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

bool write_all(const Descriptor& file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

// Whoever had the lock before may have given the file its name already, or taken it away.
bool is_still_named(const Descriptor& file, const std::filesystem::path& path) {
  struct stat here {
  }, there{};
  return ::fstat(file.get(), &here) == 0 && ::lstat(path.c_str(), &there) == 0 &&
         here.st_dev == there.st_dev && here.st_ino == there.st_ino;
}

}  // namespace

std::string sealed(std::string_view file_name, std::string_view object) {
  return seal(file_name, object).append("\n").append(object);
}

std::string_view unsealed(std::string_view file_name, std::string_view file) {
  const std::size_t line = file.find('\n');
  if (line == std::string_view::npos) return {};
  const std::string_view object = file.substr(line + 1);
  return file.substr(0, line) == seal(file_name, object) ? object : std::string_view{};
}

std::string read_cached(const std::filesystem::path& path) {
  const Descriptor file(path, O_RDONLY);
  struct stat about {};
  if (!file.is_open() || !is_own(file, about)) return {};
  if (static_cast<std::uintmax_t>(about.st_size) > kLargestCachedFile) return {};
  std::string text(static_cast<std::size_t>(about.st_size), '\0');
  std::size_t got = 0;
  while (got < text.size()) {
    const ssize_t more = ::read(file.get(), text.data() + got, text.size() - got);
    if (more < 0 && errno == EINTR) continue;
    if (more <= 0) return {};
    got += static_cast<std::size_t>(more);
  }
  return std::string(unsealed(path.filename().string(), text));
}

// Under a name of its own until it is whole, and by one at a time: the lock goes with the process,
// so that nobody who is killed stands in the way of the next.
void write_cached(const std::filesystem::path& path, const std::string& object) {
  std::error_code ignored;
  std::filesystem::create_directories(path.parent_path(), ignored);
  const std::filesystem::path part = path.string() + ".part";
  const Descriptor file(part, O_WRONLY | O_CREAT);
  struct stat about {};
  if (!file.is_open() || !is_own(file, about)) return;
  if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0 || !is_still_named(file, part)) return;
  const bool written =
      ::ftruncate(file.get(), 0) == 0 && write_all(file, sealed(path.filename().string(), object));
  if (!written || ::rename(part.c_str(), path.c_str()) != 0) ::unlink(part.c_str());
}

}  // namespace sinew::backend
