#include "allocations.h"

#include <cstdlib>
#include <new>

// ThreadSanitizer's runtime has these operators itself, which are not replaced. Nothing is counted
// there; every other build counts.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define SINEW_NOTHING_COUNTED
#endif
#endif

namespace {

thread_local std::size_t count = 0;

}  // namespace

#ifndef SINEW_NOTHING_COUNTED
// Not inlined: GCC would take malloc and delete, or new and free, for a pair that does not match.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++count;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
// std::stable_sort asks so.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++count;
  return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
#endif

namespace sinew {

std::size_t allocations() { return count; }

}  // namespace sinew
