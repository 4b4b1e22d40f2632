// From operators to numbers: expands a program into its scalar data-flow graph.
#pragma once

#include <vector>

#include "sinew/program/dag/dag.h"
#include "sinew/program/dag/hoist.h"
#include "sinew/program/program.h"

namespace sinew::program {

// Inputs are numbered by their offset in `interface_of(program)`: first the inputs, then the
// states. Results are the outputs, then the next values of the states. A node's origin is the index
// of the closure that asked for it. Precondition: the program is valid.
Computation trace(const Program& program);

// The same in two computations: whoever reads a variable that is `held[variable]` reads further
// inputs of `evaluate` instead, behind the states; `update` computes them from the inputs. Numbers
// that are constant stay where they are.
Hoisted trace_with_held(const Program& program, const std::vector<bool>& held);

}  // namespace sinew::program
