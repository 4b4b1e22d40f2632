// Orders that keep few values alive, for the function of a block: its lanes hide how long an
// operation takes, and what it waits for is memory, above all for values that are written there.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/program/dag/dag.h"

namespace sinew::backend {

// All nodes that anything depends on, operands first. Of those whose operands are there, what frees
// most values is next; the first in the graph of several.
std::vector<std::uint32_t> frugal_order(const program::Computation& computation);

// Depth first from each result, the last one first, and of operands from the one that needs most
// registers (Sethi & Ullman 1970).
std::vector<std::uint32_t> depth_first_order(const program::Computation& computation);

}  // namespace sinew::backend
