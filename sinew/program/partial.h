// Partial evaluation of a program: what changes rarely is computed apart, by an update that the
// caller runs when it likes, and kept for the evaluations in between.
//
// Two kinds of things can be kept. A *slow* input (a payload, gravity, the orientation of the base)
// changes rarely by itself: keeping what depends on it alone changes no result, as long as the
// update runs after each change. A *held* data block (an articulated-body inertia, say) changes all
// the time, and keeping it is an approximation that the user asks for: evaluations use the value of
// the last update.
#pragma once

#include <string>
#include <vector>

#include "sinew/program/dag/hoist.h"
#include "sinew/program/program.h"

namespace sinew::program {

// Each name is a variable's ("position.joint1"), the first part of some variables' names
// ("position"), or a quantity ("articulated-body-inertia").
struct PartialOptions {
  std::vector<std::string> slow;  // inputs
  std::vector<std::string> held;  // anything that is computed

  bool empty() const { return slow.empty() && held.empty(); }
};

// These, and the variables that the program itself says to be held (a query's policy), by their
// names: inputs are slow.
PartialOptions with_held(const Program& program, PartialOptions options);

// The program in two computations, as in hoist.h; inputs and results of `evaluate` are those of
// trace.h, with the kept values behind the inputs and states. Precondition: the program is valid.
// Throws Error for a name that fits no input (slow) or nothing that is computed (held), and for
// derivatives of results that something held goes into.
Hoisted trace_in_parts(const Program& program, const PartialOptions& options);

}  // namespace sinew::program
