// Memory for the many short-lived lists of the passes. A graph of ten thousand nodes is read and
// written a dozen times, each time with a list for every sum: the C library's allocator took a
// fifth of the time of all passes.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew::program {

// Blocks that are free again wait in a list of their size, for the same thread; all are given back
// when the thread ends.
class Pool {
 public:
  static constexpr std::size_t kStep = 32;          // bytes; sizes are multiples of it
  static constexpr std::size_t kLargest = 1024;     // bytes; larger blocks are the library's
  static constexpr std::size_t kChunk = 1U << 18U;  // bytes

  static Pool& of_thread() {
    thread_local Pool pool;
    return pool;
  }

  void* allocate(std::size_t bytes) {
    Free*& list = free_[class_of(bytes)];
    if (list == nullptr) return cut(class_of(bytes) * kStep);
    void* const block = list;
    list = list->next;
    return block;
  }
  void free(void* block, std::size_t bytes) {
    Free*& list = free_[class_of(bytes)];
    list = new (block) Free{list};
  }

 private:
  struct Free {
    Free* next;
  };

  static std::size_t class_of(std::size_t bytes) { return (bytes + kStep - 1) / kStep; }

  void* cut(std::size_t bytes) {
    if (left_ < bytes) {
      chunks_.push_back(std::make_unique_for_overwrite<std::byte[]>(kChunk));
      next_ = chunks_.back().get();
      left_ = kChunk;
    }
    void* const block = next_;
    next_ += bytes;
    left_ -= bytes;
    return block;
  }

  std::array<Free*, kLargest / kStep + 1> free_{};
  std::vector<std::unique_ptr<std::byte[]>> chunks_;
  std::byte* next_ = nullptr;
  std::size_t left_ = 0;
};

// For the containers of the standard library. What one thread has allocated no other may free.
template <typename T>
struct Pooled {
  using value_type = T;
  static_assert(alignof(T) <= alignof(std::max_align_t));

  Pooled() = default;
  template <typename U>
  Pooled(const Pooled<U>&) {}

  T* allocate(std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    return static_cast<T*>(bytes <= Pool::kLargest ? Pool::of_thread().allocate(bytes)
                                                   : ::operator new(bytes));
  }
  void deallocate(T* block, std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    if (bytes <= Pool::kLargest) {
      Pool::of_thread().free(static_cast<void*>(block), bytes);
    } else {
      ::operator delete(static_cast<void*>(block));
    }
  }
  bool operator==(const Pooled&) const { return true; }
};

// For vectors of plain values that grow in order to be written: new ones are left as they are.
template <typename T>
struct Unset : std::allocator<T> {
  static_assert(std::is_trivially_default_constructible_v<T>);
  template <typename U>
  struct rebind {
    using other = Unset<U>;
  };

  template <typename U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;
  }
  template <typename U, typename... Values>
  void construct(U* at, Values&&... values) {
    std::construct_at(at, std::forward<Values>(values)...);
  }
};

template <typename T>
using UnsetVector = std::vector<T, Unset<T>>;

}  // namespace sinew::program
