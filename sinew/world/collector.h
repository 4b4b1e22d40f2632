// A thread that takes what real-time writers have written into the histories (World::collect) every
// `period`. A ring of n entries that is written at a rate r wants a period well below n / r: a
// writer that finds no room is refused, with Status::kNoRoom, and counted (Writer::refused).
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "sinew/world/world.h"

namespace sinew::world {

class Collector {
 public:
  // The world must outlive it, where it is. Throws Error unless the period is positive.
  Collector(World& world, Duration period);
  ~Collector();  // collects once more
  Collector(const Collector&) = delete;

 private:
  World& world_;
  std::mutex mutex_;
  std::condition_variable ending_;
  bool end_ = false;
  std::thread thread_;
};

}  // namespace sinew::world
