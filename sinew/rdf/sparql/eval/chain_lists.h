// What nodes lead to over a whole chain of properties, each of them at most a few nodes: remembered
// as long as the same version of the graph is asked. The next walk that comes by needs neither the
// properties nor the nodes in between. Memory is set apart once, and once more when the dictionary
// has grown; what does not fit is not remembered.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sinew/graph/view.h"

namespace sinew::rdf::sparql::eval {

class ChainLists {
 public:
  // A node that leads to more, or by more ways, is left to the walk itself.
  static constexpr std::size_t kMostNodes = 32, kMostWays = 128;
  static constexpr std::size_t kRoom = std::size_t{1} << 14;       // ids of all nodes together
  static constexpr std::size_t kMostTerms = std::size_t{1} << 18;  // a larger dictionary: nothing

  // Ids are at most `terms`. What was remembered is kept if the stamp is the same; nothing is, and
  // will be, if there is none.
  void begin(std::size_t terms, graph::Stamp stamp) {
    is_on_ = stamp && terms <= kMostTerms;
    if (!is_on_) return;
    if (cells_.size() <= terms) cells_.resize(terms + 1 + terms / 2);
    if (!room_) room_ = std::make_unique_for_overwrite<graph::Id[]>(kRoom);
    if (stamp == stamp_) return;
    stamp_ = stamp;
    used_ = 0;
    if (++epoch_ == 0) {
      cells_.assign(cells_.size(), {});
      epoch_ = 1;
    }
  }
  enum class Known : std::uint8_t { kNothing, kList, kTooLong };
  // `list` is valid until the next `begin`.
  Known find(graph::Id node, std::span<const graph::Id>& list) const {
    if (!is_on_ || node.value >= cells_.size()) return Known::kTooLong;
    const Cell& cell = cells_[node.value];
    if (cell.epoch != epoch_) return used_ + kMostNodes > kRoom ? Known::kTooLong : Known::kNothing;
    if (cell.count == kTooMany) return Known::kTooLong;
    list = {room_.get() + cell.begin, cell.count};
    return Known::kList;
  }
  // Precondition: `find` said that nothing is known of the node. At most kMostNodes.
  std::span<const graph::Id> remember(graph::Id node, std::span<const graph::Id> list) {
    cells_[node.value] = {epoch_, static_cast<std::uint16_t>(used_),
                          static_cast<std::uint16_t>(list.size())};
    graph::Id* const into = room_.get() + used_;
    for (std::size_t i = 0; i < list.size(); ++i) into[i] = list[i];
    used_ += list.size();
    return {into, list.size()};
  }
  void remember_too_long(graph::Id node) { cells_[node.value] = {epoch_, 0, kTooMany}; }

 private:
  static constexpr std::uint16_t kTooMany = UINT16_MAX;
  struct Cell {
    std::uint32_t epoch = 0;  // another one: nothing is known
    std::uint16_t begin = 0, count = 0;
  };
  static_assert(kRoom <= std::size_t{UINT16_MAX} + 1 && kMostNodes < kTooMany);

  bool is_on_ = false;
  graph::Stamp stamp_;
  std::uint32_t epoch_ = 0;
  std::size_t used_ = 0;
  std::vector<Cell> cells_;  // by id
  std::unique_ptr<graph::Id[]> room_;
};

}  // namespace sinew::rdf::sparql::eval
