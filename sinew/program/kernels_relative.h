// Motion between two frames that both move, and coordinates of rotation.
#pragma once

#include <vector>

#include "sinew/program/kernels.h"

namespace sinew::program {

// The rows of these operators for the table of kernels.cpp.
std::vector<Kernel> kernels_of_relative_motion();

}  // namespace sinew::program
