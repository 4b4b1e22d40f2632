// How often the calling thread has asked for memory with new.
#pragma once

#include <cstddef>

namespace sinew {

std::size_t allocations();

}  // namespace sinew
