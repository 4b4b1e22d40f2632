#include "kept_memory.h"

#include <malloc.h>

namespace sinew::cli {
namespace {

constexpr int kKeptBytes = 256 << 20;
constexpr int kBytesAtOnce = 16 << 20;

}  // namespace

void keep_memory() {
  mallopt(M_MMAP_THRESHOLD, kKeptBytes);
  mallopt(M_TRIM_THRESHOLD, kKeptBytes);
  mallopt(M_TOP_PAD, kBytesAtOnce);
}

}  // namespace sinew::cli
