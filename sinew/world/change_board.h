// What has been written since somebody looked last, for whoever watches thousands of measurements:
// a number for each cell, all of them side by side, that its writer counts up with one plain store.
// Looking at ten thousand costs a few microseconds, and nothing of it costs the writers a wait.
//
// Numbers are never used again, as measurements' are not.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <mutex>

namespace sinew::world {

using ChangeCount = std::atomic<std::uint32_t>;

class ChangeBoard {
 public:
  // Any thread but real-time ones; valid as long as the board.
  ChangeCount* add() {
    const std::lock_guard lock(mutex_);
    if (used_ == kWidth * pages_.size()) pages_.emplace_back();
    return &pages_.back()[used_++ % kWidth];
  }

 private:
  static constexpr std::size_t kWidth = 4096;
  std::mutex mutex_;
  std::deque<std::array<ChangeCount, kWidth>> pages_;
  std::size_t used_ = 0;
};

}  // namespace sinew::world
