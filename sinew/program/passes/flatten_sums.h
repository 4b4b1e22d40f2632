// Writes sums of sums as one sum each, from left to right, before passes look for what they share:
// what they find then does not depend on where a kernel has put its brackets.
#pragma once

#include "sinew/program/passes/polynomials.h"

namespace sinew::program {

void flatten_sums(Polynomials& system);

}  // namespace sinew::program
