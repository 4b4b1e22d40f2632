#include "sinew/program/passes/uses.h"

#include "sinew/program/dag/evaluate.h"

namespace sinew::program {

std::vector<std::uint32_t> use_counts(const Computation& computation) {
  const Dag& dag = computation.dag;
  const std::vector<bool> live = live_nodes(computation);
  std::vector<std::uint32_t> uses(dag.size(), 0);
  for (std::uint32_t i = 0; i < dag.size(); ++i) {
    if (!live[i]) continue;
    const Node& node = dag.node(i);
    const int operands = arity(node.op);
    if (operands > 0) ++uses[node.a.node()];
    if (operands > 1) ++uses[node.b.node()];
    if (operands > 2) ++uses[node.c.node()];
  }
  for (const Ref result : computation.results) ++uses[result.node()];
  return uses;
}

}  // namespace sinew::program
