#include "sinew/rdf/sparql/algebra/translate.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "sinew/rdf/sparql/algebra/variables.h"

namespace sinew::rdf::sparql::algebra {
namespace {

using syntax::Element;

// The meaning of the names within one SELECT.
using Scope = std::unordered_map<syntax::Variable, Variable>;

class Translator {
 public:
  Translator(const syntax::Names& names, std::shared_ptr<const syntax::Source> source)
      : names_(names), source_(std::move(source)) {}

  Variable declare_parameter(std::string_view name) {
    const auto result = static_cast<Variable>(result_names.size());
    result_names.emplace_back(name);
    for (syntax::Variable i = 0; i < names_.texts.size(); ++i) {
      if (names_.texts[i] == name) parameters_[i] = result;
    }
    return result;
  }

  Variable variable(Scope& scope, syntax::Variable variable) {
    if (const auto found = parameters_.find(variable); found != parameters_.end()) {
      return found->second;
    }
    const auto [found, is_new] = scope.try_emplace(variable, result_names.size());
    if (is_new) result_names.push_back(names_.texts[variable]);
    return found->second;
  }

  Pattern group(Scope& scope, const syntax::Group& group);
  Select select(Scope& scope, const syntax::Select& select);

  std::vector<std::string> result_names;

 private:
  Node node(Scope& scope, syntax::Node node) {
    return node.is_variable() ? Node::variable(variable(scope, node.value)) : Node::term(node.id());
  }
  Expression expression(Scope& scope, const syntax::Expression& source);
  void add_conditions(Scope& scope, const syntax::Expression& source,
                      std::vector<Expression>& into);
  Pattern triples(Scope& scope, const Element& element);
  Pattern values(Scope& scope, const syntax::Values& values);
  Pattern united(Scope& scope, const Element& element);
  Pattern left_join(Scope& scope, Pattern left, const syntax::Group& right);
  Pattern sub_select(Scope& scope, const syntax::Select& select);
  void add(Scope& scope, const Element& element, Pattern& result, std::size_t& length);

