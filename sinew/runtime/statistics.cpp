#include "sinew/runtime/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace sinew::runtime {

// Up to 16 exactly; above, the four bits after the highest one.
std::size_t Histogram::bucket(std::uint64_t duration) {
  if (duration < 16) return duration;
  const auto exponent = static_cast<std::size_t>(std::bit_width(duration)) - 5;
  return (exponent + 1) * 16 + ((duration >> exponent) & 15U);
}

std::uint64_t Histogram::upper_bound(std::size_t bucket) {
  if (bucket < 16) return bucket;
  const std::size_t exponent = bucket / 16 - 1;
  return ((std::uint64_t{16} + bucket % 16 + 1) << exponent) - 1;
}

void Histogram::add(Nanoseconds duration) noexcept {
  duration = std::max<Nanoseconds>(duration, 0);
  const std::uint64_t before = count_.load(std::memory_order_relaxed);
  if (before == 0 || duration < minimum_.load(std::memory_order_relaxed))
    minimum_.store(duration, std::memory_order_relaxed);
  if (duration > maximum_.load(std::memory_order_relaxed))
    maximum_.store(duration, std::memory_order_relaxed);
  buckets_[bucket(static_cast<std::uint64_t>(duration))].fetch_add(1, std::memory_order_relaxed);
  count_.store(before + 1, std::memory_order_relaxed);
}

void Histogram::clear() noexcept {
  for (auto& bucket : buckets_) bucket.store(0, std::memory_order_relaxed);
  count_.store(0, std::memory_order_relaxed);
  minimum_.store(0, std::memory_order_relaxed);
  maximum_.store(0, std::memory_order_relaxed);
}

Nanoseconds Histogram::minimum() const { return minimum_.load(std::memory_order_relaxed); }
Nanoseconds Histogram::maximum() const { return maximum_.load(std::memory_order_relaxed); }

Nanoseconds Histogram::percentile(double share) const {
  const double wanted = share * static_cast<double>(count());
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < kBuckets; ++i) {
    seen += buckets_[i].load(std::memory_order_relaxed);
    if (seen > 0 && static_cast<double>(seen) >= wanted)
      return std::min(static_cast<Nanoseconds>(upper_bound(i)), maximum());
  }
  return maximum();
}

std::string to_string(const Histogram& histogram) {
  const auto us = [](Nanoseconds duration) { return static_cast<double>(duration) * 1e-3; };
  return fmt::format(
      "min {:.1f} us, median {:.1f} us, 99 % {:.1f} us, 99.9 % {:.1f} us, max {:.1f} us ({} "
      "cycles)",
      us(histogram.minimum()), us(histogram.percentile(0.5)), us(histogram.percentile(0.99)),
      us(histogram.percentile(0.999)), us(histogram.maximum()), histogram.count());
}

}  // namespace sinew::runtime
