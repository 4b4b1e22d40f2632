// The edges of one predicate in one version, packed: for each node the ids that it is linked to,
// one behind the other. Packing costs some ten nanoseconds an edge, once; a node's edges are then
// two loads away, and all edges are one pass over memory. A store keeps them (Store::edges):
//
//   store.edges(linked, Direction::kOut)->visit([](Id node, std::span<const Id> linked_to) {…});
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sinew/graph/view.h"

namespace sinew::graph {

enum class Direction : std::uint8_t { kOut, kIn };

// Immutable, and independent of what it was made from.
class Adjacency {
 public:
  Adjacency() = default;
  // Of one predicate, or with 0 of all; of each triple of the union once.
  Adjacency(const View& view, Id predicate, Direction direction);

  // What the node is linked to, in the order in which the triples were added.
  std::span<const Id> of(Id node) const {
    const std::size_t at = node.value - first_;  // far out of range where it is smaller
    if (at + 1 >= ends_.size()) return {};
    return {items_.data() + ends_[at], items_.data() + ends_[at + 1]};
  }
  // Calls visit(Id node, std::span<const Id>) for each node that has edges, by ascending id.
  template <typename Visit>
  void visit(Visit&& visit) const {
    const Id* begin = items_.data();
    for (std::size_t at = 0; at + 1 < ends_.size(); ++at) {
      const Id* const end = items_.data() + ends_[at + 1];
      if (begin != end) visit(Id{first_ + static_cast<std::uint32_t>(at)}, std::span(begin, end));
      begin = end;
    }
  }
  std::size_t size() const { return items_.size(); }  // edges

 private:
  std::uint32_t first_ = 0;          // the smallest node
  std::vector<std::uint32_t> ends_;  // of the node before each, from `first_` on
  std::vector<Id> items_;
};

}  // namespace sinew::graph
