// Which blank nodes of a set of quads can be written in the place where they are used, and which
// are lists. Found once, before Turtle is written, so that the writer only follows it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "sinew/graph/store.h"

namespace sinew::rdf {

// The properties of one subject in one graph.
struct Description {
  graph::Id subject, graph;
  std::span<const graph::Quad> quads;  // sorted by predicate (rdf:type first), then object
};

class Shape {
 public:
  Shape(std::span<const graph::Quad> quads, const graph::Terms& terms);
  Shape(const Shape&) = delete;  // descriptions point into it
  Shape& operator=(const Shape&) = delete;

  // Of every subject, by graph (the unnamed one first), then subject, by the texts of the terms.
  const std::vector<Description>& descriptions() const { return descriptions_; }
  // Whether this blank node is written where it is used: as [ ... ] or as part of a list.
  bool is_nested(graph::Id node) const;
  // Whether the node is referred to by a label. If it is neither nested nor labelled, it is only a
  // subject, and written as [].
  bool has_label(graph::Id node) const;
  // The properties of a nested node.
  std::span<const graph::Quad> properties(graph::Id node) const;
  // The elements, if this is the first cell of a well-formed list, all of whose cells are nested.
  std::optional<std::vector<graph::Id>> list(graph::Id head) const;

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF, kSeveral = 0xFFFFFFFE;
  struct Use {
    std::uint32_t references = 0;       // as an object
    std::uint32_t description = kNone;  // its own; kSeveral if it has one in several graphs
    graph::Id graph;                    // of the last reference
    bool needs_label = false;      // because it names a graph or a predicate, or to end a cycle
    mutable bool no_list = false;  // known not to be a cell of a well-formed list
  };

  void sort_quads(std::span<const graph::Quad> quads, const graph::Terms& terms);
  void describe();
  void find_uses(const graph::Terms& terms);
  void limit_nesting();
  void visit(std::uint32_t description, std::size_t depth, std::vector<bool>& visited);

  std::vector<graph::Quad> quads_;
  std::vector<Description> descriptions_;
  std::unordered_map<graph::Id, Use> uses_;  // of blank nodes
  graph::Id type_, first_, rest_, nil_;
};

}  // namespace sinew::rdf
