// Derivatives that a user asks for: the Jacobian of a program's outputs with respect to its inputs
// becomes more outputs of the same program, one for each entry that is not zero in every state.
// Every back end then computes it, together with the values, from the same scalar data-flow graph.
//
// An entry is named OUT/IN after the numbers that it relates: "force.joint1/position.joint2",
// "pose.tip[3]/position.joint2". It is the partial derivative by the numbers as they are handed in:
// a quaternion's four numbers count as independent.
#pragma once

#include <span>
#include <string>

#include "sinew/program/program.h"

namespace sinew::program {

inline constexpr std::size_t kMaximumDerivativeEntries = std::size_t{1} << 20;

// Adds what is asked for with "OUT/IN", each side a quantity ("force": every output of that
// quantity) or a whole name ("force.joint1"). Throws Error, with what there is, for a side that
// names nothing, an entry that is asked for twice, and more entries than the maximum. Precondition:
// the program is valid.
void add_derivatives(Program& program, std::span<const std::string> requests);

}  // namespace sinew::program
