// All the way from a program to the scalar data-flow graph that back ends turn into code.
#pragma once

#include "sinew/program/passes/passes.h"
#include "sinew/program/program.h"
#include "sinew/program/snap_constants.h"

namespace sinew::program {

struct ScalarProgram {
  Program program;  // with what is not needed removed and its constants snapped
  std::vector<SnappedConstant> snapped;
  Computation computation;  // of that program: inputs and results as in trace.h
};

// Removes dead closures, snaps constants, traces and optimises. Throws Error if the program is not
// valid.
ScalarProgram scalar_program(const Program& program, const OptimiseOptions& options = {});

}  // namespace sinew::program
