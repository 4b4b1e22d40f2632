// The evaluator recurses along the chain of operators; this bounds how deep.
#include <fmt/format.h>

#include <algorithm>

#include "sinew/rdf/sparql/plan/planner_class.h"
#include "sinew/rdf/sparql/syntax/limits.h"

namespace sinew::rdf::sparql::plan {
namespace {

// Where an operator may go on to, or into.
class Successors {
 public:
  explicit Successors(const Plan& plan) : plan_(plan) {}

  const std::vector<Index>& of(Index index) {
    list_.clear();
    const Op& op = plan_.ops[index];
    add(op.next);
    switch (op.kind) {
      case OpKind::kUnion:
        for (Index i = 0; i < op.item; ++i) add(plan_.branches[op.body + i]);
        break;
      case OpKind::kFilter:
      case OpKind::kDiffer:
      case OpKind::kExtend:
        add_bodies(op.item);
        break;
      case OpKind::kTable:
      case OpKind::kMinus:
        add_block(plan_.blocks[plan_.tables[op.item].block]);
        break;
      default:
        add(op.body);
        break;
    }
    return list_;
  }

 private:
  void add(Index index) {
    if (index != kNone) list_.push_back(index);
  }
  // Expressions nest no deeper than texts do.
  void add_bodies(Index index) {
    const Expression& expression = plan_.expressions[index];
    add(expression.body);
    for (std::uint32_t i = 0; i < expression.count; ++i) {
      add_bodies(plan_.arguments[expression.first + i]);
    }
  }
  void add_block(const Block& block) {
    add(block.first);
    add(block.after_groups);
    for (const Assignment& key : block.keys) add_bodies(key.expression);
    for (const SortKey& key : block.order) add_bodies(key.expression);
    for (const Aggregate& aggregate : block.aggregates) {
      if (aggregate.argument != kNone) add_bodies(aggregate.argument);
    }
  }

  const Plan& plan_;
  std::vector<Index> list_;
};

}  // namespace

void Planner::fail_too_long() const {
  const std::string what =
      fmt::format("a solution would pass through more than {} operators", kMaximumChain);
  query_.source->fail(0, what, "split the query into several");
}

void Planner::check_depth() const {
  Successors successors(*plan_);
  // Depth first, with a stack of our own: the graph of operators has no cycles.
  std::vector<std::uint32_t> depth(plan_->ops.size(), 0);
  std::vector<Index> stack;
  for (Index start = 0; start < plan_->ops.size(); ++start) {
    if (depth[start] == 0) stack.push_back(start);
    while (!stack.empty()) {
      const Index index = stack.back();
      std::uint32_t deepest = 0;
      bool complete = true;
      for (const Index next : successors.of(index)) {
        if (depth[next] == 0) {
          stack.push_back(next);
          complete = false;
        }
        deepest = std::max(deepest, depth[next]);
      }
      if (!complete) continue;
      stack.pop_back();
      depth[index] = deepest + 1;
      if (depth[index] > kMaximumChain) fail_too_long();
    }
  }
}

}  // namespace sinew::rdf::sparql::plan
