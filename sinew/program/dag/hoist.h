// Partial evaluation: what depends only on inputs that change rarely is computed apart, once for
// each change.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/program/dag/dag.h"

namespace sinew::program {

struct Hoisted {
  // The same inputs; its results are the held values, which depend on slow inputs (and constants)
  // only.
  Computation update;
  // Inputs: those of the original, then the held values. Results: those of the original.
  Computation evaluate;
};

// `slow[i]`: input i changes rarely. Held is what `evaluate` needs of the slow part and nothing
// more: the values at the border, and none that costs no operation (an input, a constant).
Hoisted hoist(const Computation& computation, const std::vector<bool>& slow);

}  // namespace sinew::program
