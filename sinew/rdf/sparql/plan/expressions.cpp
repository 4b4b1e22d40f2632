#include "sinew/rdf/sparql/plan/planner_class.h"

namespace sinew::rdf::sparql::plan {

Index Planner::expression(const algebra::Expression& source, const VariableSet& visible,
                          const Context& context) {
  Expression result;
  result.op = source.op;
  result.offset = source.offset;
  switch (source.op) {
    case Operator::kConstant:
      result.slot = constant(source.term);
      break;
    case Operator::kVariable:
    case Operator::kBound:
      if (visible.has(source.variable) || context.constants.has(source.variable)) {
        result.slot = slot(source.variable, context);
      } else if (source.op == Operator::kVariable) {
        result.op = Operator::kUnbound;
      } else {
        result.slot = fresh_slot("never");
      }
      break;
    case Operator::kExists:
    case Operator::kNotExists:
      result.body = exists_body(*source.pattern, visible, context);
      break;
    case Operator::kCall:
      result.function = source.term;
      break;
    case Operator::kRegex:
    case Operator::kReplace:
      result.cache = plan_->cache_count++;
      break;
    default:
      break;
  }
  std::vector<Index> arguments;
  for (const algebra::Expression& argument : source.arguments) {
    arguments.push_back(expression(argument, visible, context));
  }
  result.first = static_cast<Index>(plan_->arguments.size());
  result.count = static_cast<std::uint32_t>(arguments.size());
  plan_->arguments.insert(plan_->arguments.end(), arguments.begin(), arguments.end());
  plan_->expressions.push_back(result);
  return static_cast<Index>(plan_->expressions.size() - 1);
}

// The body of an EXISTS: operators that nothing runs into; they end in kFound.
Index Planner::exists_body(const Pattern& pattern, const VariableSet& visible,
                           const Context& context) {
  const Index skip = add_op(OpKind::kJump);
  Context inside = context;
  // The solution that is tested is substituted into the pattern; nothing else of what is bound here
  // may be seen in it.
  inside.constants.add(visible);
  VariableSet surely = visible;
  surely.keep_only(context.bound);
  inside.fixed.add(surely);
  inside.maybe = visible;
  inside.maybe.remove(inside.fixed);
  std::unordered_map<Variable, Slot> renamed;
  hide(pattern, context, inside, renamed);
  const Index body = next_op();
  std::vector<Item> items;
  gather_safely(pattern, inside, items);
  order_and_emit(items, inside);
  add_op(OpKind::kFound);
  plan_->ops[skip].next = next_op();
  return body;
}

void Planner::hide(const Pattern& pattern, const Context& outer, Context& inside,
                   std::unordered_map<Variable, Slot>& renamed) {
  if (outer.renamed) renamed = *outer.renamed;
  for (const Variable variable : algebra::mentioned(pattern)) {
    if (inside.constants.has(variable) || inside.maybe.has(variable)) continue;
    if (!outer.bound.has(variable) && !outer.maybe.has(variable)) continue;
    renamed[variable] = fresh_slot(variable < query_.names.size() ? query_.names[variable] : "");
    inside.bound.remove(variable);
  }
  inside.renamed = &renamed;
}

}  // namespace sinew::rdf::sparql::plan
