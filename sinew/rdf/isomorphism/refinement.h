// Colour refinement: parts the blank nodes of a set of quads into classes such that nodes which
// differ in what surrounds them are in different classes. What it cannot part is nearly always
// symmetric.
//
// The classes and their numbers depend only on the structure and on the texts of the named terms,
// not on ids or on the order of the quads.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "sinew/graph/store.h"

namespace sinew::rdf {

// The quads that mention blank nodes, in the form that refinement works on.
class BlankStructure {
 public:
  // A field of a quad: a blank node's index, or a hash of any other term.
  struct Field {
    bool is_blank = false;
    std::uint64_t value = 0;
  };
  using Row = std::array<Field, 4>;

  // No quad may come twice.
  BlankStructure(std::span<const graph::Quad> quads, const graph::Terms& terms);
  // Two sets side by side, whose blank nodes are taken for different nodes even where they have the
  // same ids. The nodes of the first set are those below `left_size`.
  BlankStructure(std::span<const graph::Quad> left, std::span<const graph::Quad> right,
                 const graph::Terms& terms);
  std::size_t left_size() const { return left_size_; }

  std::size_t size() const { return nodes_.size(); }  // blank nodes
  graph::Id node(std::uint32_t index) const { return nodes_[index]; }
  const std::vector<Row>& rows() const { return rows_; }
  // The rows that mention a node.
  std::span<const std::uint32_t> rows_of(std::uint32_t index) const {
    return std::span(incident_).subspan(first_[index], first_[index + 1] - first_[index]);
  }

 private:
  void add_rows(std::span<const graph::Quad> quads, const graph::Terms& terms);
  void index_rows();

  std::vector<graph::Id> nodes_;
  std::size_t left_size_ = 0;
  std::vector<Row> rows_;
  std::vector<std::uint32_t> first_;     // of a node, in incident_; one more than there are nodes
  std::vector<std::uint32_t> incident_;  // rows
};

// A partition of the nodes 0 ... n-1. Cheap to copy: five flat arrays.
struct Partition {
  explicit Partition(std::uint32_t nodes);

  std::uint32_t class_count() const { return static_cast<std::uint32_t>(start.size()); }
  std::span<const std::uint32_t> members(std::uint32_t cls) const {
    return std::span(order).subspan(start[cls], length[cls]);
  }
  // Takes these members out of their common class into a new one, and returns it.
  std::uint32_t split(std::span<const std::uint32_t> members_of_one_class);

  std::vector<std::uint32_t> order;     // nodes, class by class
  std::vector<std::uint32_t> position;  // of a node in `order`
  std::vector<std::uint32_t> class_of;
  std::vector<std::uint32_t> start, length;  // of a class in `order`
};

// Keeps its working memory from one call to the next.
class Refiner {
 public:
  explicit Refiner(const BlankStructure& structure);  // which must outlive it
  // Splits until the nodes of a class see the same classes around them, given that this held before
  // the `changed` nodes got new classes. For the first call on a fresh partition, all are changed.
  void refine(Partition& partition, std::vector<std::uint32_t> changed);

 private:
  struct Seen {
    std::uint32_t cls;
    std::uint64_t hash;
    std::uint32_t node;
    auto operator<=>(const Seen&) const = default;
  };
  // Fills affected_: the nodes that are in a row with a changed one, and what they see there.
  void look(const Partition& partition, std::span<const std::uint32_t> changed);
  // Splits the class of the affected nodes `begin` up to `end`; appends what got a new class.
  void split(Partition& partition, std::size_t begin, std::size_t end,
             std::vector<std::uint32_t>& changed);

  const BlankStructure& structure_;
  std::vector<std::uint64_t> view_;
  std::vector<bool> is_affected_, row_done_;
  std::vector<std::uint32_t> rows_, group_;
  std::vector<Seen> affected_;
};

// The blank nodes of the quads, those of a class together. The order is the same for any two sets
// of quads that differ only in the names of their blank nodes, save for the order within a class.
std::vector<graph::Id> ordered_blanks(std::span<const graph::Quad> quads,
                                      const graph::Terms& terms);

}  // namespace sinew::rdf
