// An array whose elements never move: it grows by chunks, each as large as all before it together,
// so an element is reached with one comparison while the array is small and with a bit count when
// it is large.
//
// One thread may append while others read elements whose index was published to them. Elements
// start as zero bytes, or, where whoever reserves one writes all of it, as whatever the memory
// holds.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
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
  static constexpr std::uint32_t kFirst = std::uint32_t{1} << kFirstBits;

  StableArray() = default;
  StableArray(const StableArray&) = delete;
  StableArray& operator=(const StableArray&) = delete;
  ~StableArray() {
    for (std::uint32_t number = 0; number < kChunks; ++number) {
      release_pages(chunks_[number].load(std::memory_order_relaxed),
                    std::size_t{capacity(number)} * sizeof(T));
    }
  }

  // Precondition: `index` was reserved.
  T& operator[](std::uint32_t index) { return *locate(index); }
  const T& operator[](std::uint32_t index) const { return *locate(index); }

  // The element, or null where nothing was ever reserved.
  const T* find(std::uint32_t index) const {
    return chunks_[chunk_of(index)].load(std::memory_order_acquire) ? locate(index) : nullptr;
  }

  // Asks for the element, which is about to be written. Precondition: it or 0 was reserved.
  void prefetch(std::uint32_t index) const {
    if (index != 0) __builtin_prefetch(locate(index), 1);
  }

  // Makes the element at `index` exist. Writer only.
  T& reserve(std::uint32_t index) {
    const std::uint32_t number = chunk_of(index);
    if (!chunks_[number].load(std::memory_order_relaxed)) allocate(number);
    return *locate(index);
  }

  // Makes elements [0, count) equal to the other's, byte by byte. Precondition: this one is new.
  void copy_from(const StableArray& other, std::uint32_t count) {
    for (std::uint32_t begin = 0, number = 0; begin < count; ++number) {
      const std::uint32_t room = capacity(number);
      const std::uint32_t used = count - begin < room ? count - begin : room;
      allocate(number);
      std::memcpy(static_cast<void*>(chunks_[number].load(std::memory_order_relaxed)),
                  other.chunks_[number].load(std::memory_order_acquire),
                  std::size_t{used} * sizeof(T));
      begin += used;
    }
  }

 private:
  static constexpr std::uint32_t kChunks = 33 - kFirstBits;

  static std::uint32_t chunk_of(std::uint32_t index) {
    return index < kFirst ? 0 : static_cast<std::uint32_t>(std::bit_width(index)) - kFirstBits;
  }
  static std::uint32_t capacity(std::uint32_t number) {
    return number == 0 ? kFirst : kFirst << (number - 1);
  }
  T* locate(std::uint32_t index) const {
    if (index < kFirst) return chunks_[0].load(std::memory_order_acquire) + index;
    const auto width = static_cast<std::uint32_t>(std::bit_width(index));
    return chunks_[width - kFirstBits].load(std::memory_order_acquire) +
           (index - (std::uint32_t{1} << (width - 1)));
  }
  void allocate(std::uint32_t number) {
    const std::size_t size = std::size_t{capacity(number)} * sizeof(T);
    void* memory = fill == Fill::kZero ? allocate_zeroed(size) : allocate_raw(size);
    chunks_[number].store(static_cast<T*>(memory), std::memory_order_release);
  }

  std::atomic<T*> chunks_[kChunks] = {};
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
