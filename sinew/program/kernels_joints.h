// Operators of joints with several degrees of freedom, joints that follow others, rotors and the
// factors of the mass matrix (algorithm/operators_joints.cpp).
#pragma once

#include <vector>

#include "sinew/program/kernels.h"

namespace sinew::program {

// The rows of these operators for the table of kernels.cpp.
std::vector<Kernel> kernels_of_joints();

}  // namespace sinew::program
