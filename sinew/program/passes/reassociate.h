// Writes every sum in the order in which its terms become ready, so that the longest path through
// the graph is short. The number of operations stays.
#pragma once

#include "sinew/program/passes/polynomials.h"

namespace sinew::program {

void reassociate(Polynomials& system);

}  // namespace sinew::program
