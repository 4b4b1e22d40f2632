#include "sinew/program/passes/share_denominators.h"

#include "sinew/program/dag/evaluate.h"

namespace sinew::program {

// NOLINTNEXTLINE(performance-unnecessary-value-param): all passes are called alike.
Computation share_denominators(Computation computation) {
  const Dag& dag = computation.dag;
  const std::vector<std::uint8_t> live = live_nodes(computation);
  std::vector<std::uint32_t> quotients(dag.size(), 0);  // of each denominator
  bool shared = false;
  for (std::uint32_t i = 0; i < dag.size(); ++i) {
    if (live[i] && dag.node(i).op == Op::kDivide) shared |= ++quotients[dag.node(i).b.node()] > 1;
  }
  if (!shared) return computation;

  Computation result;
  result.inputs = computation.inputs;
  std::vector<Ref> copy(dag.size());
  const auto operand = [&](Ref r) { return copy[r.node()].negated_if(r.negative()); };
  for (std::uint32_t i = 0; i < dag.size(); ++i) {
    if (!live[i]) continue;
    const Node& node = dag.node(i);
    const int operands = arity(node.op);
    const Ref a = operands > 0 ? operand(node.a) : Ref{};
    const Ref b = operands > 1 ? operand(node.b) : Ref{};
    const Ref c = operands > 2 ? operand(node.c) : Ref{};
    result.dag.set_origin(node.origin);
    if (node.op == Op::kDivide && quotients[node.b.node()] > 1) {
      const Ref reciprocal = result.dag.divide(result.dag.constant(1.0), b);
      copy[i] = result.dag.multiply(a, reciprocal);
    } else {
      copy[i] = result.dag.make(node, a, b, c);
    }
  }
  for (const Ref r : computation.results) result.results.push_back(operand(r));
  return result;
}

}  // namespace sinew::program
