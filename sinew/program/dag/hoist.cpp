#include "sinew/program/dag/hoist.h"

#include "sinew/program/dag/evaluate.h"

namespace sinew::program {
namespace {

// Whether each node depends on slow inputs and constants only.
std::vector<bool> slow_nodes(const Dag& dag, const std::vector<bool>& slow) {
  std::vector<bool> is_slow(dag.size(), false);
  for (std::uint32_t i = 0; i < dag.size(); ++i) {
    const Node& node = dag.node(i);
    if (node.op == Op::kInput) {
      is_slow[i] = node.index < slow.size() && slow[node.index];
      continue;
    }
    const Ref operands[] = {node.a, node.b, node.c};
    is_slow[i] = true;
    for (int k = 0; k < arity(node.op); ++k) {
      is_slow[i] = is_slow[i] && is_slow[operands[k].node()];
    }
  }
  return is_slow;
}

}  // namespace

Hoisted hoist(const Computation& computation, const std::vector<bool>& slow) {
  const Dag& dag = computation.dag;
  const std::vector<std::uint8_t> live = live_nodes(computation);
  const std::vector<bool> is_slow = slow_nodes(dag, slow);

  Hoisted hoisted;
  hoisted.update.dag = dag;
  hoisted.update.inputs = computation.inputs;

  // The evaluation is built anew, with an input in place of each slow node that it meets.
  Dag& fast = hoisted.evaluate.dag;
  std::vector<Ref> copy(dag.size());
  std::vector<bool> copied(dag.size(), false);
  const auto held = [&](std::uint32_t i) {
    if (copied[i]) return;
    copied[i] = true;
    const Node& node = dag.node(i);
    if (node.op == Op::kConstant) {
      copy[i] = fast.constant(node.value);
    } else if (node.op == Op::kInput) {
      copy[i] = fast.input(node.index);
    } else {
      const auto index = static_cast<std::uint32_t>(hoisted.update.results.size());
      hoisted.update.results.push_back(Ref::of(i));
      copy[i] = fast.input(computation.inputs + index);
    }
  };
  const auto of = [&](Ref ref) {
    if (is_slow[ref.node()]) held(ref.node());
    return copy[ref.node()].negated_if(ref.negative());
  };
  for (std::uint32_t i = 0; i < dag.size(); ++i) {
    if (!live[i] || is_slow[i]) continue;
    const Node& node = dag.node(i);
    fast.set_origin(node.origin);
    if (node.op == Op::kInput) {
      copy[i] = fast.input(node.index);
      continue;
    }
    const int operands = arity(node.op);
    copy[i] = fast.make(node, of(node.a), operands > 1 ? of(node.b) : Ref{},
                        operands > 2 ? of(node.c) : Ref{});
  }
  for (const Ref result : computation.results) hoisted.evaluate.results.push_back(of(result));
  hoisted.evaluate.inputs =
      computation.inputs + static_cast<std::uint32_t>(hoisted.update.results.size());
  return hoisted;
}

}  // namespace sinew::program
