// Memory for the tables of stores and dictionaries.
//
// A page that the system has never given to this process costs a page fault, some ten times what it
// costs to write the page again, and stores are filled faster than faults are served. So small
// blocks are cut from huge pages (where the system has them) and kept for the next store when they
// come back: at most as much stays here as was in use at once, in blocks of each size. Larger
// blocks than half a huge page are mapped in huge pages of their own; kMostKept bytes of them stay
// here, what is beyond goes back to the system.
//
// Any thread may allocate and release.
#pragma once

#include <cstddef>

namespace sinew::graph {

inline constexpr std::size_t kHugePage = std::size_t{1} << 21;
inline constexpr std::size_t kMostKept = 32 * kHugePage;

// Throw std::bad_alloc.
void* allocate_zeroed(std::size_t size);
void* allocate_raw(std::size_t size);  // whatever it holds
// `size` as it was asked for; null is fine.
void release_pages(void* memory, std::size_t size);

}  // namespace sinew::graph
