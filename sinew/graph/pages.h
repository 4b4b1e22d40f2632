// Zeroed memory for large tables. From kHugePage on, it is asked for in huge pages where the system
// has them: filling a store is otherwise dominated by page faults, and looking up by misses of the
// TLB.
#pragma once

#include <cstddef>

namespace sinew::graph {

inline constexpr std::size_t kHugePage = std::size_t{1} << 21;

// Throws std::bad_alloc.
void* allocate_zeroed(std::size_t size);
// `size` as it was asked for; null is fine.
void release_zeroed(void* memory, std::size_t size);

}  // namespace sinew::graph
