// Memory that is handed out piece by piece and given back all at once: documents, contexts and
// expanded forms are made of many small parts with one common life.
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sinew::json {

class Arena {
 public:
  // More than this in one arena is an Error: it bounds what a hostile document can make us
  // allocate.
  static constexpr std::size_t kMaxBytes = std::size_t{1} << 30;

  explicit Arena(std::size_t first_block_bytes = 4096) : next_block_(first_block_bytes) {}
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  // Uninitialised memory for `count` values of a type that needs no destructor.
  template <typename T>
  T* allocate(std::size_t count = 1) {
    static_assert(std::is_trivially_destructible_v<T>);
    if (count > kMaxBytes / sizeof(T)) throw_full();
    return static_cast<T*>(bytes(count * sizeof(T), alignof(T)));
  }

  std::string_view copy(std::string_view text);
  std::string_view concat(std::string_view first, std::string_view second);

  std::size_t used() const { return used_; }

 private:
  void* bytes(std::size_t size, std::size_t alignment);
  void* bytes_in_new_block(std::size_t size);
  [[noreturn]] static void throw_full();

  std::vector<std::unique_ptr<std::byte[]>> blocks_;
  std::byte* free_ = nullptr;
  std::byte* end_ = nullptr;
  std::size_t next_block_;
  std::size_t used_ = 0;
};

inline void* Arena::bytes(std::size_t size, std::size_t alignment) {
  const auto address = reinterpret_cast<std::uintptr_t>(free_);
  const std::size_t padding = (alignment - address % alignment) % alignment;
  if (free_ == nullptr || static_cast<std::size_t>(end_ - free_) < size + padding) {
    return bytes_in_new_block(size);
  }
  std::byte* result = free_ + padding;
  free_ = result + size;
  return result;
}

}  // namespace sinew::json
