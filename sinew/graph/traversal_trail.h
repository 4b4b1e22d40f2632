// What agents of a traversal remember: where they came by, the labels they gave, the rounds they
// repeated. Agents that split share their past, so a memory is a chain of links to earlier ones.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/graph/view.h"

namespace sinew::graph {

// 0 is the empty memory.
struct AgentState {
  Id node;
  std::uint32_t step = 0;
  std::uint32_t path = 0, labels = 0, loop = 0;
};

class TraversalTrail {
 public:
  std::uint32_t extend(std::uint32_t path, Id node);
  std::vector<Id> path(std::uint32_t path) const;
  bool is_simple(std::uint32_t path) const;  // no node twice

  // `label` must live as long as the trail.
  std::uint32_t label(std::uint32_t labels, std::string_view label, Id node);
  Id labelled(std::uint32_t labels, std::string_view label) const;  // throws Error when unknown

  std::uint32_t begin_loop(std::uint32_t outer);
  std::uint32_t next_round(std::uint32_t loop);
  std::uint32_t end_loop(std::uint32_t loop) const;  // the outer one
  std::uint32_t repeats(std::uint32_t loop) const;   // rounds that are done; 0 outside loops

 private:
  struct Visited {
    Id node;
    std::uint32_t before;
  };
  struct Labelled {
    std::string_view label;
    Id node;
    std::uint32_t before;
  };
  struct Loop {
    std::uint32_t rounds, outer;
  };
  std::vector<Visited> visited_{{}};
  std::vector<Labelled> labelled_{{}};
  std::vector<Loop> loops_{{}};
};

[[noreturn]] void throw_no_repeat();
[[noreturn]] void throw_too_many_moves(std::uint64_t limit);
[[noreturn]] void throw_too_many_repeats(std::uint32_t limit, const View& view, Id node);

}  // namespace sinew::graph
