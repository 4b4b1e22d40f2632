#include "sinew/rdf/sparql/plan/safety.h"

#include <algorithm>

namespace sinew::rdf::sparql::plan {
namespace {

using algebra::Pattern;
using algebra::VariableSet;
using Kind = Pattern::Kind;

// The variables of `used` that `outer` may bind although `inner` does not surely bind them: they
// would have a value here that they do not have bottom-up. Variables that `inner` never binds are
// no matter: they are compiled as unbound.
bool leaks(const VariableSet& used, const VariableSet& outer, const Pattern& inner) {
  return std::any_of(used.begin(), used.end(), [&](algebra::Variable variable) {
    return outer.has(variable) && inner.possible.has(variable) && !inner.certain.has(variable);
  });
}

bool leaks(const algebra::Expression& expression, const VariableSet& outer, const Pattern& inner) {
  return leaks(algebra::variables_of(expression), outer, inner);
}

bool left_join_is_safe(const Pattern& pattern, const VariableSet& outer) {
  const Pattern& left = pattern.parts[0];
  const Pattern& right = pattern.parts[1];
  if (!safe_inside(left, outer)) return false;
  // What the optional part mentions and an outer solution binds must be bound by the left part.
  VariableSet used = right.possible;
  for (const auto& condition : pattern.conditions) used.add(algebra::variables_of(condition));
  return std::all_of(used.begin(), used.end(), [&](algebra::Variable variable) {
    return !outer.has(variable) || left.certain.has(variable) ||
           !(left.possible.has(variable) || right.possible.has(variable));
  });
}

}  // namespace

bool is_plain(const algebra::Select& select) {
  return !select.grouped && !select.values && select.order.empty() && !select.distinct &&
         !select.limit && select.offset == 0;
}

bool has_exists(const algebra::Expression& expression) {
  return expression.op == Operator::kExists || expression.op == Operator::kNotExists ||
         std::any_of(expression.arguments.begin(), expression.arguments.end(), has_exists);
}

bool needs_a_triple(const Pattern& pattern) {
  switch (pattern.kind) {
    case Kind::kTriples:
      return std::any_of(pattern.triples.begin(), pattern.triples.end(),
                         [](const algebra::Triple& triple) { return !triple.path; });
    case Kind::kJoin:
      return std::any_of(pattern.parts.begin(), pattern.parts.end(), needs_a_triple);
    case Kind::kUnion:
      return std::all_of(pattern.parts.begin(), pattern.parts.end(), needs_a_triple);
    case Kind::kLeftJoin:
    case Kind::kFilter:
    case Kind::kExtend:
    case Kind::kMinus:
      return needs_a_triple(pattern.parts[0]);
    default:
      return false;
  }
}

bool safe_inside(const Pattern& pattern, const VariableSet& outer) {
  if (outer.empty()) return true;
  const auto all_safe = [&] {
    return std::all_of(pattern.parts.begin(), pattern.parts.end(),
                       [&](const Pattern& part) { return safe_inside(part, outer); });
  };
  switch (pattern.kind) {
    case Kind::kTriples:
    case Kind::kValues:
    case Kind::kService:
      return true;
    case Kind::kUnion:
    case Kind::kGraph:
    case Kind::kJoin:
      return all_safe();
    case Kind::kLeftJoin:
      return left_join_is_safe(pattern, outer);
    case Kind::kFilter:
      return all_safe() && std::none_of(pattern.conditions.begin(), pattern.conditions.end(),
                                        [&](const algebra::Expression& condition) {
                                          return leaks(condition, outer, pattern.parts[0]);
                                        });
    case Kind::kExtend:
      return all_safe() && !leaks(pattern.expression, outer, pattern.parts[0]);
    case Kind::kMinus:
      return safe_inside(pattern.parts[0], outer) &&
             !leaks(pattern.parts[1].possible, outer, pattern.parts[0]);
    case Kind::kSelect: {
      const algebra::Select& select = *pattern.select;
      if (!is_plain(select) || !safe_inside(select.where, outer)) return false;
      return std::none_of(select.assignments.begin(), select.assignments.end(),
                          [&](const auto& assignment) {
                            return outer.has(assignment.variable) ||
                                   leaks(assignment.expression, outer, select.where);
                          });
    }
  }
  return false;
}

}  // namespace sinew::rdf::sparql::plan
