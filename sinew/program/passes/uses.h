// How often each node of a graph is used.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/program/dag/dag.h"

namespace sinew::program {

// For each node, how many operands of live nodes and how many results it is; 0 for a dead node.
std::vector<std::uint32_t> use_counts(const Computation& computation);

}  // namespace sinew::program
