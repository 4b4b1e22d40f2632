#include "sinew/program/scalar_program.h"

#include "sinew/program/dead_closures.h"
#include "sinew/program/trace.h"
#include "sinew/program/validate.h"

namespace sinew::program {

ScalarProgram scalar_program(const Program& program, const OptimiseOptions& options) {
  require_valid(program);
  ScalarProgram result;
  result.program = without_dead_closures(program);
  result.snapped = snap_constants(result.program);
  result.computation = optimise(trace(result.program), options);
  return result;
}

}  // namespace sinew::program
