// Expressions, from the loosest operator to the tightest (grammar rules 110 to 119).
#include <fmt/format.h>

#include <algorithm>

#include "sinew/rdf/sparql/syntax/parser_class.h"

namespace sinew::rdf::sparql::syntax {

Expression Parser::make(Operator op, std::size_t offset) const {
  Expression expression;
  expression.op = op;
  expression.offset = offset;
  return expression;
}

Expression Parser::expression() {
  const Level level(*this);
  return or_expression();
}

Expression Parser::or_expression() {
  const std::size_t offset = token_.offset;
  Expression first = and_expression();
  if (!at("||")) return first;
  Expression all = make(Operator::kOr, offset);
  all.arguments.push_back(std::move(first));
  while (accept("||")) all.arguments.push_back(and_expression());
  return all;
}

Expression Parser::and_expression() {
  const std::size_t offset = token_.offset;
  Expression first = relational_expression();
  if (!at("&&")) return first;
  Expression all = make(Operator::kAnd, offset);
  all.arguments.push_back(std::move(first));
  while (accept("&&")) all.arguments.push_back(relational_expression());
  return all;
}

Expression Parser::relational_expression() {
  struct Comparison {
    std::string_view text;
    Operator op;
  };
  static constexpr Comparison kComparisons[] = {
      {"=", Operator::kEqual},   {"!=", Operator::kNotEqual},    {"<", Operator::kLess},
      {">", Operator::kGreater}, {"<=", Operator::kLessOrEqual}, {">=", Operator::kGreaterOrEqual}};
  const std::size_t offset = token_.offset;
  Expression left = additive_expression();
  for (const Comparison& comparison : kComparisons) {
    if (!accept(comparison.text)) continue;
    Expression both = make(comparison.op, offset);
    both.arguments.push_back(std::move(left));
    both.arguments.push_back(additive_expression());
    return both;
  }
  const bool negated = accept_word("NOT");
  if (negated && !at_word("IN")) fail("NOT stands without IN", "write NOT IN ( ... )");
  if (!accept_word("IN")) return left;
  Expression in = make(negated ? Operator::kNotIn : Operator::kIn, offset);
  in.arguments.push_back(std::move(left));
  for (Expression& item : expression_list()) in.arguments.push_back(std::move(item));
  return in;
}

// A chain such as a+b-c+d nests to the left; its length is bounded because stages behind recurse.
Expression Parser::chain(Operator op, std::size_t offset, Expression left, Expression right) {
  Expression both = make(op, offset);
  both.arguments.push_back(std::move(left));
  both.arguments.push_back(std::move(right));
  return both;
}

// a + b - c: operators of one precedence, from left to right.
Expression Parser::row_of(const Row& row) {
  const std::size_t offset = token_.offset;
  Expression left = (this->*row.operand)();
  std::size_t length = 0;
  while (at(row.marks[0]) || at(row.marks[1])) {
    if (++length > kMaximumNesting) {
      fail(fmt::format("more than {} {} in a row", kMaximumNesting, row.called),
           fmt::format("name partial {} with BIND", row.called));
    }
    const Operator op = row.operators[at(row.marks[0]) ? 0 : 1];
    advance();
    left = chain(op, offset, std::move(left), (this->*row.operand)());
  }
  return left;
}

Expression Parser::additive_expression() {
  return row_of({{"+", "-"},
                 {Operator::kAdd, Operator::kSubtract},
                 "sums",
                 &Parser::multiplicative_expression});
}

Expression Parser::multiplicative_expression() {
  return row_of({{"*", "/"},
                 {Operator::kMultiply, Operator::kDivide},
                 "products",
                 &Parser::unary_expression});
}

Expression Parser::unary_expression() {
  const std::size_t offset = token_.offset;
  if (accept("!")) {
    const Level level(*this);
    Expression negation = make(Operator::kNot, offset);
    // Rule 118 allows '!' before a primary expression; "!!x" is no such thing.
    negation.arguments.push_back(primary_expression());
    return negation;
  }
  if (!at("+") && !at("-")) return primary_expression();
  const bool minus = at("-");
  const std::string sign = token_.text;
  advance();
  // A number that follows at once belongs to the sign.
  const bool is_number = token_.kind == TokenKind::kInteger || token_.kind == TokenKind::kDecimal ||
                         token_.kind == TokenKind::kDouble;
  if (is_number && token_.offset == previous_end_) {
    Expression number = make(Operator::kConstant, offset);
    number.term = numeric_literal(sign);
    return number;
  }
  Expression signed_expression = make(minus ? Operator::kNegate : Operator::kPlus, offset);
  signed_expression.arguments.push_back(primary_expression());
  return signed_expression;
}

Expression Parser::bracketted_expression() {
  expect("(", "open the expression");
  Expression inner = expression();
  expect(")", "close the expression");
  return inner;
}

Expression Parser::primary_expression() {
  const std::size_t offset = token_.offset;
  if (at("(")) return bracketted_expression();
  if (at_iri()) return iri_or_function();
  if (at_variable()) {
    Expression expression = make(Operator::kVariable, offset);
    expression.variable = variable();
    return expression;
  }
  if (at_literal() && !at("+") && !at("-")) {
    Expression expression = make(Operator::kConstant, offset);
    expression.term = literal();
    return expression;
  }
  return builtin_call();
}

bool Parser::at_constraint() const {
  return at("(") || at_iri() || at_word("EXISTS") || at_word("NOT") ||
         (token_.kind == TokenKind::kWord && find_builtin(token_.text) != nullptr);
}

// FILTER and HAVING take parentheses, a built-in call or a function call.
Expression Parser::constraint() {
  if (at("(")) return bracketted_expression();
  if (!at_iri()) return builtin_call();
  const std::size_t offset = token_.offset;
  Expression call = iri_or_function();
  if (call.op != Operator::kCall) {
    fail_at(offset, "an IRI stands as a condition", "call it as a function: <iri>( ... )");
  }
  return call;
}

}  // namespace sinew::rdf::sparql::syntax
