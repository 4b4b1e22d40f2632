// Operators of tasks: views, constraints, monitors, controllers (algorithm/operators_control.cpp).
#pragma once

#include <vector>

#include "sinew/program/kernels.h"

namespace sinew::program {

// The rows of these operators for the table of kernels.cpp.
std::vector<Kernel> kernels_of_control();

}  // namespace sinew::program
