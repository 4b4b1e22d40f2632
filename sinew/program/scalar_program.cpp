#include "sinew/program/scalar_program.h"

#include "sinew/program/dead_closures.h"
#include "sinew/program/finite.h"
#include "sinew/program/trace.h"
#include "sinew/program/validate.h"

namespace sinew::program {

ScalarProgram scalar_program(const Program& program, const OptimiseOptions& options,
                             const PartialOptions& partial) {
  require_valid(program);
  ScalarProgram result;
  result.program = without_dead_closures(program);
  result.snapped = snap_constants(result.program);
  if (partial.empty()) {
    Computation traced = trace(result.program);
    require_finite(traced, result.program);
    result.computation = optimise(std::move(traced), options);
    return result;
  }
  Hoisted parts = trace_in_parts(result.program, partial);
  require_finite(parts.evaluate, result.program);
  require_finite(parts.update, result.program);
  result.computation = optimise(std::move(parts.evaluate), options);
  result.update = optimise(std::move(parts.update), options);
  return result;
}

}  // namespace sinew::program
