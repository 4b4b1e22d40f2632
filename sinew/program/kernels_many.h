// Operators that take any number of arguments of one kind and put them together to one.
#pragma once

#include <vector>

#include "sinew/program/kernels.h"

namespace sinew::program {

// The rows of these operators for the table of kernels.cpp.
std::vector<Kernel> kernels_of_many();

}  // namespace sinew::program
