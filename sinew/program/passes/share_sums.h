// Finds pairs of terms that several sums have in common, a + b + c and a + d + b, and adds them
// once. Value numbering sees such a pair only where it happens to have been written as a pair.
#pragma once

#include "sinew/program/passes/polynomials.h"

namespace sinew::program {

void share_sums(Polynomials& system);

}  // namespace sinew::program
