// The table that the generator writes. Internal to the module.
#pragma once

#include <span>

#include "sinew/data/kernels.h"

namespace sinew::blocks {

std::span<const data::KernelEntry> made_kernels();

}  // namespace sinew::blocks
