// GROUP BY, HAVING, ORDER BY, LIMIT and OFFSET (grammar rules 18 to 27), and the checks that need a
// whole SELECT.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "sinew/rdf/sparql/syntax/parser_class.h"

namespace sinew::rdf::sparql::syntax {

bool Parser::is_parameter(Variable variable) const {
  const auto& parameters = options_.parameters;
  return std::find(parameters.begin(), parameters.end(), names_.texts[variable]) !=
         parameters.end();
}

void Parser::solution_modifiers(Select& select) {
  const bool allowed = aggregates_allowed_;
  const bool seen = std::exchange(aggregate_seen_, false);
  const bool inside = std::exchange(inside_aggregate_, false);
  aggregates_allowed_ = false;
  if (at_word("GROUP")) group_clause(select);
  aggregates_allowed_ = true;
  if (accept_word("HAVING")) {
    if (!at_constraint()) {
      fail(fmt::format("{} stands behind HAVING", describe_token()), "write HAVING (condition)");
    }
    while (at_constraint()) select.having.push_back(constraint());
  }
  if (at_word("ORDER")) order_clause(select);
  select.grouped |= aggregate_seen_ || !select.having.empty();
  aggregates_allowed_ = allowed;
  aggregate_seen_ = seen;
  inside_aggregate_ = inside;
  limit_and_offset(select);
}

void Parser::group_clause(Select& select) {
  advance();
  expect_word("BY", "follow GROUP");
  select.grouped = true;
  while (true) {
    GroupKey key;
    if (at_variable()) {
      key.expression = make(Operator::kVariable, token_.offset);
      key.expression.variable = variable();
      key.variable = key.expression.variable;
    } else if (accept("(")) {
      key.expression = expression();
      if (accept_word("AS")) {
        const std::size_t offset = token_.offset;
        key.variable = variable();
        if (scope_.visible(*key.variable)) {
          fail_at(offset,
                  fmt::format("?{} is used in the pattern already", names_.texts[*key.variable]),
                  "choose a new name for the value");
        }
        scope_.see(*key.variable);
      } else if (key.expression.op == Operator::kVariable) {
        key.variable = key.expression.variable;
      }
      expect(")", "close the key");
    } else if (at_constraint()) {
      key.expression = constraint();
    } else {
      break;
    }
    select.group_by.push_back(std::move(key));
  }
  if (select.group_by.empty()) {
    fail(fmt::format("{} stands behind GROUP BY", describe_token()),
         "write ?name, a function call or (expression AS ?name)");
  }
}

void Parser::order_clause(Select& select) {
  advance();
  expect_word("BY", "follow ORDER");
  while (true) {
    Order order;
    if (at_word("ASC") || at_word("DESC")) {
      order.descending = at_word("DESC");
      advance();
      order.expression = bracketted_expression();
    } else if (at_variable()) {
      order.expression = make(Operator::kVariable, token_.offset);
      order.expression.variable = variable();
    } else if (at_constraint()) {
      order.expression = constraint();
    } else {
      break;
    }
    select.order_by.push_back(std::move(order));
  }
  if (select.order_by.empty()) {
    fail(fmt::format("{} stands behind ORDER BY", describe_token()),
         "write ?name, ASC(expression), DESC(expression) or a function call");
  }
}

void Parser::limit_and_offset(Select& select) {
  bool has_limit = false;
  bool has_offset = false;
  while ((at_word("LIMIT") && !has_limit) || (at_word("OFFSET") && !has_offset)) {
    const bool is_limit = at_word("LIMIT");
    (is_limit ? has_limit : has_offset) = true;
    advance();
    std::uint64_t value = 0;
    const char* const end = token_.text.data() + token_.text.size();
    const bool is_integer = token_.kind == TokenKind::kInteger &&
                            std::from_chars(token_.text.data(), end, value).ec == std::errc();
    if (!is_integer) {
      fail(fmt::format("{} stands as {}", describe_token(), is_limit ? "LIMIT" : "OFFSET"),
           "write a whole number below 2^64");
    }
    advance();
    if (is_limit) {
      select.limit = value;
    } else {
      select.offset = value;
    }
  }
}

namespace {

// Calls visit(variable, offset) for each variable that stands outside every aggregate and that is
// not part of a subexpression equal to a group key.
template <typename Visit>
void variables_outside_aggregates(const Expression& expression, const Visit& visit) {
  if (is_aggregate(expression.op)) return;
  if (expression.op == Operator::kVariable || expression.op == Operator::kBound) {
    visit(expression.variable, expression.offset);
  }
  for (const Expression& argument : expression.arguments) {
    variables_outside_aggregates(argument, visit);
  }
}

}  // namespace

// SELECT expressions see the pattern, the group keys and what stands to their left.
void Parser::check_projection(const Select& select) {
  std::vector<Variable> known;
  for (const GroupKey& key : select.group_by) {
    if (key.variable) known.push_back(*key.variable);
  }
  const auto is_known = [&](Variable variable) {
    return std::find(known.begin(), known.end(), variable) != known.end() || is_parameter(variable);
  };
  const auto check = [&](Variable variable, std::size_t offset) {
    if (is_known(variable)) return;
    fail_at(
        offset,
        fmt::format("?{} is neither a group key nor inside an aggregate", names_.texts[variable]),
        fmt::format("add it to GROUP BY, or write for example SAMPLE(?{})",
                    names_.texts[variable]));
  };
  std::vector<bool> named(names_.texts.size(), false);
  for (const Projection& projection : select.projections) {
    const std::string& name = names_.texts[projection.variable];
    if (projection.expression) {
      if (scope_.visible(projection.variable) || named[projection.variable]) {
        fail_at(projection.offset, fmt::format("?{} has a value already", name),
                "choose a new name for the value");
      }
      if (select.grouped) variables_outside_aggregates(*projection.expression, check);
      known.push_back(projection.variable);
    } else if (select.grouped) {
      check(projection.variable, projection.offset);
    }
    named[projection.variable] = true;
  }
}

void Parser::finish_select(Select& select) {
  if (!select.all) {
    check_projection(select);
    return;
  }
  if (select.grouped) {
    fail("SELECT * stands with GROUP BY or an aggregate", "name the variables to select");
  }
  std::vector<bool> listed(names_.texts.size(), false);
  scope_.for_each([&](Variable variable) {
    if (names_.hidden[variable] || listed[variable]) return;
    listed[variable] = true;
    select.projections.push_back({variable, std::nullopt, 0});
  });
}

}  // namespace sinew::rdf::sparql::syntax
