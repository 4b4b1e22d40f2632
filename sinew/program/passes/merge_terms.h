// Multiplies sums out where that makes terms meet: 2 (a + b) + 3 (a - b) becomes 5 a - b, which
// saves the additions inside the brackets if nobody else uses them.
#pragma once

#include "sinew/program/passes/polynomials.h"

namespace sinew::program {

void merge_terms(Polynomials& system);

}  // namespace sinew::program
