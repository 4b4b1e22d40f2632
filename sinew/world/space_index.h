// Boxes along the axes by number, and which of them meet a given one: a tree of boxes in flat
// arrays, eight children to a node, without pointers.
//
// The boxes lie in the order of a space-filling curve (Morton 1966), eight neighbours to a block;
// the boxes around eight blocks are a block of the level above. A block holds its eight boxes as
// six rows of eight floats, so that all are compared at once. Floats are rounded outwards: an
// answer may hold a box that is off by less than a float's last digit, and misses none.
//
// What moves is changed in its place, and so are the boxes around it; what is new waits in a list
// beside the tree. When more than a share of it all has changed, the tree is made anew.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sinew/world/ids.h"
#include "sinew/world/shape.h"

namespace sinew::world {

class SpaceIndex {
 public:
  // Puts the box of this number where it is now, for the first time or anew.
  void set(Index number, const Bounds3& box);
  void remove(Index number);  // nothing happens where it is not in the index
  // After several changes: makes the tree anew where that pays. Until then a search is slower, not
  // wrong.
  void settle();
  void search(const Bounds3& box, std::vector<Index>& found) const;  // appended, in no order
  std::size_t size() const { return size_; }

 private:
  static constexpr std::size_t kWidth = 8;
  struct alignas(32) Block {
    std::array<std::array<float, kWidth>, 3> minimum, maximum;
    static Block empty();
  };
  static constexpr Index kWaiting = Index{1} << 31;  // a slot in the list, not in the tree

  void put(std::vector<Block>& blocks, std::size_t slot, const Bounds3& box);
  void refit(std::size_t slot);
  void rebuild();

  std::vector<std::vector<Block>> levels_;  // the boxes themselves, then those around them
  std::vector<Index> numbers_;              // by slot of the tree; kNone: nothing there
  std::vector<Block> waiting_;
  std::vector<Index> waiting_numbers_;
  std::vector<Index> slots_;  // by number; kNone: not in the index
  std::size_t size_ = 0, changed_ = 0;
};

}  // namespace sinew::world
