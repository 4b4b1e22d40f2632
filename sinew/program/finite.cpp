#include "sinew/program/finite.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "sinew/base/error.h"

namespace sinew::program {
namespace {

[[noreturn]] void refuse(std::uint32_t origin, const Program& program) {
  Problem problem;
  problem.iri = program.iri;
  problem.what = "it divides by zero whatever its inputs are";
  if (origin < program.closures.size()) {
    const Closure& closure = program.closures[origin];
    if (!closure.about.empty()) problem.iri = closure.about;
    problem.what = fmt::format("its '{}' divides by zero, or overflows, whatever the inputs are",
                               closure.operation);
  }
  problem.remedy =
      "look for bodies that no force or torque could accelerate by a finite amount, or numbers far "
      "too large or too small, there and in what it carries";
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
  for (const Ref result : computation.results) {
    if (infinite(result)) refuse(dag.node(result).origin, program);
    used[result.node()] = true;
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

}  // namespace sinew::program
