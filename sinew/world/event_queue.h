// Callbacks that wait for the thread that wants them: whatever happens is put into the queue by
// the thread that noticed it, and runs in the thread that calls `run`. The more urgent first, in
// order of arrival among equals.
//
// The queue is bounded. When it is full, the least urgent that came last is dropped and counted.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <utility>

#include "sinew/world/clock.h"

namespace sinew::world {

inline constexpr std::size_t kMaximumQueuedEvents = 1u << 16;
inline constexpr std::size_t kUsualQueuedEvents = 1024;

class EventQueue {
 public:
  // Throws Error unless 1 <= capacity <= kMaximumQueuedEvents.
  explicit EventQueue(std::size_t capacity = kUsualQueuedEvents);

  // False when something had to be dropped for it, or it was itself.
  bool push(int priority, std::function<void()> work);

  // Runs at most `most` of those that wait, in the calling thread, without a lock held; returns how
  // many. What they throw goes to the caller; the others stay.
  std::size_t run(std::size_t most = kMaximumQueuedEvents);
  // Waits for the first, for a while, and runs it; false when none came.
  bool run_one_within(Duration time_out);

  std::size_t waiting() const;
  std::uint64_t dropped() const;

 private:
  using Rank = std::pair<long, std::uint64_t>;  // -priority, arrival: the first runs first
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::map<Rank, std::function<void()>> work_;
  std::uint64_t arrivals_ = 0, dropped_ = 0;
};

}  // namespace sinew::world
