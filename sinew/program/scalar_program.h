// All the way from a program to the scalar data-flow graph that back ends turn into code.
#pragma once

#include "sinew/program/partial.h"
#include "sinew/program/passes/passes.h"
#include "sinew/program/program.h"
#include "sinew/program/snap_constants.h"

namespace sinew::program {

struct ScalarProgram {
  Program program;  // with what is not needed removed and its constants snapped
  std::vector<SnappedConstant> snapped;
  Computation computation;  // of that program: inputs and results as in trace.h
  // What `computation` reads behind its inputs and states; no results unless something is kept.
  Computation update;
};

// Removes dead closures, snaps constants and traces. Throws Error if the program is not valid,
// divides by a constant zero, or a name in `partial` fits nothing.
ScalarProgram traced_program(Program program, const PartialOptions& partial = {});
// Runs the passes over it.
void optimise(ScalarProgram& program, const OptimiseOptions& options = {});

// Both.
ScalarProgram scalar_program(Program program, const OptimiseOptions& options = {},
                             const PartialOptions& partial = {});

}  // namespace sinew::program
