// Memory for texts that live as long as the dictionary: bump allocation in blocks that never move.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace sinew::graph {

class Arena {
 public:
  Arena() = default;
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;
  // Keeps alive what the other holds by now. Precondition: this one is new.
  void share(const Arena& other) { blocks_ = other.blocks_; }

  // Aligned to `alignment`, a power of two up to 8.
  char* allocate(std::size_t size, std::size_t alignment = 1) {
    const std::size_t padding = (alignment - (used_ & (alignment - 1))) & (alignment - 1);
    if (size + padding > room_ - used_) return allocate_block(size);
    used_ += padding;
    char* memory = block_ + used_;
    used_ += size;
    return memory;
  }

 private:
  static constexpr std::size_t kBlock = std::size_t{1} << 16;

  char* allocate_block(std::size_t size) {
    // A large text gets a block of its own, so that the rest of the current one is not wasted.
    if (size > kBlock / 4) {
      blocks_.push_back(std::shared_ptr<char[]>(new char[size]));
      return blocks_.back().get();
    }
    blocks_.push_back(std::shared_ptr<char[]>(new char[kBlock]));
    block_ = blocks_.back().get();
    room_ = kBlock;
    used_ = size;
    return block_;
  }

  char* block_ = nullptr;
  std::size_t room_ = 0;
  std::size_t used_ = 0;
  std::vector<std::shared_ptr<char[]>> blocks_;
};

}  // namespace sinew::graph
