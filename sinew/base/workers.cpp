#include "sinew/base/workers.h"

#include <algorithm>

namespace sinew {

unsigned Workers::as_many_as_the_machine_has() {
  return std::clamp(std::thread::hardware_concurrency(), 1U, kMost);
}

Workers::Workers(unsigned threads) : most_(std::clamp(threads, 1U, kMost) - 1) {}

Workers::~Workers() {
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
    waiting_.clear();
  }
  changed_.notify_all();
}

void Workers::put(Piece piece) {
  const std::scoped_lock lock(mutex_);
  waiting_.push_back(std::move(piece));
  if (idle_ >= waiting_.size()) {
    changed_.notify_one();
  } else if (threads_.size() < most_) {
    threads_.emplace_back([this] { work(); });
  }
}

// With the lock given up meanwhile.
void Workers::do_next(std::unique_lock<std::mutex>& lock) {
  const auto next = std::ranges::max_element(waiting_, {}, &Piece::size);
  Piece piece = std::move(*next);
  waiting_.erase(next);
  lock.unlock();
  piece.work();
  piece.work = nullptr;
  lock.lock();
}

void Workers::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    ++idle_;
    changed_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
    --idle_;
    if (ends_) return;
    do_next(lock);
  }
}

void Workers::help() {
  std::unique_lock lock(mutex_);
  while (!waiting_.empty()) do_next(lock);
}

}  // namespace sinew
