// Numbers that one thread publishes and others look at: whoever reads gets all numbers of one
// publication, or tries again a bounded number of times. Neither side waits for the other
// (a sequence lock, Boehm 2012, with the numbers themselves atomic).
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew::runtime {

class Published {
 public:
  explicit Published(std::size_t size) : numbers_(size) {}
  std::size_t size() const { return numbers_.size(); }

  // One thread at a time.
  void publish(std::span<const double> numbers) noexcept {
    const std::uint64_t before = version_.load(std::memory_order_relaxed);
    version_.store(before + 1, std::memory_order_relaxed);
    // Release stores keep the odd version before the numbers for whoever acquires one of them.
    for (std::size_t i = 0; i < numbers_.size(); ++i)
      numbers_[i].store(numbers[i], std::memory_order_release);
    version_.store(before + 2, std::memory_order_release);
  }

  // False when nothing has been published yet, or a publication came in between at every try.
  bool read(std::span<double> numbers) const noexcept {
    for (int tries = 0; tries < kTries; ++tries) {
      const std::uint64_t before = version_.load(std::memory_order_acquire);
      if (before == 0) return false;
      if ((before & 1U) != 0) continue;
      for (std::size_t i = 0; i < numbers_.size(); ++i)
        numbers[i] = numbers_[i].load(std::memory_order_acquire);
      if (version_.load(std::memory_order_relaxed) == before) return true;
    }
    return false;
  }

 private:
  static constexpr int kTries = 1000;
  std::vector<std::atomic<double>> numbers_;
  std::atomic<std::uint64_t> version_ = 0;
};

}  // namespace sinew::runtime
