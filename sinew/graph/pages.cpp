#include "sinew/graph/pages.h"

#include <cstdint>
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace sinew::graph {

#ifdef __linux__

namespace {

std::size_t rounded(std::size_t size) { return (size + kHugePage - 1) & ~(kHugePage - 1); }

}  // namespace

void* allocate_zeroed(std::size_t size) {
  if (size < kHugePage) {
    void* memory = std::calloc(size, 1);
    if (!memory) throw std::bad_alloc();
    return memory;
  }
  // One huge page more than needed, then the ends that are not aligned are given back.
  const std::size_t kept = rounded(size), asked = kept + kHugePage;
  void* mapped = mmap(nullptr, asked, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  char* begin = static_cast<char*>(mapped);
  const std::size_t before =
      rounded(reinterpret_cast<std::uintptr_t>(begin)) - reinterpret_cast<std::uintptr_t>(begin);
  if (before > 0) munmap(begin, before);
  if (before < kHugePage) munmap(begin + before + kept, kHugePage - before);
  madvise(begin + before, kept, MADV_HUGEPAGE);  // a wish: it is all right if it is not granted
  return begin + before;
}

void release_zeroed(void* memory, std::size_t size) {
  if (!memory) return;
  if (size < kHugePage) {
    std::free(memory);
  } else {
    munmap(memory, rounded(size));
  }
}

#else

void* allocate_zeroed(std::size_t size) {
  void* memory = std::calloc(size, 1);
  if (!memory) throw std::bad_alloc();
  return memory;
}

void release_zeroed(void* memory, std::size_t) { std::free(memory); }

#endif

}  // namespace sinew::graph
