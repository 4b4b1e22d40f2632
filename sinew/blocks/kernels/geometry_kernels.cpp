#include "sinew/blocks/kernels/geometry_kernels.h"

#include "sinew/blocks/kernels/made_kernels.h"

namespace sinew::blocks {

std::span<const data::KernelEntry> geometry_kernels() { return made_kernels(); }

}  // namespace sinew::blocks
