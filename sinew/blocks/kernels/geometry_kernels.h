// The formulas of the prelude as compiled functions, for the runtime engine. The source is made at build
// time from metamodels/blocks/geometry.blocks by kernel_generator.
#pragma once

#include <span>

#include "sinew/data/kernels.h"

namespace sinew::blocks {

std::span<const data::KernelEntry> geometry_kernels();

}  // namespace sinew::blocks
