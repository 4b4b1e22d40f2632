// A bounded queue between one thread that pushes and one that pops: no lock, no allocation after it
// is made, and a full queue refuses instead of waiting.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <utility>
#include <vector>

#include "sinew/base/cache_lines.h"

namespace sinew::runtime {

template <typename T>
class Ring {
 public:
  // Room for at least `capacity` entries (the next power of two).
  explicit Ring(std::size_t capacity) : slots_(std::bit_ceil(capacity)), mask_(slots_.size() - 1) {}

  // The pushing thread. False when it is full; `value` is then as it was.
  bool push(T&& value) noexcept {
    const std::size_t at = pushed_.load(std::memory_order_relaxed);
    if (at - popped_.load(std::memory_order_acquire) == slots_.size()) return false;
    slots_[at & mask_] = std::move(value);
    pushed_.store(at + 1, std::memory_order_release);
    return true;
  }

  // The popping thread. False when it is empty.
  bool pop(T& value) noexcept {
    const std::size_t at = popped_.load(std::memory_order_relaxed);
    if (at == pushed_.load(std::memory_order_acquire)) return false;
    value = std::move(slots_[at & mask_]);
    popped_.store(at + 1, std::memory_order_release);
    return true;
  }

  std::size_t capacity() const { return slots_.size(); }

 private:
  std::vector<T> slots_;
  std::size_t mask_;
  alignas(kCacheLine) std::atomic<std::size_t> pushed_ = 0;
  alignas(kCacheLine) std::atomic<std::size_t> popped_ = 0;
};

// The same for rows of numbers, all of one width, copied in and out.
class RowRing {
 public:
  RowRing(std::size_t width, std::size_t capacity)
      : width_(width), mask_(std::bit_ceil(capacity) - 1), numbers_(width * (mask_ + 1)) {}

  bool push(const double* row) noexcept {
    const std::size_t at = pushed_.load(std::memory_order_relaxed);
    if (at - popped_.load(std::memory_order_acquire) > mask_) return false;
    for (std::size_t i = 0; i < width_; ++i) numbers_[(at & mask_) * width_ + i] = row[i];
    pushed_.store(at + 1, std::memory_order_release);
    return true;
  }

  bool pop(double* row) noexcept {
    const std::size_t at = popped_.load(std::memory_order_relaxed);
    if (at == pushed_.load(std::memory_order_acquire)) return false;
    for (std::size_t i = 0; i < width_; ++i) row[i] = numbers_[(at & mask_) * width_ + i];
    popped_.store(at + 1, std::memory_order_release);
    return true;
  }

  // The pushing thread: whether everything has been taken out.
  bool is_empty() const noexcept {
    return popped_.load(std::memory_order_acquire) == pushed_.load(std::memory_order_relaxed);
  }

  std::size_t width() const { return width_; }
  std::size_t capacity() const { return mask_ + 1; }

 private:
  std::size_t width_, mask_;
  std::vector<double> numbers_;
  alignas(kCacheLine) std::atomic<std::size_t> pushed_ = 0;
  alignas(kCacheLine) std::atomic<std::size_t> popped_ = 0;
};

}  // namespace sinew::runtime
