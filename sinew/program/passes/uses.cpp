#include "sinew/program/passes/uses.h"

namespace sinew::program {

std::vector<std::uint32_t> use_counts(const Computation& computation) {
  const Dag& dag = computation.dag;
  std::vector<std::uint32_t> uses(dag.size(), 0);
  for (const Ref result : computation.results) ++uses[result.node()];
  // Operands have smaller indices than the nodes that use them, which are counted by then.
  for (std::uint32_t i = dag.size(); i-- > 0;) {
    if (uses[i] == 0) continue;
    const Node& node = dag.node(i);
    const int operands = arity(node.op);
    if (operands > 0) ++uses[node.a.node()];
    if (operands > 1) ++uses[node.b.node()];
    if (operands > 2) ++uses[node.c.node()];
  }
  return uses;
}

}  // namespace sinew::program
