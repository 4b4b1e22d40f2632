// Constants that differ from 0 or ±1 by round-off become exactly that, so that the operations with
// them vanish. What is round-off is decided by size: a rotation's entry within 1e-12 of 0 or ±1; a
// length or a part of an inertia or twist that is smaller than a small share of the largest of its
// kind.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/program/program.h"

namespace sinew::program {

inline constexpr double kRotationTolerance = 1e-12;  // of direction cosines
inline constexpr double kLengthShare = 1e-14;        // of the largest length in the program's poses
inline constexpr double kInertiaShare = 1e-14;       // of the largest mass, first or second moment
inline constexpr double kTwistShare = 1e-14;         // of the largest part of the same twist

struct SnappedConstant {
  std::uint32_t variable = 0;
  std::uint32_t number = 0;  // which of the variable's numbers
  double from = 0.0, to = 0.0;
};

// Changes the program's constants and returns what it has changed.
std::vector<SnappedConstant> snap_constants(Program& program);

}  // namespace sinew::program
