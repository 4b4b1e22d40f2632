#include "sinew/world/event_queue.h"

#include <iterator>
#include <string>

#include "sinew/world/refuse.h"

namespace sinew::world {

EventQueue::EventQueue(std::size_t capacity) : capacity_(capacity) {
  if (capacity == 0 || capacity > kMaximumQueuedEvents) {
    refuse({}, "a queue of " + std::to_string(capacity) + " events",
           "1 to " + std::to_string(kMaximumQueuedEvents));
  }
}

bool EventQueue::push(int priority, std::function<void()> work) {
  const std::lock_guard lock(mutex_);
  work_.emplace(Rank{-static_cast<long>(priority), arrivals_++}, std::move(work));
  arrived_.notify_one();
  if (work_.size() <= capacity_) return true;
  work_.erase(std::prev(work_.end()));
  ++dropped_;
  return false;
}

std::size_t EventQueue::run(std::size_t most) {
  std::size_t ran = 0;
  while (ran < most) {
    std::function<void()> next;
    {
      const std::lock_guard lock(mutex_);
      if (work_.empty()) return ran;
      next = std::move(work_.begin()->second);
      work_.erase(work_.begin());
    }
    next();
    ++ran;
  }
  return ran;
}

bool EventQueue::run_one_within(Duration time_out) {
  const auto until = std::chrono::steady_clock::now() + time_out;
  {
    std::unique_lock lock(mutex_);
    if (!arrived_.wait_until(lock, until, [this] { return !work_.empty(); })) return false;
  }
  return run(1) == 1;  // another thread may have been faster
}

std::size_t EventQueue::waiting() const {
  const std::lock_guard lock(mutex_);
  return work_.size();
}

std::uint64_t EventQueue::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

}  // namespace sinew::world
