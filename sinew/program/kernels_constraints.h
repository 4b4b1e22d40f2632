// Operators of hybrid dynamics that take any number of arguments: energies, weighted sums, and the
// magnitudes of constraint forces.
#pragma once

#include <vector>

#include "sinew/program/kernels.h"

namespace sinew::program {

// The rows of these operators for the table of kernels.cpp.
std::vector<Kernel> constraint_kernels();

}  // namespace sinew::program
