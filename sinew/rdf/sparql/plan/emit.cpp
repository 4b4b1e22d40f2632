// Items to operators.
#include <utility>

#include "sinew/rdf/sparql/plan/planner_class.h"
#include "sinew/rdf/sparql/plan/safety.h"

namespace sinew::rdf::sparql::plan {

Index Planner::add_op(OpKind kind) {
  Op op;
  op.kind = kind;
  op.next = next_op() + 1;
  plan_->ops.push_back(op);
  return next_op() - 1;
}

void Planner::emit_pattern(const Pattern& pattern, const Context& context) {
  std::vector<Item> items;
  gather(pattern, context, items);
  order_and_emit(items, context);
}

void Planner::emit(const Item& item, const Context& context, double estimate) {
  const Index first = next_op();
  switch (item.kind) {
    case Item::Kind::kTriple:
    case Item::Kind::kPath:
      emit_triple(item, context);
      break;
    case Item::Kind::kGraphNames:
    case Item::Kind::kScope:
      emit_scope(item, context);
      break;
    case Item::Kind::kFilter:
      emit_filter(item, context);
      break;
    case Item::Kind::kExtend:
      emit_extend(item, context);
      break;
    case Item::Kind::kOptional:
      emit_optional(item, context);
      break;
    case Item::Kind::kUnion:
      emit_union(item, context);
      break;
    case Item::Kind::kValues:
      emit_values(item, context);
      break;
    case Item::Kind::kTable:
      emit_table(item, context);
      break;
    case Item::Kind::kMinus:
      emit_minus(item, context);
      break;
    case Item::Kind::kRefuse:
      plan_->ops[add_op(OpKind::kRefuse)].item = static_cast<Index>(item.pattern->offset);
      break;
  }
  if (first < next_op()) plan_->ops[first].estimate = estimate;
}

void Planner::emit_triple(const Item& item, const Context& context) {
  const bool is_path = item.kind == Item::Kind::kPath;
  const algebra::Triple& triple = item.triple;
  const Slot subject = node(triple.subject, context);
  const Slot predicate = is_path ? 0 : node(triple.predicate, context);
  const Slot object = node(triple.object, context);
  std::uint8_t free = 0;
  const auto is_free = [&](algebra::Node node) {
    return node.is_variable && !context.bound.has(node.value) && !context.maybe.has(node.value) &&
           !context.constants.has(node.value);
  };
  // A variable that stands twice is free only the first time; the other place compares.
  if (is_free(triple.subject)) free |= 1;
  if (!is_path && is_free(triple.predicate) && predicate != subject) free |= 2;
  if (is_free(triple.object) && object != subject && (is_path || object != predicate)) free |= 4;

  Op& op = plan_->ops[add_op(is_path ? OpKind::kPath : OpKind::kMatch)];
  op.subject = subject;
  op.predicate = predicate;
  op.object = object;
  op.free = free;
  op.graph_kind = item.graph_kind;
  op.graph = item.graph;
  // Places whose slot is the same as another's are compared at run time.
  op.repeats = subject == object || (!is_path && (predicate == subject || predicate == object)) ||
               (op.graph_kind == GraphKind::kNamed &&
                (op.graph == subject || op.graph == object || (!is_path && op.graph == predicate)));
  if (is_path) {
    const auto varies = [&](algebra::Node node) {
      return node.is_variable && !context.constants.has(node.value);
    };
    op.nodes_only = varies(triple.subject) && varies(triple.object);
    op.item = static_cast<Index>(plan_->path_roots.size());
    plan_->path_roots.push_back(compile_path(*triple.path, plan_->paths));
  }
}

VariableSet Planner::visible_to(const Item& item) const {
  VariableSet visible = item.extra_visible;
  if (item.visible) visible.add(*item.visible);
  return visible;
}

void Planner::emit_filter(const Item& item, const Context& context) {
  Context here = context;
  here.graph_kind = item.graph_kind;
  here.graph = item.graph;
  const VariableSet visible = visible_to(item);
  const algebra::Expression& condition = *item.expression;
  // EXISTS at the top of a filter needs no expression.
  if (condition.op == Operator::kExists || condition.op == Operator::kNotExists) {
    const Index body = exists_body(*condition.pattern, visible, here);
    Op& op = plan_->ops[add_op(OpKind::kExists)];
    op.body = body;
    op.negated = condition.op == Operator::kNotExists;
    return;
  }
  const Index compiled = expression(condition, visible, here);
  const auto is_leaf = [&](Index index) {
    const Operator leaf = plan_->expressions[index].op;
    return leaf == Operator::kVariable || leaf == Operator::kConstant;
  };
  const Expression& top = plan_->expressions[compiled];
  const bool compares = (top.op == Operator::kEqual || top.op == Operator::kNotEqual) &&
                        is_leaf(plan_->arguments[top.first]) &&
                        is_leaf(plan_->arguments[top.first + 1]);
  const Index added = add_op(compares ? OpKind::kDiffer : OpKind::kFilter);
  Op& op = plan_->ops[added];
  op.item = compiled;
  if (!compares) return;
  op.negated = top.op == Operator::kEqual;
  op.subject = plan_->expressions[plan_->arguments[top.first]].slot;
  op.object = plan_->expressions[plan_->arguments[top.first + 1]].slot;
}

void Planner::emit_extend(const Item& item, const Context& context) {
  Context here = context;
  here.graph_kind = item.graph_kind;
  here.graph = item.graph;
  const Index compiled = expression(*item.expression, visible_to(item), here);
  const Slot target = slot(item.variable, here);
  Op& op = plan_->ops[add_op(OpKind::kExtend)];
  op.item = compiled;
  op.subject = target;
}

void Planner::emit_optional(const Item& item, const Context& context) {
  const Pattern& left = item.pattern->parts[0];
  const Pattern& right = item.pattern->parts[1];
  const Index optional = add_op(OpKind::kOptional);
  const std::uint32_t flag = plan_->flag_count++;
  plan_->ops[optional].body = next_op();
  plan_->ops[optional].item = flag;

  Context inside = context;
  inside.graph_kind = item.graph_kind;
  inside.graph = item.graph;
  std::vector<Item> items;
  gather_safely(right, inside, items);
  const std::size_t end = items.size();
  VariableSet visible = left.possible;
  visible.add(right.possible);
  for (const algebra::Expression& condition : item.pattern->conditions) {
    Item& filter = items.emplace_back();
    filter.kind = Item::Kind::kFilter;
    filter.expression = &condition;
    filter.extra_visible = visible;
    filter.graph_kind = item.graph_kind;
    filter.graph = item.graph;
    filter.needs = algebra::variables_of(condition);
    filter.needs.keep_only(right.possible);
    filter.scope_end = end;
  }
  order_and_emit(items, inside);
  plan_->ops[add_op(OpKind::kOptionalEnd)].item = flag;
  plan_->ops[optional].next = next_op();
}

void Planner::emit_union(const Item& item, const Context& context) {
  Context inside = context;
  inside.graph_kind = item.graph_kind;
  inside.graph = item.graph;
  const Index head = add_op(OpKind::kUnion);
  std::vector<Index> branches;
  std::vector<Index> jumps;
  for (const Pattern& part : item.pattern->parts) {
    branches.push_back(next_op());
    std::vector<Item> items;
    gather_safely(part, inside, items);
    order_and_emit(items, inside);
    jumps.push_back(add_op(OpKind::kJump));
  }
  for (const Index jump : jumps) plan_->ops[jump].next = next_op();
  plan_->ops[head].next = next_op();
  plan_->ops[head].body = static_cast<Index>(plan_->branches.size());
  plan_->ops[head].item = static_cast<Index>(branches.size());
  plan_->branches.insert(plan_->branches.end(), branches.begin(), branches.end());
}

void Planner::emit_values(const Item& item, const Context& context) {
  ValuesTable table;
  for (const Variable variable : item.pattern->value_variables) {
    table.slots.push_back(slot(variable, context));
  }
  table.row_count = item.pattern->value_rows.size();
  for (const auto& row : item.pattern->value_rows) {
    table.cells.insert(table.cells.end(), row.begin(), row.end());
  }
  plan_->ops[add_op(OpKind::kValues)].item = static_cast<Index>(plan_->values.size());
  plan_->values.push_back(std::move(table));
}

Index Planner::sub_plan(const Pattern& pattern, const VariableSet& columns,
                        const Context& context) {
  const Index skip = add_op(OpKind::kJump);
  Context inside = context;
  inside.bound = context.fixed;
  inside.maybe = {};
  SubPlan table;
  for (const Variable variable : context.constants) {
    const Slot read = slot(variable, context);
    if (read >= plan_->parameter_count) table.depends.push_back(read);
  }
  if (context.graph_kind == GraphKind::kNamed) table.depends.push_back(context.graph);
  if (pattern.kind == Pattern::Kind::kSelect) {
    table.block = block(*pattern.select, inside);
  } else {
    Block rows;
    rows.first = next_op();
    for (const Variable variable : columns) rows.columns.push_back(slot(variable, inside));
    emit_pattern(pattern, inside);
    const Index emit = add_op(OpKind::kEmit);
    table.block = static_cast<Index>(plan_->blocks.size());
    plan_->ops[emit].item = table.block;
    plan_->blocks.push_back(std::move(rows));
  }
  plan_->ops[skip].next = next_op();
  plan_->tables.push_back(std::move(table));
  return static_cast<Index>(plan_->tables.size() - 1);
}

void Planner::emit_table(const Item& item, const Context& context) {
  Context here = context;
  here.graph_kind = item.graph_kind;
  here.graph = item.graph;
  const Pattern& pattern = *item.pattern;
  const Index table = sub_plan(pattern, pattern.possible, here);
  const Block& block = plan_->blocks[plan_->tables[table].block];
  // Look rows up by what both sides surely bind.
  VariableSet key = pattern.certain;
  key.keep_only(context.bound);
  for (const Variable variable : key) {
    const Slot wanted = slot(variable, here);
    for (Index column = 0; column < block.columns.size(); ++column) {
      if (block.columns[column] == wanted) plan_->tables[table].key.push_back(column);
    }
  }
  plan_->ops[add_op(OpKind::kTable)].item = table;
}

void Planner::emit_minus(const Item& item, const Context& context) {
  const Pattern& left = item.pattern->parts[0];
  const Pattern& right = item.pattern->parts[1];
  VariableSet shared = right.possible;
  shared.keep_only(left.possible);
  if (shared.empty())
    return;  // nothing is ever removed (SPARQL 1.1, section 18.5: disjoint domains)
  Context here = context;
  here.graph_kind = item.graph_kind;
  here.graph = item.graph;
  VariableSet flowing = shared;
  flowing.remove(context.fixed);
  VariableSet surely = left.certain;
  surely.keep_only(right.certain);
  if (!surely.empty() && safe_inside(right, flowing)) {
    // Domains always overlap: the same as NOT EXISTS, which stops at the first match.
    const Index skip = add_op(OpKind::kJump);
    Context inside = here;
    inside.maybe = flowing;
    std::unordered_map<Variable, Slot> renamed;
    hide(right, context, inside, renamed);
    inside.bound.keep_only([&] {
      VariableSet kept = shared;
      kept.add(context.fixed);
      return kept;
    }());
    const Index body = next_op();
    std::vector<Item> items;
    gather_safely(right, inside, items);
    order_and_emit(items, inside);
    add_op(OpKind::kFound);
    plan_->ops[skip].next = next_op();
    Op& op = plan_->ops[add_op(OpKind::kExists)];
    op.body = body;
    op.negated = true;
    return;
  }
  const Index table = sub_plan(right, shared, here);
  plan_->ops[add_op(OpKind::kMinus)].item = table;
}

void Planner::emit_scope(const Item& item, const Context& context) {
  const Pattern& part = item.pattern->parts[0];
  const algebra::Node name = item.pattern->name;
  Context inside = context;
  // Expressions inside do not see the graph's variable unless the pattern there binds it.
  const bool hidden = name.is_variable && !context.fixed.has(name.value) &&
                      algebra::mentioned(part).has(name.value);
  Variable variable = name.value;
  if (hidden) variable = fresh_variable();
  inside.graph_kind = GraphKind::kNamed;
  inside.graph = name.is_variable ? slot(variable, context) : constant(graph::Id{name.value});
  Op& op = plan_->ops[add_op(OpKind::kGraphNames)];
  op.graph = inside.graph;
  if (name.is_variable) {
    inside.constants.add(variable);
    inside.fixed.add(variable);
    inside.bound.add(variable);
    inside.maybe.remove(variable);
  }
  std::vector<Item> items;
  gather_safely(part, inside, items);
  order_and_emit(items, inside);
  if (!hidden) return;
  Expression copy;
  copy.op = Operator::kVariable;
  copy.slot = inside.graph;
  plan_->expressions.push_back(copy);
  const Slot target = slot(name.value, context);
  Op& extend = plan_->ops[add_op(OpKind::kExtend)];
  extend.item = static_cast<Index>(plan_->expressions.size() - 1);
  extend.subject = target;
}

}  // namespace sinew::rdf::sparql::plan
