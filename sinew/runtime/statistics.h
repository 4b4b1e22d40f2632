// Durations counted while a loop runs: a histogram with 16 buckets for each power of two, so that
// percentiles are right within 1/16. One thread adds, any thread may look.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>

#include "sinew/runtime/clock.h"

namespace sinew::runtime {

class Histogram {
 public:
  void add(Nanoseconds duration) noexcept;  // negative ones count as 0
  void clear() noexcept;

  std::uint64_t count() const { return count_.load(std::memory_order_relaxed); }
  Nanoseconds minimum() const;  // 0 when nothing was added
  Nanoseconds maximum() const;
  // The least duration that `share` (0 to 1) of all do not exceed.
  Nanoseconds percentile(double share) const;

 private:
  static constexpr std::size_t kBuckets = std::size_t{64} * 16;
  static std::size_t bucket(std::uint64_t duration);
  static std::uint64_t upper_bound(std::size_t bucket);

  std::array<std::atomic<std::uint64_t>, kBuckets> buckets_ = {};
  std::atomic<std::uint64_t> count_ = 0;
  std::atomic<Nanoseconds> minimum_ = 0, maximum_ = 0;
};

// "min 1.2 us, median 3.4 us, 99 % 9.9 us, 99.9 % 12.0 us, max 80.1 us (10000 cycles)"
std::string to_string(const Histogram& histogram);

}  // namespace sinew::runtime
