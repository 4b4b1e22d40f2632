// The traversal framework. Expansion queries are run node by node, breadth first, in the order of
// tree:index; steps with the same expansion share its one execution. Then each sweep goes over the
// edges, outward in that order or inward in the opposite one, twice: first every configure pass,
// then every compute pass. Within one edge or node the steps come in the sweep's order.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sinew/synthesis/context.h"
#include "sinew/synthesis/step.h"

namespace sinew::synthesis {

struct Sweep {
  Direction direction = Direction::kOutward;
  std::vector<const Step*> steps;
};

// How much work the queries were.
struct TraversalCounts {
  std::size_t nodes = 0;
  std::size_t expansions = 0;  // executions of expansion queries
  std::size_t conditions = 0;  // executions of conditions; equal questions are asked once
  std::size_t selections = 0;
};

// Limit of the depth of a tree, against cycles in a broken model.
inline constexpr std::size_t kMaximumDepth = 100'000;

TraversalCounts run_sweeps(Context& context, std::span<const Sweep> sweeps);

}  // namespace sinew::synthesis
