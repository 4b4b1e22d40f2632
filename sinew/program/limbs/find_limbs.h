// Which parts of a program do the same on different numbers: the legs of a robot, its arms. What
// they compute can then be computed side by side, one limb in each lane of a vector.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/program/program.h"

namespace sinew::program {

inline constexpr std::uint32_t kTrunk = 0xffffffffU;

// Limbs of one kind. Row c holds the closures that correspond to each other, one for each limb.
struct LimbGroup {
  std::uint32_t lanes = 0;                           // limbs
  std::vector<std::vector<std::uint32_t>> closures;  // [row][lane]: index into Program::closures
};

struct Limbs {
  std::vector<LimbGroup> groups;
  // For each closure, its group (kTrunk: none), row and lane.
  std::vector<std::uint32_t> group, row, lane;
};

// Closures correspond if they are the same operation of the same step, on arguments that correspond
// (constants and inputs of the same kind do), and what they compute is used alike; of several limbs
// that are summed up, the place in the sum does not matter. A limb is a connected set of closures
// that have correspondents; limbs with the same closures are a group. Of a group the result says
// only that its limbs look alike: which limb reads which argument is for the caller to look up.
Limbs find_limbs(const Program& program);

}  // namespace sinew::program