  const syntax::Names& names_;
  std::shared_ptr<const syntax::Source> source_;
  std::unordered_map<syntax::Variable, Variable> parameters_;
  // Where aggregates of the SELECT under translation go; null where none may stand.
  std::vector<Aggregate>* aggregates_ = nullptr;
};

Pattern finished(Pattern pattern) {
  find_variables(pattern);
  return pattern;
}

Pattern of_kind(Pattern::Kind kind, std::size_t offset) {
  Pattern pattern;
  pattern.kind = kind;
  pattern.offset = offset;
  return pattern;
}

bool is_unit(const Pattern& pattern) {
  return pattern.kind == Pattern::Kind::kJoin && pattern.parts.empty();
}

// Joins are flat: a join of joins is one join.
Pattern join(Pattern left, Pattern right) {
  if (is_unit(left)) return right;
  if (is_unit(right)) return left;
  if (left.kind != Pattern::Kind::kJoin) {
    Pattern result;
    result.possible = left.possible;
    result.certain = left.certain;
    result.parts.push_back(std::move(left));
    left = std::move(result);
  }
  left.possible.add(right.possible);
  left.certain.add(right.certain);
  if (right.kind == Pattern::Kind::kJoin) {
    for (Pattern& part : right.parts) left.parts.push_back(std::move(part));
  } else {
    left.parts.push_back(std::move(right));
  }
  return left;
}

Expression Translator::expression(Scope& scope, const syntax::Expression& source) {
  Expression result;
  result.op = source.op;
  result.term = source.term;
  result.offset = source.offset;
  if (is_aggregate(source.op)) {
    Aggregate aggregate;
    aggregate.op = source.op;
    aggregate.distinct = source.distinct;
    aggregate.separator = source.separator;
    if (!source.arguments.empty()) aggregate.argument = expression(scope, source.arguments[0]);
    aggregate.result = static_cast<Variable>(result_names.size());
    result_names.push_back(fmt::format(".{}", name_of(source.op)));
    result.op = Operator::kVariable;
    result.variable = aggregate.result;
    aggregates_->push_back(std::move(aggregate));
    return result;
  }
  if (source.op == Operator::kVariable || source.op == Operator::kBound) {
    result.variable = variable(scope, source.variable);
  }
  if (source.op == Operator::kExists || source.op == Operator::kNotExists) {
    std::vector<Aggregate>* const outer = std::exchange(aggregates_, nullptr);
    result.pattern = std::make_shared<const Pattern>(group(scope, *source.pattern));
    aggregates_ = outer;
  }
  for (const syntax::Expression& argument : source.arguments) {
    result.arguments.push_back(expression(scope, argument));
  }
  return result;
}

// FILTER(a && b) keeps what FILTER(a) FILTER(b) keeps, and each of the two can run as soon as its
// own variables are bound.
void Translator::add_conditions(Scope& scope, const syntax::Expression& source,
                                std::vector<Expression>& into) {
  if (source.op != Operator::kAnd) {
    into.push_back(expression(scope, source));
    return;
  }
  for (const syntax::Expression& part : source.arguments) add_conditions(scope, part, into);
}

Pattern Translator::triples(Scope& scope, const Element& element) {
  Pattern pattern = of_kind(Pattern::Kind::kTriples, element.offset);
  for (const syntax::Triple& triple : element.triples) {
    pattern.triples.push_back({node(scope, triple.subject),
                               triple.path ? Node{} : node(scope, triple.predicate),
                               node(scope, triple.object), triple.path});
  }
  return finished(std::move(pattern));
}

Pattern Translator::values(Scope& scope, const syntax::Values& values) {
  Pattern pattern = of_kind(Pattern::Kind::kValues, 0);
  for (const syntax::Variable name : values.variables) {
    pattern.value_variables.push_back(variable(scope, name));
  }
  pattern.value_rows = values.rows;
  return finished(std::move(pattern));
}

Pattern Translator::united(Scope& scope, const Element& element) {
  Pattern pattern = of_kind(Pattern::Kind::kUnion, element.offset);
  for (const auto& branch : element.groups) pattern.parts.push_back(group(scope, *branch));
  return finished(std::move(pattern));
}

// A filter that stands directly in the optional group is the condition of the left join, and sees
// both sides; one in a group of its own inside does not.
Pattern Translator::left_join(Scope& scope, Pattern left, const syntax::Group& right) {
  Pattern pattern = of_kind(Pattern::Kind::kLeftJoin, 0);
  Pattern optional = group(scope, right);
  pattern.parts.push_back(std::move(left));
  const bool has_filter =
      std::any_of(right.elements.begin(), right.elements.end(),
                  [](const auto& e) { return e.kind == Element::Kind::kFilter; });
  if (has_filter) {
    pattern.conditions = std::move(optional.conditions);
    // Not `optional = parts[0]`: that would destroy what it moves from.
    Pattern inner = std::move(optional.parts[0]);
    pattern.parts.push_back(std::move(inner));
  } else {
    pattern.parts.push_back(std::move(optional));
  }
  return finished(std::move(pattern));
}

Pattern Translator::sub_select(Scope& scope, const syntax::Select& source) {
  // Projected variables mean the same inside and outside; all others belong to the inside.
  Scope inner;
  for (const syntax::Projection& projection : source.projections) {
    inner[projection.variable] = variable(scope, projection.variable);
  }
  Pattern pattern = of_kind(Pattern::Kind::kSelect, 0);
  std::vector<Aggregate>* const outer = std::exchange(aggregates_, nullptr);
  pattern.select = std::make_shared<const Select>(select(inner, source));
  aggregates_ = outer;
  return finished(std::move(pattern));
}

void Translator::add(Scope& scope, const Element& element, Pattern& result, std::size_t& length) {
  using Kind = Element::Kind;
  // What nests to the left, and with it the recursion of later stages, grows with each of these.
  const bool nests = element.kind == Kind::kOptional || element.kind == Kind::kMinus ||
                     element.kind == Kind::kBind;
  if (nests && ++length > kMaximumGroupChain) {
    source_->fail(
        element.offset,
        fmt::format("more than {} OPTIONAL, MINUS and BIND in one group", kMaximumGroupChain),
        "split the query, or put some of them into groups of their own");
  }
  switch (element.kind) {
    case Kind::kTriples:
      result = join(std::move(result), triples(scope, element));
      break;
    case Kind::kFilter:
      break;  // belongs to the whole group
    case Kind::kBind: {
      Pattern pattern = of_kind(Pattern::Kind::kExtend, element.offset);
      pattern.variable = variable(scope, element.variable);
      pattern.expression = expression(scope, element.expression);
      pattern.parts.push_back(std::move(result));
      result = finished(std::move(pattern));
      break;
    }
    case Kind::kValues:
      result = join(std::move(result), values(scope, *element.values));
      break;
    case Kind::kGroup:
      result = join(std::move(result), group(scope, *element.groups[0]));
      break;
    case Kind::kUnion:
      result = join(std::move(result), united(scope, element));
      break;
    case Kind::kOptional:
      result = left_join(scope, std::move(result), *element.groups[0]);
      break;
    case Kind::kMinus: {
      Pattern pattern = of_kind(Pattern::Kind::kMinus, element.offset);
      pattern.parts.push_back(std::move(result));
      pattern.parts.push_back(group(scope, *element.groups[0]));
      result = finished(std::move(pattern));
      break;
    }
    case Kind::kGraph: {
      Pattern pattern = of_kind(Pattern::Kind::kGraph, element.offset);
      pattern.name = node(scope, element.name);
      pattern.parts.push_back(group(scope, *element.groups[0]));
      result = join(std::move(result), finished(std::move(pattern)));
      break;
    }
    case Kind::kService: {
      Pattern pattern = of_kind(Pattern::Kind::kService, element.offset);
      pattern.silent = element.silent;
      result = join(std::move(result), finished(std::move(pattern)));
      break;
    }
    case Kind::kSelect:
      result = join(std::move(result), sub_select(scope, *element.select));
      break;
  }
}

Pattern Translator::group(Scope& scope, const syntax::Group& group) {
  Pattern result;
  std::size_t length = 0;
  for (const Element& element : group.elements) add(scope, element, result, length);
  Pattern filter;
  filter.kind = Pattern::Kind::kFilter;
  for (const Element& element : group.elements) {
    if (element.kind != Element::Kind::kFilter) continue;
    add_conditions(scope, element.expression, filter.conditions);
  }
  if (filter.conditions.empty()) return result;
  filter.parts.push_back(std::move(result));
  return finished(std::move(filter));
}

Select Translator::select(Scope& scope, const syntax::Select& source) {
  Select result;
  result.where = group(scope, *source.where);
  result.grouped = source.grouped;
  result.distinct = source.distinct;
  result.reduced = source.reduced;
  result.limit = source.limit;
  result.offset = source.offset;
  for (const syntax::GroupKey& key : source.group_by) {
    Assignment assignment;
    assignment.expression = expression(scope, key.expression);
    if (key.variable) {
      assignment.variable = variable(scope, *key.variable);
    } else {
      assignment.variable = static_cast<Variable>(result_names.size());
      result_names.emplace_back(".key");
    }
    result.keys.push_back(std::move(assignment));
  }
  aggregates_ = &result.aggregates;
  for (const syntax::Expression& condition : source.having) {
    add_conditions(scope, condition, result.having);
  }
  for (const syntax::Projection& projection : source.projections) {
    const Variable column = variable(scope, projection.variable);
    if (projection.expression) {
      result.assignments.push_back({column, expression(scope, *projection.expression)});
    }
    result.columns.push_back(column);
  }
  for (const syntax::Order& order : source.order_by) {
    result.order.push_back({expression(scope, order.expression), order.descending});
  }
  aggregates_ = nullptr;
  if (source.values) {
    Pattern last = values(scope, *source.values);
    if (source.grouped) {
      result.values = std::move(last);
    } else {
      result.where = join(std::move(result.where), std::move(last));
    }
  }
  return result;
}

// Variables of a template become the numbers that the algebra gave them.
void rename(syntax::Template& construct, Translator& translator, Scope& scope) {
  for (syntax::TemplateQuad& quad : construct.quads) {
    for (syntax::Node* node : {&quad.subject, &quad.predicate, &quad.object, &quad.graph}) {
      if (node->is_variable()) node->value = translator.variable(scope, node->value);
    }
  }
}

}  // namespace

Query translate(const syntax::Query& source, std::span<const std::string_view> parameters) {
  Translator translator(source.names, source.source);
  Query result;
  result.source = source.source;
  result.form = source.form;
  result.dataset = source.dataset;
  result.base = source.base;
  for (const std::string_view name : parameters) {
    result.parameters.push_back(translator.declare_parameter(name));
  }
  Scope scope;
  result.select = translator.select(scope, source.select);
  result.construct = source.construct;
  rename(result.construct, translator, scope);
  result.describe = source.describe;
  for (syntax::Node& node : result.describe) {
    if (node.is_variable()) node.value = translator.variable(scope, node.value);
  }
  // CONSTRUCT and DESCRIBE read the variables that they use from rows, like a SELECT.
  VariableSet used;
  for (const syntax::TemplateQuad& quad : result.construct.quads) {
    for (const syntax::Node node : {quad.subject, quad.predicate, quad.object}) {
      if (node.is_variable()) used.add(node.value);
    }
  }
  if (source.form == syntax::QueryForm::kDescribe) {
    for (const syntax::Node node : result.describe) {
      if (node.is_variable()) used.add(node.value);
    }
  }
  if (source.form == syntax::QueryForm::kConstruct || source.form == syntax::QueryForm::kDescribe) {
    result.select.columns.assign(used.begin(), used.end());
  }
  result.names = std::move(translator.result_names);
  return result;
}

Query translate_where(const syntax::Operation& operation,
                      std::shared_ptr<const syntax::Source> source,
                      const std::vector<syntax::Variable>& columns,
                      std::span<const std::string_view> parameters) {
  Translator translator(operation.names, source);
  Query result;
  result.source = std::move(source);
  result.base = operation.base;
  for (const std::string_view name : parameters) {
    result.parameters.push_back(translator.declare_parameter(name));
  }
  Scope scope;
  result.select.where = translator.group(scope, *operation.where);
  for (const syntax::Variable column : columns) {
    result.select.columns.push_back(translator.variable(scope, column));
  }
  result.names = std::move(translator.result_names);
  return result;
}

}  // namespace sinew::rdf::sparql::algebra
