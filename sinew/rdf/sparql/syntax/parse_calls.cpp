// Calls: built-in functions, functions named by an IRI, aggregates, EXISTS (grammar rules 70 to 72,
// 120 to 128).
#include <fmt/format.h>

#include <utility>

#include "sinew/rdf/sparql/syntax/parser_class.h"

namespace sinew::rdf::sparql::syntax {

std::vector<Expression> Parser::expression_list() {
  std::vector<Expression> list;
  expect("(", "open the list");
  if (accept(")")) return list;
  do {
    list.push_back(expression());
  } while (accept(","));
  expect(")", "close the list");
  return list;
}

Expression Parser::iri_or_function() {
  Expression result = make(Operator::kConstant, token_.offset);
  result.term = iri();
  if (!at("(")) return result;
  const Level level(*this);
  result.op = Operator::kCall;
  advance();
  if (accept(")")) return result;
  result.distinct = accept_word("DISTINCT");
  do {
    result.arguments.push_back(expression());
  } while (accept(","));
  expect(")", "close the call");
  return result;
}

Expression Parser::exists(bool negated) {
  Expression result = make(negated ? Operator::kNotExists : Operator::kExists, token_.offset);
  expect_word("EXISTS", "follow");
  // What the group binds stays inside; aggregates of the query around have no meaning in it.
  const bool allowed = std::exchange(aggregates_allowed_, false);
  const bool inside = std::exchange(inside_aggregate_, false);
  const bool seen = aggregate_seen_;
  const ScopeStack::Mark outer = scope_.open();
  result.pattern = group();
  scope_.discard(outer);
  aggregates_allowed_ = allowed;
  inside_aggregate_ = inside;
  aggregate_seen_ = seen;
  return result;
}

Expression Parser::builtin_call() {
  if (at_word("EXISTS")) return exists(false);
  if (accept_word("NOT")) return exists(true);
  const Builtin* builtin = token_.kind == TokenKind::kWord ? find_builtin(token_.text) : nullptr;
  if (builtin == nullptr) {
    fail(fmt::format("{} stands where an expression should", describe_token()),
         token_.kind == TokenKind::kWord
             ? "there is no function of this name; name other functions by their IRI"
             : "write a variable, a term, a function call or ( ... )");
  }
  const Level level(*this);
  if (is_aggregate(builtin->op)) return aggregate(*builtin);
  Expression call = make(builtin->op, token_.offset);
  advance();
  if (builtin->op == Operator::kBound) {
    expect("(", "open the argument");
    call.variable = variable();
    expect(")", "close the argument");
    return call;
  }
  call.arguments = expression_list();
  const std::size_t count = call.arguments.size();
  if (count < builtin->minimum_arguments ||
      (builtin->maximum_arguments != kAnyNumber && count > builtin->maximum_arguments)) {
    const std::string right =
        builtin->minimum_arguments == builtin->maximum_arguments
            ? fmt::format("{}", builtin->minimum_arguments)
            : fmt::format("{} to {}", builtin->minimum_arguments, builtin->maximum_arguments);
    fail_at(call.offset, fmt::format("{} has {} arguments", builtin->name, count),
            fmt::format("give it {}", right));
  }
  return call;
}

Expression Parser::aggregate(const Builtin& builtin) {
  Expression call = make(builtin.op, token_.offset);
  if (inside_aggregate_) {
    fail(fmt::format("{} stands inside another aggregate", builtin.name),
         "compute the inner one in a sub-select");
  }
  if (!aggregates_allowed_) {
    fail(fmt::format("the aggregate {} cannot stand here", builtin.name),
         "use it in SELECT, HAVING or ORDER BY; for a filter use HAVING or a sub-select");
  }
  aggregate_seen_ = true;
  inside_aggregate_ = true;
  advance();
  expect("(", "open the argument");
  call.distinct = accept_word("DISTINCT");
  // COUNT(*) has no argument.
  if (builtin.op != Operator::kCount || !accept("*")) call.arguments.push_back(expression());
  if (builtin.op == Operator::kGroupConcat && accept(";")) {
    expect_word("SEPARATOR", "follow");
    expect("=", "follow");
    if (token_.kind != TokenKind::kString) {
      fail(fmt::format("{} stands as separator", describe_token()), "write a string");
    }
    call.separator = token_.text;
    advance();
  }
  expect(")", "close the aggregate");
  inside_aggregate_ = false;
  return call;
}

}  // namespace sinew::rdf::sparql::syntax
