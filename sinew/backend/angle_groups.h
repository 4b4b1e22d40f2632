// The order of a flat function: first all angles, then all their sines and cosines at once, then
// the rest. An angle that itself depends on a sine comes in a later group.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/program/dag/dag.h"

namespace sinew::backend {

struct AngleGroup {
  static constexpr std::uint32_t kNone = 0xffffffffU;

  std::vector<std::uint32_t> before;   // nodes to compute first, in order
  std::vector<std::uint32_t> angles;   // nodes
  std::vector<std::uint32_t> sines;    // for each angle, the node of its sine, or kNone
  std::vector<std::uint32_t> cosines;  // the same for its cosine
};

struct AngleGroups {
  std::vector<AngleGroup> groups;
  std::vector<std::uint32_t> after;  // the other nodes to compute, in order
};

// Constants, inputs and conditions are not listed: they need no statement of their own.
AngleGroups group_angles(const program::Computation& computation);

}  // namespace sinew::backend
