// The nodes that a walk along a path has reached, and the queue of those to go on from. Emptying it
// is a counter's increment; memory is kept from walk to walk.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/graph/terms.h"

namespace sinew::rdf::sparql::eval {

class VisitedSet {
 public:
  void begin() {
    queue.clear();
    count_ = 0;
    if (++epoch_ == 0) {
      cells_.assign(cells_.size(), 0);
      epoch_ = 1;
    }
  }
  // False when it was there already.
  bool insert(graph::Id id) {
    if ((count_ + 1) * 2 > cells_.size()) grow();
    std::size_t at = hash(id) & mask_;
    while (true) {
      const std::uint64_t cell = cells_[at];
      if ((cell >> 32) != epoch_) break;
      if (static_cast<std::uint32_t>(cell) == id.value) return false;
      at = (at + 1) & mask_;
    }
    cells_[at] = std::uint64_t{epoch_} << 32 | id.value;
    ++count_;
    return true;
  }

  std::vector<graph::Id> queue;

 private:
  static std::size_t hash(graph::Id id) {
    return static_cast<std::size_t>((std::uint64_t{id.value} * 0x9E3779B97F4A7C15ull) >> 32);
  }
  void grow() {
    const std::vector<std::uint64_t> old = std::move(cells_);
    cells_.assign(old.empty() ? 64 : old.size() * 2, 0);
    mask_ = cells_.size() - 1;
    count_ = 0;
    for (const std::uint64_t cell : old) {
      if ((cell >> 32) == epoch_) insert(graph::Id{static_cast<std::uint32_t>(cell)});
    }
  }

  std::vector<std::uint64_t> cells_;  // epoch and id
  std::size_t mask_ = 0;
  std::size_t count_ = 0;
  std::uint32_t epoch_ = 0;
};

}  // namespace sinew::rdf::sparql::eval
