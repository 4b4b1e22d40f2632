// Whether a program can be evaluated at all: no constant in it is infinite or not a number.
#pragma once

#include "sinew/program/dag/dag.h"
#include "sinew/program/program.h"

namespace sinew::program {

// Throws Error where a result depends on a constant that is no number, which is what is left of a
// division by a constant zero: of a force by the inertia of a body that has none about its joint's
// axis, say. No input would ever make a number of it. The error names what the closure that asked
// for it is about.
void require_finite(const Computation& computation, const Program& program);

// The same for what evaluates a program closure by closure, without tracing it: refuses what
// scalar_program() refuses. Precondition: the program is valid.
void require_finite(const Program& program);

}  // namespace sinew::program
