// An array whose elements never move: it grows by chunks, each as large as all before it together,
// so an element is reached with a bit count and without a branch.
//
// One thread may append while others read elements whose index was published to them. Elements
// start as zero bytes, or, where whoever reserves one writes all of it, as whatever the memory
// holds.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>

#include "sinew/graph/pages.h"

namespace sinew::graph {

enum class Fill { kZero, kRaw };

template <typename T, Fill fill = Fill::kZero>
class StableArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  // The first chunk takes at most 16 KiB.
  static constexpr std::uint32_t kFirstBits =
      std::bit_width((std::size_t{1} << 14) / sizeof(T)) - 1;

  StableArray() = default;
  StableArray(const StableArray&) = delete;
  StableArray& operator=(const StableArray&) = delete;
  ~StableArray() {
    for (std::uint32_t top = 0; top < kTops; top = next_chunk(top)) {
      const std::uintptr_t base = bases_[top].load(std::memory_order_relaxed);
      if (base) release_pages(at(base, first(top)), capacity(top) * sizeof(T));
    }
  }

  // Precondition: `index` was reserved.
  T& operator[](std::uint32_t index) { return *locate(index); }
  const T& operator[](std::uint32_t index) const { return *locate(index); }
  // The same where the index is not 0: a cycle sooner, which counts where each element leads to the
  // next one.
  const T& listed(std::uint32_t index) const {
    return *at(bases_[top_bit(index)].load(std::memory_order_acquire), index);
  }

  // The element, or null where nothing was ever reserved.
  const T* find(std::uint32_t index) const {
    const std::uintptr_t base = bases_[top_bit(index | 1)].load(std::memory_order_acquire);
    return base ? at(base, index) : nullptr;
  }

  // Asks for the element, which is about to be written; one that was never reserved does no harm.
  void prefetch(std::uint32_t index) const { __builtin_prefetch(locate(index), 1); }

  // Makes the element at `index` exist. Writer only.
  T& reserve(std::uint32_t index) {
    const std::uint32_t top = top_bit(index | 1);
    if (!bases_[top].load(std::memory_order_relaxed)) [[unlikely]] {
      allocate(top);
    }
    return *at(bases_[top].load(std::memory_order_relaxed), index);
  }

  // Makes elements [0, count) equal to the other's, byte by byte. Precondition: this one is new.
  void copy_from(const StableArray& other, std::uint32_t count) {
    for (std::uint32_t top = 0; top < kTops && first(top) < count; top = next_chunk(top)) {
      allocate(top);
      const std::size_t used = std::min<std::size_t>(count - first(top), capacity(top));
      std::memcpy(static_cast<void*>(locate(first(top))), other.locate(first(top)),
                  used * sizeof(T));
    }
  }

 private:
  // Chunks are told by the highest bit of their indices, all that are below kFirstBits are one.
  static constexpr std::uint32_t kTops = 32;
  // Precondition: index > 0.
  static std::uint32_t top_bit(std::uint32_t index) {
    return 31 ^ static_cast<std::uint32_t>(__builtin_clz(index));
  }
  static std::uint32_t next_chunk(std::uint32_t top) { return std::max(kFirstBits, top + 1); }
  static std::uint32_t first(std::uint32_t top) {
    return top < kFirstBits ? 0 : std::uint32_t{1} << top;
  }
  static std::size_t capacity(std::uint32_t top) {
    return std::size_t{1} << std::max(kFirstBits, top);
  }
  static T* at(std::uintptr_t base, std::uint32_t index) {
    return reinterpret_cast<T*>(base + std::size_t{index} * sizeof(T));  // NOLINT(*-int-to-ptr)
  }
  T* locate(std::uint32_t index) const {
    return at(bases_[top_bit(index | 1)].load(std::memory_order_acquire), index);
  }
  void allocate(std::uint32_t top) {
    const std::size_t size = capacity(top) * sizeof(T);
    void* const memory = fill == Fill::kZero ? allocate_zeroed(size) : allocate_raw(size);
    const std::uintptr_t base =
        reinterpret_cast<std::uintptr_t>(memory) - std::size_t{first(top)} * sizeof(T);
    if (base == 0) throw std::bad_alloc();  // no system puts a chunk so low
    const std::uint32_t begin = top < kFirstBits ? 0 : top;
    for (std::uint32_t each = begin; each < next_chunk(top); ++each) {
      bases_[each].store(base, std::memory_order_release);
    }
  }

  // By the highest bit of the index: where element 0 would be if the chunk began with it; 0 where
  // there is no chunk.
  std::atomic<std::uintptr_t> bases_[kTops] = {};
};

// A field of such an element that one thread writes while others read it: plain moves on x86 and
// load-acquire/store-release instructions on Arm.
template <typename T>
T load(const T& field) {
  return std::atomic_ref(const_cast<T&>(field)).load(std::memory_order_acquire);
}
template <typename T>
void store(T& field, std::type_identity_t<T> value) {
  std::atomic_ref(field).store(value, std::memory_order_release);
}

}  // namespace sinew::graph
