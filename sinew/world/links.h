// Which frames a state links by which relations, packed: each frame's links lie one behind the
// other. Made once of a state, in one pass over it, for whoever walks all over its structure; a
// state's own lists serve single steps. A world keeps those of its present state (World::links).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sinew/world/state.h"

namespace sinew::world {

struct Link {
  Index relation;
  Index other;  // the frame at the relation's other end
};

class Links {
 public:
  explicit Links(const State& state);

  // Of every relation that is there, suspended ones too, in the order in which they were made;
  // properties link nothing. Precondition: `frame` is less than the state's number of frames.
  std::span<const Link> of(Index frame) const {
    return {items_.data() + ends_[frame], items_.data() + ends_[frame + 1]};
  }
  std::size_t frames() const { return ends_.size() - 1; }
  std::size_t size() const { return items_.size(); }  // twice the number of relations

 private:
  std::vector<Index> ends_;  // of the frame before each
  std::vector<Link> items_;
};

}  // namespace sinew::world
