#include <fmt/format.h>

#include <algorithm>

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

namespace {

bool may_match_no_step(const syntax::Path& path) {
  using Kind = syntax::Path::Kind;
  return path.kind == Kind::kZeroOrMore || path.kind == Kind::kZeroOrOne ||
         std::any_of(path.parts.begin(), path.parts.end(), may_match_no_step);
}

// No part of the pattern has a scope of its own: what is bound somewhere in it is seen everywhere
// in it. Nor does it matter whether a variable was bound inside or outside, as it does to a path of
// no steps.
bool is_flat(const Pattern& pattern) {
  using Kind = Pattern::Kind;
  switch (pattern.kind) {
    case Kind::kTriples:
      return std::none_of(pattern.triples.begin(), pattern.triples.end(),
                          [](const algebra::Triple& triple) {
                            return triple.path && may_match_no_step(*triple.path);
                          });
    case Kind::kValues:
      return true;
    case Kind::kJoin:
      return std::all_of(pattern.parts.begin(), pattern.parts.end(), [](const Pattern& part) {
        return part.kind != Kind::kFilter && is_flat(part);
      });
    case Kind::kFilter:
      return is_flat(pattern.parts[0]);
    default:
      return false;
  }
}

}  // namespace

// The body of an EXISTS: operators that nothing runs into; they end in kFound. The solution that is
// tested is substituted into the pattern; nothing else of what is bound around may be seen in it.
Index Planner::exists_body(const Pattern& pattern, const VariableSet& visible,
                           const Context& context) {
  const Index skip = add_op(OpKind::kJump);
  const Index body = next_op();
  Context inside = context;
  inside.constants.add(visible);
  VariableSet surely = visible;
  surely.keep_only(context.bound);
  inside.fixed.add(surely);
  // A variable that the solution may leave open is then a variable like any other.
  VariableSet open = inside.constants;
  open.remove(inside.fixed);
  open.keep_only(algebra::mentioned(pattern));
  if (open.empty() || is_flat(pattern)) {
    inside.maybe = open;
    inside.bound.remove(open);
    exists_variant(pattern, context, inside);
  } else {
    exists_variants(pattern, context, inside, {open.begin(), open.end()});
  }
  plan_->ops[skip].next = next_op();
  return body;
}

// One body for each choice of which of the open variables have a value.
void Planner::exists_variants(const Pattern& pattern, const Context& outer, const Context& inside,
                              const std::vector<Variable>& open) {
  constexpr std::size_t kMostOpen = 4;
  if (open.size() > kMostOpen) {
    query_.source->fail(pattern.offset,
                        fmt::format("a nested EXISTS mentions {} variables that may be unbound, "
                                    "more than {}",
                                    open.size(), kMostOpen),
                        "test them with BOUND first, or write the EXISTS without groups in it");
  }
  const Index head = add_op(OpKind::kUnion);
  std::vector<Index> branches;
  for (std::size_t choice = 0; choice < (std::size_t{1} << open.size()); ++choice) {
    branches.push_back(next_op());
    Context here = inside;
    here.maybe = {};
    for (std::size_t i = 0; i < open.size(); ++i) {
      const bool has_value = (choice >> i) & 1;
      Expression bound;
      bound.op = Operator::kBound;
      bound.slot = slot(open[i], outer);
      plan_->expressions.push_back(bound);
      Index condition = static_cast<Index>(plan_->expressions.size() - 1);
      if (has_value) {
        here.fixed.add(open[i]);
        here.bound.add(open[i]);
      } else {
        here.constants.remove(open[i]);
        here.bound.remove(open[i]);
        Expression unbound;
        unbound.op = Operator::kNot;
        unbound.first = static_cast<Index>(plan_->arguments.size());
        unbound.count = 1;
        plan_->arguments.push_back(condition);
        plan_->expressions.push_back(unbound);
        condition = static_cast<Index>(plan_->expressions.size() - 1);
      }
      plan_->ops[add_op(OpKind::kFilter)].item = condition;
    }
    exists_variant(pattern, outer, here);
  }
  plan_->ops[head].next = kNone;
  plan_->ops[head].body = static_cast<Index>(plan_->branches.size());
  plan_->ops[head].item = static_cast<Index>(branches.size());
  plan_->branches.insert(plan_->branches.end(), branches.begin(), branches.end());
}

void Planner::exists_variant(const Pattern& pattern, const Context& outer, Context inside) {
  std::unordered_map<Variable, Slot> renamed;
  hide(pattern, outer, inside, renamed);
  emit_pattern(pattern, inside);
  add_op(OpKind::kFound);
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
