// Constants that differ from 0 or ±1 by round-off become exactly that, so that the operations with
// them vanish. What is round-off is decided by size: a rotation's entry within 1e-12 of 0 or ±1; a
// length that is a small share of a metre, or of the longest where all are shorter; a part of an
// inertia or twist beside the other parts of the same one. Beside those of another body, however
// heavy, nothing is round-off: what a light finger at the end of a crane needs depends on it alone.
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/program/program.h"

namespace sinew::program {

inline constexpr double kRotationTolerance = 1e-12;  // of direction cosines
inline constexpr double kLengthShare = 1e-14;        // of a metre or, if that is less, the longest
inline constexpr double kInertiaShare = 1e-14;       // of the same inertia's largest second moment
inline constexpr double kTwistShare = 1e-14;         // of the largest part of the same twist

struct SnappedConstant {
  std::uint32_t variable = 0;
  std::uint32_t number = 0;  // which of the variable's numbers
  double from = 0.0, to = 0.0;
};

// Changes the program's constants and returns what it has changed.
std::vector<SnappedConstant> snap_constants(Program& program);

}  // namespace sinew::program
