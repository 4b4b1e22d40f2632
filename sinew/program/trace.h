// From operators to numbers: expands a program into its scalar data-flow graph.
#pragma once

#include "sinew/program/dag/dag.h"
#include "sinew/program/program.h"

namespace sinew::program {

// Inputs are numbered by their offset in `interface_of(program)`: first the inputs, then the
// states. Results are the outputs, then the next values of the states. A node's origin is the index
// of the closure that asked for it. Precondition: the program is valid.
Computation trace(const Program& program);

}  // namespace sinew::program
