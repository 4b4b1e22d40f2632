// Writes every sum in the order in which its terms become ready, so that the longest path through
// the graph is short. The number of operations stays.
#pragma once

#include "sinew/program/dag/dag.h"

namespace sinew::program {

Computation reassociate(Computation computation);

}  // namespace sinew::program
