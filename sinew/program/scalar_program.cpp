#include "sinew/program/scalar_program.h"

#include <utility>

#include "sinew/program/dead_closures.h"
#include "sinew/program/finite.h"
#include "sinew/program/trace.h"
#include "sinew/program/validate.h"

namespace sinew::program {

ScalarProgram traced_program(Program program, const PartialOptions& partial) {
  require_valid(program);
  ScalarProgram result;
  result.program = without_dead_closures(std::move(program));
  result.snapped = snap_constants(result.program);
  if (partial.empty()) {
    result.computation = trace(result.program);
    require_finite(result.computation, result.program);
    return result;
  }
  Hoisted parts = trace_in_parts(result.program, partial);
  require_finite(parts.evaluate, result.program);
  require_finite(parts.update, result.program);
  result.computation = std::move(parts.evaluate);
  result.update = std::move(parts.update);
  return result;
}

void optimise(ScalarProgram& program, const OptimiseOptions& options) {
  program.computation = optimise(std::move(program.computation), options);
  if (program.update.dag.size() > 0) program.update = optimise(std::move(program.update), options);
}

ScalarProgram scalar_program(Program program, const OptimiseOptions& options,
                             const PartialOptions& partial) {
  ScalarProgram result = traced_program(std::move(program), partial);
  optimise(result, options);
  return result;
}

}  // namespace sinew::program
