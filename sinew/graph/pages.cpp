#include "sinew/graph/pages.h"

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

// The address sanitizer is to see every block come and go.
#if defined(__SANITIZE_ADDRESS__)
#define SINEW_PLAIN_PAGES 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SINEW_PLAIN_PAGES 1
#endif
#endif
#ifndef __linux__
#define SINEW_PLAIN_PAGES 1
#endif

namespace sinew::graph {

#ifdef SINEW_PLAIN_PAGES

void* allocate_zeroed(std::size_t size) {
  void* memory = std::calloc(size, 1);
  if (!memory) throw std::bad_alloc();
  return memory;
}

void* allocate_raw(std::size_t size) {
  void* memory = std::malloc(size);
  if (!memory) throw std::bad_alloc();
  return memory;
}

void release_pages(void* memory, std::size_t) { std::free(memory); }

#else

namespace {

std::size_t rounded(std::size_t size) { return (size + kHugePage - 1) & ~(kHugePage - 1); }

// Zeroed, aligned to huge pages.
void* map_pages(std::size_t size) {
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

// Blocks of 2^n bytes, from kSmallest to half a huge page: from the list of those that came back,
// else half of the next larger one that came back, else from a huge page that is cut from its
// beginning.
class Pool {
 public:
  // `zero` tells whether the block is known to be zero.
  void* allocate(std::size_t size, bool& zero) {
    const unsigned wanted = order_of(size);
    const std::lock_guard lock(mutex_);
    unsigned order = wanted;
    while (order < kOrders && !free_[order]) ++order;
    zero = order == kOrders;
    if (zero) return cut(wanted);
    Block* const block = take(order);
    while (order > wanted) {
      --order;
      put(reinterpret_cast<char*>(block) + bytes_of(order), order);
    }
    return block;
  }
  void release(void* memory, std::size_t size) {
    const std::lock_guard lock(mutex_);
    put(memory, order_of(size));
  }

 private:
  struct Block {
    Block* next;
  };
  static constexpr std::size_t kSmallest = std::size_t{1} << 11;
  static constexpr unsigned kOrders = std::bit_width(kHugePage / kSmallest) - 1;

  static std::size_t bytes_of(unsigned order) { return kSmallest << order; }
  static unsigned order_of(std::size_t size) {
    return size <= kSmallest ? 0 : static_cast<unsigned>(std::bit_width((size - 1) / kSmallest));
  }
  Block* take(unsigned order) {
    Block* const block = free_[order];
    free_[order] = block->next;
    return block;
  }
  void put(void* memory, unsigned order) { free_[order] = new (memory) Block{free_[order]}; }
  void* cut(unsigned order) {
    if (static_cast<std::size_t>(end_ - next_) < bytes_of(order)) {
      char* const page = static_cast<char*>(map_pages(kHugePage));
      for (unsigned rest = kOrders; rest-- > 0;) {
        // What is left of the page before, in the largest blocks that fit.
        while (static_cast<std::size_t>(end_ - next_) >= bytes_of(rest)) {
          put(next_, rest);
          next_ += bytes_of(rest);
        }
      }
      next_ = page;
      end_ = page + kHugePage;
    }
    void* const block = next_;
    next_ += bytes_of(order);
    return block;
  }

  std::mutex mutex_;
  Block* free_[kOrders] = {};
  char* next_ = nullptr;
  char* end_ = nullptr;
};

// Never destroyed: stores may outlive it in static objects.
Pool& pool() {
  static Pool& made = *new Pool;
  return made;
}

// Blocks of 2^n huge pages.
class LargePool {
 public:
  void* allocate(std::size_t size, bool& zero) {
    const unsigned order = order_of(size);
    {
      const std::lock_guard lock(mutex_);
      std::vector<void*>& free = free_[order];
      zero = free.empty();
      if (!zero) {
        void* const block = free.back();
        free.pop_back();
        kept_ -= kHugePage << order;
        return block;
      }
    }
    return map_pages(kHugePage << order);
  }
  void release(void* memory, std::size_t size) {
    const unsigned order = order_of(size);
    const std::size_t bytes = kHugePage << order;
    {
      const std::lock_guard lock(mutex_);
      if (kept_ + bytes <= kMostKept) {
        free_[order].push_back(memory);
        kept_ += bytes;
        return;
      }
    }
    munmap(memory, bytes);
  }

 private:
  static unsigned order_of(std::size_t size) {
    return static_cast<unsigned>(std::bit_width((size - 1) / kHugePage));
  }
  std::mutex mutex_;
  std::vector<void*> free_[64];
  std::size_t kept_ = 0;
};

LargePool& large_pool() {
  static LargePool& made = *new LargePool;
  return made;
}

bool is_pooled(std::size_t size) { return size <= kHugePage / 2; }

void* allocate(std::size_t size, bool& zero) {
  return is_pooled(size) ? pool().allocate(size, zero) : large_pool().allocate(size, zero);
}

}  // namespace

void* allocate_zeroed(std::size_t size) {
  bool zero = false;
  void* const memory = allocate(size, zero);
  if (!zero) std::memset(memory, 0, size);
  return memory;
}

void* allocate_raw(std::size_t size) {
  bool zero = false;
  return allocate(size, zero);
}

void release_pages(void* memory, std::size_t size) {
  if (!memory) return;
  if (is_pooled(size)) {
    pool().release(memory, size);
  } else {
    large_pool().release(memory, size);
  }
}

#endif

}  // namespace sinew::graph
