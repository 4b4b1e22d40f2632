#include "sinew/program/finite.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/program/dead_closures.h"
#include "sinew/program/interface.h"
#include "sinew/program/snap_constants.h"
#include "sinew/program/trace.h"

namespace sinew::program {
namespace {

constexpr const char* kRemedy =
    "look for bodies that no force or torque could accelerate by a finite amount, or numbers far "
    "too large or too small, there and in what it carries";

// A result that is no number by itself.
[[noreturn]] void refuse_result(std::size_t result, const Program& program) {
  Problem problem;
  problem.iri = program.iri;
  problem.what = "it divides by zero, or overflows, whatever its inputs are";
  problem.remedy = kRemedy;
  for (const Slot& slot : interface_of(program).outputs) {
    const Variable& variable = program.variables[slot.variable];
    if (result < slot.offset || result >= slot.offset + variable.size) continue;
    problem.iri = variable.represents.empty() ? variable.iri : variable.represents;
    problem.what = fmt::format("its {} is no number whatever the inputs are", variable.name);
  }
  throw Error(std::move(problem));
}

[[noreturn]] void refuse(std::uint32_t origin, const Program& program) {
  Problem problem;
  problem.iri = program.iri;
  problem.what = "it divides by zero, or overflows, whatever its inputs are";
  if (origin < program.closures.size()) {
    const Closure& closure = program.closures[origin];
    if (!closure.about.empty()) problem.iri = closure.about;
    problem.what = fmt::format("its '{}' divides by zero, or overflows, whatever the inputs are",
                               closure.operation);
  }
  problem.remedy = kRemedy;
  throw Error(std::move(problem));
}

}  // namespace

void require_finite(const Computation& computation, const Program& program) {
  const Dag& dag = computation.dag;
  const auto infinite = [&](Ref ref) {
    return dag.is_constant(ref) && !std::isfinite(dag.constant_value(ref));
  };
  // Results first, then operands: a node has a larger index than its operands, and only what is
  // used counts (a branch that a constant condition never takes may divide by zero).
  std::vector<bool> used(dag.size());
  for (std::size_t k = 0; k < computation.results.size(); ++k) {
    if (infinite(computation.results[k])) refuse_result(k, program);
    used[computation.results[k].node()] = true;
  }
  for (std::uint32_t index = dag.size(); index-- > 0;) {
    if (!used[index]) continue;
    const Node& node = dag.node(index);
    const Ref operands[] = {node.a, node.b, node.c};
    for (int k = 0; k < arity(node.op); ++k) {
      if (infinite(operands[k])) refuse(node.origin, program);
      used[operands[k].node()] = true;
    }
  }
}

void require_finite(const Program& program) {
  Program used = without_dead_closures(program);
  snap_constants(used);
  require_finite(trace(used), used);
}

}  // namespace sinew::program
