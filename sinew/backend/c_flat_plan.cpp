#include "sinew/backend/c_flat_plan.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace sinew::backend {
namespace {

using program::Computation;
using program::Node;
using program::Op;
using program::Ref;

bool is_trigonometric(Op op) { return op == Op::kSin || op == Op::kCos; }

// Results go to `out` as soon as they are computed, so that they need no register to the end.
// States may not be written before all have been read: with what is no operation, they come last.
void find_results(const Computation& computation, const FlatLayout& layout, FlatPlan& plan) {
  const auto count = static_cast<std::uint32_t>(computation.results.size());
  plan.result_of.assign(computation.dag.size(), kNoSlot);
  plan.next_result.assign(count, kNoSlot);
  for (std::uint32_t k = count; k-- > 0;) {
    const std::uint32_t node = computation.results[k].node();
    const Op op = computation.dag.node(node).op;
    const bool at_once = std::string_view(layout.results[k].array) == "out" &&
                         program::arity(op) > 0 && !is_trigonometric(op);
    if (at_once) {
      plan.next_result[k] = std::exchange(plan.result_of[node], k);
    } else {
      plan.later.push_back(k);
    }
  }
  std::reverse(plan.later.begin(), plan.later.end());
}

// The steps are those of FlatEmitter::run(): one for each node, one for each group of angles, and
// the end.
ValueSteps steps_of(const Computation& computation, const FlatPlan& plan) {
  const program::Dag& dag = computation.dag;
  ValueSteps steps(dag.size());
  const auto read_node = [&](std::uint32_t i) {
    const Op op = dag.node(i).op;
    if (program::arity(op) > 0 && !is_trigonometric(op)) steps.read(i);
  };
  const auto read = [&](Ref ref) { read_node(ref.node()); };
  const auto node = [&](std::uint32_t i) {
    const Node& n = dag.node(i);
    if (is_trigonometric(n.op)) return;
    const int operands = program::arity(n.op);
    if (n.op == Op::kSelect) {
      read(dag.node(n.a).a);
      read(dag.node(n.a).b);
    } else if (operands > 0) {
      read(n.a);
    }
    if (operands > 1) read(n.b);
    if (operands > 2) read(n.c);
    steps.define(i);
    steps.end();
  };
  for (const AngleGroup& group : plan.groups.groups) {
    for (const std::uint32_t i : group.before) node(i);
    for (const std::uint32_t angle : group.angles) read_node(angle);
    steps.end();
  }
  for (const std::uint32_t i : plan.groups.after) node(i);
  for (const std::uint32_t k : plan.later) read(computation.results[k]);
  steps.end();
  return steps;
}

}  // namespace

FlatPlan plan_flat(const Computation& computation, const FlatLayout& layout, FlatForm form,
                   std::size_t maximum_statements) {
  FlatPlan plan;
  find_results(computation, layout, plan);
  plan.groups = group_angles(computation);
  if (form != FlatForm::kThread && plan.groups.after.size() <= maximum_statements)
    plan.kept = keep_values(steps_of(computation, plan));
  return plan;
}

}  // namespace sinew::backend
