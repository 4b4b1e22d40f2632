// SELECTs: slots, blocks, and the checks of a whole plan.
#include <fmt/format.h>

#include <algorithm>

#include "sinew/rdf/sparql/plan/planner_class.h"
#include "sinew/rdf/sparql/syntax/limits.h"

namespace sinew::rdf::sparql::plan {

Planner::Planner(const algebra::Query& query, const graph::View& view, const DatasetPlan& dataset)
    : query_(query),
      view_(view),
      plan_(std::make_shared<Plan>()),
      next_variable_(static_cast<Variable>(query.names.size())) {
  plan_->dataset = dataset;
  plan_->source = query.source;
  plan_->base = query.base;
  plan_->planned_for = view.size();
}

Slot Planner::fresh_slot(std::string name) {
  plan_->initial.push_back({});
  plan_->slot_names.push_back(std::move(name));
  return static_cast<Slot>(plan_->initial.size() - 1);
}

Slot Planner::slot(Variable variable, const Context& context) {
  if (context.renamed) {
    if (const auto found = context.renamed->find(variable); found != context.renamed->end()) {
      return found->second;
    }
  }
  if (const auto found = slots_.find(variable); found != slots_.end()) return found->second;
  const Slot made = fresh_slot(variable < query_.names.size() ? query_.names[variable] : "");
  slots_.emplace(variable, made);
  return made;
}

Slot Planner::constant(graph::Id id) {
  if (const auto found = constants_.find(id); found != constants_.end()) return found->second;
  const Slot made = fresh_slot({});
  plan_->initial[made] = id;
  constants_.emplace(id, made);
  return made;
}

Index Planner::block(const algebra::Select& select, const Context& context) {
  const Index number = static_cast<Index>(plan_->blocks.size());
  plan_->blocks.emplace_back();
  Block result;
  result.first = next_op();
  result.distinct = select.distinct || select.reduced;
  result.limit = select.limit;
  result.offset = select.offset;
  result.grouped = select.grouped;
  // REDUCED may leave duplicates; keeping them costs nothing.
  if (select.reduced) result.distinct = false;

  std::vector<Item> items;
  gather_safely(select.where, context, items);
  const std::size_t end = items.size();
  VariableSet visible = select.where.possible;
  const auto assign = [&](std::vector<Item>& list, std::size_t scope_end) {
    for (const algebra::Assignment& assignment : select.assignments) {
      Item& item = list.emplace_back();
      item.kind = Item::Kind::kExtend;
      item.expression = &assignment.expression;
      item.variable = assignment.variable;
      item.extra_visible = visible;
      item.graph_kind = context.graph_kind;
      item.graph = context.graph;
      item.possible = {assignment.variable};
      item.needs = algebra::variables_of(assignment.expression);
      item.needs.keep_only(visible);
      item.scope_end = scope_end++;
      visible.add(assignment.variable);
    }
  };
  if (!select.grouped) assign(items, end);
  order_and_emit(items, context);
  plan_->ops[add_op(OpKind::kEmit)].item = number;

  if (select.grouped) {
    // Only keys and aggregates are left behind the groups.
    VariableSet keys;
    for (const algebra::Assignment& key : select.keys) {
      const Index compiled = expression(key.expression, visible, context);
      result.keys.push_back({slot(key.variable, context), compiled});
      keys.add(key.variable);
    }
    for (const algebra::Aggregate& aggregate : select.aggregates) {
      Aggregate made;
      made.op = aggregate.op;
      made.distinct = aggregate.distinct;
      made.separator = aggregate.separator;
      if (aggregate.distinct && !aggregate.argument && result.solution.empty()) {
        for (const Variable variable : select.where.possible) {
          const bool named = variable < query_.names.size() && query_.names[variable][0] != '.';
          if (named) result.solution.push_back(slot(variable, context));
        }
      }
      if (aggregate.argument) made.argument = expression(*aggregate.argument, visible, context);
      made.result = slot(aggregate.result, context);
      result.aggregates.push_back(std::move(made));
      keys.add(aggregate.result);
    }
    visible = keys;
    Context after = context;
    after.maybe.add(keys);
    std::vector<Item> late;
    for (const algebra::Expression& condition : select.having) {
      Item& item = late.emplace_back();
      item.kind = Item::Kind::kFilter;
      item.expression = &condition;
      item.extra_visible = visible;
      item.graph_kind = context.graph_kind;
      item.graph = context.graph;
    }
    if (select.values) {
      gather(*select.values, after, late);
      visible.add(select.values->possible);
    }
    assign(late, late.size());
    result.after_groups = next_op();
    order_and_emit(late, after);
    plan_->ops[add_op(OpKind::kEmit)].item = number;
  }
  for (const algebra::Order& order : select.order) {
    result.order.push_back({expression(order.expression, visible, context), order.descending});
  }
  for (const Variable column : select.columns) {
    // A column that nothing binds stays empty, whatever its name is bound to around.
    result.columns.push_back(slot(column, context));
  }
  plan_->blocks[number] = std::move(result);
  return number;
}

std::shared_ptr<const Plan> Planner::run() {
  Context context;
  for (const Variable parameter : query_.parameters) {
    slot(parameter, context);
    context.constants.add(parameter);
  }
  plan_->parameter_count = static_cast<std::uint32_t>(query_.parameters.size());
  context.fixed = context.constants;
  context.bound = context.constants;
  block(query_.select, context);
  for (const Variable column : query_.select.columns) {
    plan_->columns.push_back(query_.names[column]);
  }
  // Nothing may stand behind the last operator of a chain but an end, so every jump has a target.
  const auto target = [&](Index index) {
    while (plan_->ops[index].kind == OpKind::kJump) index = plan_->ops[index].next;
    return index;
  };
  for (Op& op : plan_->ops) {
    const bool ends = op.kind == OpKind::kEmit || op.kind == OpKind::kFound;
    op.next = ends || op.next == kNone ? kNone : target(op.next);
    if (op.body != kNone && op.kind != OpKind::kUnion) op.body = target(op.body);
  }
  for (Index& branch : plan_->branches) branch = target(branch);
  for (Expression& expression : plan_->expressions) {
    if (expression.body != kNone) expression.body = target(expression.body);
  }
  for (Block& block : plan_->blocks) {
    block.first = target(block.first);
    if (block.after_groups != kNone) block.after_groups = target(block.after_groups);
  }
  check_depth();
  return plan_;
}

std::shared_ptr<const Plan> make_plan(const algebra::Query& query, const graph::View& view,
                                      const DatasetPlan& dataset) {
  return Planner(query, view, dataset).run();
}

DatasetPlan dataset_of(const syntax::DatasetClause& clause, graph::Dataset chosen) {
  DatasetPlan result;
  result.kind = chosen == graph::Dataset::kUnion ? DatasetPlan::Default::kUnion
                                                 : DatasetPlan::Default::kUnnamed;
  if (!clause.given) return result;
  result.kind = DatasetPlan::Default::kMerge;
  result.merged = clause.defaults;
  result.named_restricted = true;
  result.named = clause.named;
  return result;
}

}  // namespace sinew::rdf::sparql::plan
