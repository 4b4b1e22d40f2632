// Long straight-line code in parts: compilers need more than twice the time for a function of twice
// the length. Each part is a function of its own; values that later parts need are kept in an
// array.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/program/dag/dag.h"

namespace sinew::backend {

struct FlatParts {
  static constexpr std::uint32_t kNoSlot = 0xffffffffU;

  std::vector<std::vector<std::uint32_t>> parts;  // nodes to compute, in order
  std::vector<std::uint32_t> slot;  // of each node, where it is kept for other parts, or kNoSlot
  std::uint32_t slots = 0;          // size of the array
};

// `nodes` are to be computed in this order, after everything in `before`; those of `last` are read
// after all of them. Where they are no more than `maximum` there are no parts.
FlatParts divide_into_parts(const program::Computation& computation,
                            const std::vector<std::uint32_t>& before,
                            const std::vector<std::uint32_t>& nodes,
                            const std::vector<program::Ref>& last, std::size_t maximum);

}  // namespace sinew::backend
