// Makes a product that nobody else uses and the addition that uses it one operation, a b + c. Where
// the longest path allows it, a sum of products becomes one chain of them. Last of the passes that
// change the graph: no other looks into fused operations.
#pragma once

#include "sinew/program/passes/polynomials.h"

namespace sinew::program {

void fuse_multiply_add(Polynomials& system);

}  // namespace sinew::program
