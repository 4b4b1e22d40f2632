#include "sinew/rdf/sparql/algebra/variables.h"

namespace sinew::rdf::sparql::algebra {
namespace {

void collect(const Expression& expression, VariableSet& into) {
  switch (expression.op) {
    case Operator::kVariable:
    case Operator::kBound:
      into.add(expression.variable);
      break;
    case Operator::kExists:
    case Operator::kNotExists:
      into.add(expression.pattern->possible);
      // The pattern's filters may mention variables of the solution around that it does not bind.
      into.add(mentioned(*expression.pattern));
      break;
    default:
      break;
  }
  for (const Expression& argument : expression.arguments) collect(argument, into);
}

void find_in_triples(Pattern& pattern) {
  for (const Triple& triple : pattern.triples) {
    for (const Node node : {triple.subject, triple.predicate, triple.object}) {
      if (node.is_variable) pattern.possible.add(node.value);
    }
  }
  pattern.certain = pattern.possible;
}

void find_in_values(Pattern& pattern) {
  for (std::size_t i = 0; i < pattern.value_variables.size(); ++i) {
    pattern.possible.add(pattern.value_variables[i]);
    bool everywhere = true;
    for (const auto& row : pattern.value_rows) everywhere &= static_cast<bool>(row[i]);
    if (everywhere) pattern.certain.add(pattern.value_variables[i]);
  }
}

void find_in_select(Pattern& pattern) {
  const Select& select = *pattern.select;
  VariableSet certain;
  if (select.grouped) {
    // A key's expression may fail, and then leaves its variable unbound.
    for (const Assignment& key : select.keys) {
      if (key.expression.op == Operator::kVariable &&
          select.where.certain.has(key.expression.variable)) {
        certain.add(key.variable);
      }
    }
  } else {
    certain = select.where.certain;
  }
  if (select.values) certain.add(select.values->certain);
  for (const Variable column : select.columns) {
    pattern.possible.add(column);
    if (certain.has(column)) pattern.certain.add(column);
  }
}

void find_in_union(Pattern& pattern) {
  bool first = true;
  for (const Pattern& part : pattern.parts) {
    pattern.possible.add(part.possible);
    if (first) {
      pattern.certain = part.certain;
    } else {
      pattern.certain.keep_only(part.certain);
    }
    first = false;
  }
}

}  // namespace

VariableSet variables_of(const Expression& expression) {
  VariableSet result;
  collect(expression, result);
  return result;
}

VariableSet mentioned(const Pattern& pattern) {
  VariableSet result = pattern.possible;
  for (const Expression& condition : pattern.conditions) result.add(variables_of(condition));
  if (pattern.kind == Pattern::Kind::kExtend) result.add(variables_of(pattern.expression));
  for (const Pattern& part : pattern.parts) result.add(mentioned(part));
  return result;
}

void find_variables(Pattern& pattern) {
  using Kind = Pattern::Kind;
  pattern.possible = {};
  pattern.certain = {};
  switch (pattern.kind) {
    case Kind::kTriples:
      find_in_triples(pattern);
      break;
    case Kind::kJoin:
      for (const Pattern& part : pattern.parts) {
        pattern.possible.add(part.possible);
        pattern.certain.add(part.certain);
      }
      break;
    case Kind::kLeftJoin:
      pattern.possible = pattern.parts[0].possible;
      pattern.possible.add(pattern.parts[1].possible);
      pattern.certain = pattern.parts[0].certain;
      break;
    case Kind::kUnion:
      find_in_union(pattern);
      break;
    case Kind::kMinus:
    case Kind::kFilter:
      pattern.possible = pattern.parts[0].possible;
      pattern.certain = pattern.parts[0].certain;
      break;
    case Kind::kExtend:
      pattern.possible = pattern.parts[0].possible;
      pattern.certain = pattern.parts[0].certain;
      pattern.possible.add(pattern.variable);
      if (pattern.expression.op == Operator::kConstant) pattern.certain.add(pattern.variable);
      break;
    case Kind::kGraph:
      pattern.possible = pattern.parts[0].possible;
      pattern.certain = pattern.parts[0].certain;
      if (pattern.name.is_variable) {
        pattern.possible.add(pattern.name.value);
        pattern.certain.add(pattern.name.value);
      }
      break;
    case Kind::kValues:
      find_in_values(pattern);
      break;
    case Kind::kSelect:
      find_in_select(pattern);
      break;
    case Kind::kService:
      break;
  }
}

}  // namespace sinew::rdf::sparql::algebra
