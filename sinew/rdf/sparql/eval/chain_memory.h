// What is known of the nodes while a closure over a chain of properties is walked: behind which of
// its properties each was reached, and which are to be gone on from. Emptying it is a counter's
// increment; memory is kept from walk to walk.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sinew/graph/terms.h"
#include "sinew/rdf/sparql/eval/chain_lists.h"
#include "sinew/rdf/sparql/plan/path.h"

namespace sinew::rdf::sparql::eval {

// Nodes in front of one property, in the order in which they came.
class ChainQueue {
 public:
  void clear() { size_ = done_ = 0; }
  bool empty() const { return done_ == size_; }
  graph::Id take() { return nodes_[done_++]; }
  // Without a branch, since nothing foretells which nodes are new.
  void push_if(bool is_new, graph::Id node) {
    if (size_ == nodes_.size()) nodes_.resize(2 * size_ + 64);
    nodes_[size_] = node;
    size_ += is_new ? 1 : 0;
  }
  std::size_t size() const { return size_; }  // also of those that were taken

 private:
  std::vector<graph::Id> nodes_;
  std::size_t size_ = 0, done_ = 0;
};

struct ChainMemory {
  static_assert(plan::kMaxChain <= 8, "a bit of a byte for each property");

  // Ids are at most `terms`, unless whoever is told of a node adds some.
  void begin(std::size_t terms) {
    for (ChainQueue& queue : queues) queue.clear();
    if (cells_.size() <= terms) cells_.resize(terms + 1 + terms / 2, 0);
    epoch_ += 0x100;
    if (epoch_ == 0) {
      cells_.assign(cells_.size(), 0);
      epoch_ = 0x100;
    }
  }
  // False when it was reached behind this property before.
  bool reach(graph::Id id, std::uint32_t property) {
    if (id.value >= cells_.size()) cells_.resize(id.value + 1 + cells_.size() / 2, 0);
    std::uint32_t& cell = cells_[id.value];
    const std::uint32_t bit = std::uint32_t{1} << property;
    const std::uint32_t known = cell >= epoch_ ? cell : epoch_;
    cell = known | bit;
    return (known & bit) == 0;
  }

  std::array<ChainQueue, plan::kMaxChain> queues;
  ChainLists lists;

 private:
  std::vector<std::uint32_t> cells_;  // by id: when it was reached last, and behind what
  std::uint32_t epoch_ = 0;
};

}  // namespace sinew::rdf::sparql::eval
