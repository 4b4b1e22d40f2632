// Group graph patterns: what stands between { and } (grammar rules 53 to 68).
#include <fmt/format.h>

#include "sinew/rdf/sparql/syntax/parser_class.h"

namespace sinew::rdf::sparql::syntax {

std::shared_ptr<const Group> Parser::group() {
  const Level level(*this);
  auto result = std::make_shared<Group>();
  expect("{", "open a group");
  end_of_basic_pattern();
  const ScopeStack::Mark outer = scope_.open();
  if (at_word("SELECT")) {
    Element element;
    element.kind = Element::Kind::kSelect;
    element.offset = token_.offset;
    element.select = sub_select();
    result->elements.push_back(std::move(element));
  } else {
    group_elements(*result);
  }
  scope_.close(outer);
  expect("}", "close the group");
  end_of_basic_pattern();
  return result;
}

void Parser::group_elements(Group& into) {
  if (at_graph_node()) triples_block(into);
  while (!at("}")) {
    if (token_.kind == TokenKind::kEnd) return;  // the caller misses its '}'
    group_element(into);
    accept(".");
    if (at_graph_node()) triples_block(into);
  }
}

void Parser::triples_block(Group& into) {
  Element element;
  element.offset = token_.offset;
  do {
    triples_same_subject(element.triples);
  } while (accept(".") && at_graph_node());
  into.elements.push_back(std::move(element));
}

void Parser::group_element(Group& into) {
  if (at_word("FILTER")) return filter(into);
  // Everything but FILTER ends a basic graph pattern.
  end_of_basic_pattern();
  if (at_word("BIND")) return bind(into);
  if (at("{")) return group_or_union(into);
  if (at_word("GRAPH")) return graph_or_service(into, false);
  if (at_word("SERVICE")) return graph_or_service(into, true);
  Element element;
  element.offset = token_.offset;
  if (accept_word("OPTIONAL")) {
    element.kind = Element::Kind::kOptional;
    element.groups.push_back(group());
  } else if (accept_word("MINUS")) {
    element.kind = Element::Kind::kMinus;
    const ScopeStack::Mark outer = scope_.open();
    element.groups.push_back(group());
    scope_.discard(outer);
  } else if (accept_word("VALUES")) {
    element.kind = Element::Kind::kValues;
    element.values = std::make_shared<const Values>(inline_data());
  } else {
    fail(fmt::format("{} stands in a group", describe_token()),
         "write a triple, a { group }, FILTER, OPTIONAL, MINUS, BIND, VALUES or GRAPH, or close "
         "the '}'");
  }
  into.elements.push_back(std::move(element));
}

void Parser::filter(Group& into) {
  Element element;
  element.kind = Element::Kind::kFilter;
  element.offset = token_.offset;
  advance();
  // A group inside the filter (EXISTS) has basic graph patterns of its own. The one around goes on
  // behind it, so its number comes back; the numbers taken meanwhile are below the next new one.
  const std::size_t around = basic_pattern_;
  element.expression = constraint();
  basic_pattern_ = around;
  into.elements.push_back(std::move(element));
}

void Parser::bind(Group& into) {
  Element element;
  element.kind = Element::Kind::kBind;
  element.offset = token_.offset;
  advance();
  expect("(", "open BIND's parentheses");
  element.expression = expression();
  expect_word("AS", "name the value");
  const std::size_t offset = token_.offset;
  element.variable = variable();
  if (scope_.visible(element.variable)) {
    fail_at(offset,
            fmt::format("BIND gives a value to ?{}, which the group has used before",
                        names_.texts[element.variable]),
            "choose a new name for the value");
  }
  scope_.see(element.variable);
  expect(")", "close BIND");
  into.elements.push_back(std::move(element));
}

void Parser::group_or_union(Group& into) {
  Element element;
  element.kind = Element::Kind::kGroup;
  element.offset = token_.offset;
  element.groups.push_back(group());
  while (accept_word("UNION")) {
    element.kind = Element::Kind::kUnion;
    element.groups.push_back(group());
  }
  into.elements.push_back(std::move(element));
}

void Parser::graph_or_service(Group& into, bool is_service) {
  Element element;
  element.kind = is_service ? Element::Kind::kService : Element::Kind::kGraph;
  element.offset = token_.offset;
  advance();
  if (is_service) element.silent = accept_word("SILENT");
  element.name = variable_or_iri();
  if (element.name.is_variable()) scope_.see(element.name.value);
  element.groups.push_back(group());
  into.elements.push_back(std::move(element));
}

Values Parser::inline_data() {
  Values values = values_block();
  for (const Variable variable : values.variables) scope_.see(variable);
  return values;
}

// Behind VALUES.
Values Parser::values_block() {
  Values values;
  const auto value = [&]() -> graph::Id {
    if (accept_word("UNDEF")) return {};
    if (at_iri()) return iri();
    if (!at_literal()) {
      fail(fmt::format("{} stands among the values", describe_token()),
           "write an IRI, a literal or UNDEF");
    }
    return literal();
  };
  if (at_variable()) {
    values.variables.push_back(variable());
    expect("{", "open the values");
    while (!at("}")) values.rows.push_back({value()});
    expect("}", "close the values");
    return values;
  }
  expect("(", "open the list of variables");
  while (!at(")")) {
    const std::size_t offset = token_.offset;
    const Variable next = variable();
    for (const Variable known : values.variables) {
      if (known == next) fail_at(offset, "a variable stands twice here", "name each variable once");
    }
    values.variables.push_back(next);
  }
  advance();
  expect("{", "open the values");
  while (at("(")) {
    const std::size_t offset = token_.offset;
    advance();
    std::vector<graph::Id> row;
    while (!at(")")) row.push_back(value());
    advance();
    if (row.size() != values.variables.size()) {
      fail_at(offset,
              fmt::format("this row has {} values for {} variables", row.size(),
                          values.variables.size()),
              "give one value for each variable; UNDEF leaves one open");
    }
    values.rows.push_back(std::move(row));
  }
  expect("}", "close the values");
  return values;
}

}  // namespace sinew::rdf::sparql::syntax
