// Boxes along the axes by number, and which of them meet a given one: an R-tree (Boost.Geometry),
// kept behind this header.
#pragma once

#include <memory>
#include <vector>

#include "sinew/world/ids.h"
#include "sinew/world/shape.h"

namespace sinew::world {

class SpaceIndex {
 public:
  SpaceIndex();
  ~SpaceIndex();
  SpaceIndex(SpaceIndex&&) noexcept;
  SpaceIndex& operator=(SpaceIndex&&) noexcept;

  struct Entry {
    Bounds3 box;
    Index index = kNone;
  };
  void fill(const std::vector<Entry>& entries);  // replaces all; packed, for many at once
  void insert(const Entry& entry);
  bool remove(const Entry& entry);  // exactly as it was inserted; false where it was not
  void search(const Bounds3& box, std::vector<Index>& found) const;  // appended, in no order
  std::size_t size() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace sinew::world
