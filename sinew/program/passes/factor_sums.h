// Takes common factors out of sums: a b + a c + d becomes a (b + c) + d, which saves a
// multiplication. Not in the graph's constructors, because it pays only where nobody else uses the
// products.
#pragma once

#include "sinew/program/passes/polynomials.h"

namespace sinew::program {

void factor_sums(Polynomials& system);

}  // namespace sinew::program
