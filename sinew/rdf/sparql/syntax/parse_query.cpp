// SELECT, ASK, CONSTRUCT and DESCRIBE (grammar rules 1 to 17), and sub-selects.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sinew/rdf/sparql/syntax/parser_class.h"

namespace sinew::rdf::sparql::syntax {

Query Parser::query() {
  Query query;
  query.source = source_;
  prologue();
  const ScopeStack::Mark outer = scope_.open();
  if (at_word("SELECT")) {
    query.form = QueryForm::kSelect;
    select_clause(query.select);
    dataset_clauses(query.dataset, "FROM");
    where_clause(query.select);
    solution_modifiers(query.select);
  } else if (accept_word("ASK")) {
    query.form = QueryForm::kAsk;
    dataset_clauses(query.dataset, "FROM");
    where_clause(query.select);
    solution_modifiers(query.select);
  } else if (accept_word("CONSTRUCT")) {
    query.form = QueryForm::kConstruct;
    construct_form(query);
  } else if (accept_word("DESCRIBE")) {
    query.form = QueryForm::kDescribe;
    describe_form(query);
  } else {
    fail(fmt::format("{} stands where the query should begin", describe_token()),
         "write SELECT, ASK, CONSTRUCT or DESCRIBE");
  }
  if (accept_word("VALUES")) {
    query.select.values = std::make_shared<const Values>(inline_data());
  }
  finish_select(query.select);
  if (query.form == QueryForm::kDescribe && query.describe_all) {
    for (const Projection& projection : query.select.projections) {
      query.describe.push_back(Node::variable(projection.variable));
    }
  }
  scope_.close(outer);
  if (token_.kind != TokenKind::kEnd) {
    fail(fmt::format("{} stands behind the query", describe_token()), "end the text here");
  }
  query.names = std::move(names_);
  query.base = base_;
  return query;
}

void Parser::select_clause(Select& select) {
  advance();
  select.distinct = accept_word("DISTINCT");
  if (!select.distinct) select.reduced = accept_word("REDUCED");
  if (accept("*")) {
    select.all = true;
    return;
  }
  const bool allowed = std::exchange(aggregates_allowed_, true);
  const bool seen = std::exchange(aggregate_seen_, false);
  const bool inside = std::exchange(inside_aggregate_, false);
  while (at_variable() || at("(")) {
    Projection projection;
    projection.offset = token_.offset;
    if (accept("(")) {
      projection.expression = expression();
      expect_word("AS", "name the value");
      projection.variable = variable();
      expect(")", "close the projection");
    } else {
      projection.variable = variable();
    }
    select.projections.push_back(std::move(projection));
  }
  if (select.projections.empty()) {
    fail(fmt::format("{} stands where the selected variables should", describe_token()),
         "write *, ?name or (expression AS ?name)");
  }
  select.grouped = aggregate_seen_;
  aggregates_allowed_ = allowed;
  aggregate_seen_ = seen;
  inside_aggregate_ = inside;
}

void Parser::where_clause(Select& select) {
  accept_word("WHERE");
  select.where = group();
}

std::shared_ptr<const Select> Parser::sub_select() {
  auto select = std::make_shared<Select>();
  const ScopeStack::Mark outer = scope_.open();
  select_clause(*select);
  where_clause(*select);
  solution_modifiers(*select);
  if (accept_word("VALUES")) select->values = std::make_shared<const Values>(inline_data());
  finish_select(*select);
  // Only what is projected is seen outside.
  scope_.discard(outer);
  for (const Projection& projection : select->projections) scope_.see(projection.variable);
  return select;
}

void Parser::dataset_clauses(DatasetClause& into, std::string_view keyword) {
  while (accept_word(keyword)) {
    into.given = true;
    auto& list = accept_word("NAMED") ? into.named : into.defaults;
    const graph::Id id = iri();
    if (std::find(list.begin(), list.end(), id) == list.end()) list.push_back(id);
  }
}

void Parser::construct_form(Query& query) {
  std::vector<Triple> triples;
  const bool short_form = !at("{");
  if (!short_form) {
    triple_mode_ = TripleMode::kTemplate;
    advance();
    while (!at("}")) {
      triples_same_subject(triples);
      if (!accept(".")) break;
    }
    expect("}", "close the template");
    labels_.clear();
    query.construct = template_of(triples, {});
    triple_mode_ = TripleMode::kPattern;
    dataset_clauses(query.dataset, "FROM");
    where_clause(query.select);
  } else {
    // CONSTRUCT WHERE { triples }: template and pattern are the same.
    dataset_clauses(query.dataset, "FROM");
    expect_word("WHERE", "follow");
    expect("{", "open the pattern");
    while (!at("}")) {
      triples_same_subject(triples);
      if (!accept(".")) break;
    }
    expect("}", "close the pattern");
    for (const Triple& triple : triples) {
      if (triple.path) {
        fail_at(triple.offset, "a path stands in CONSTRUCT WHERE",
                "write the template and the pattern separately");
      }
    }
    query.construct = template_of(triples, {});
    // What was a blank node in the pattern is a new one for each solution (section 16.2.4
    // and 16.2.1).
    for (TemplateQuad& quad : query.construct.quads) {
      for (Node* node : {&quad.subject, &quad.object}) {
        if (!node->is_variable() || !names_.hidden[node->value]) continue;
        query.construct.blank_count = std::max(query.construct.blank_count, node->value + 1);
        *node = Node::blank(node->value);
      }
    }
    auto where = std::make_shared<Group>();
    Element element;
    element.triples = std::move(triples);
    where->elements.push_back(std::move(element));
    query.select.where = where;
  }
  solution_modifiers(query.select);
}

void Parser::describe_form(Query& query) {
  if (accept("*")) {
    query.describe_all = true;
    query.select.all = true;
  } else {
    do {
      query.describe.push_back(variable_or_iri());
    } while (at_variable() || at_iri());
  }
  dataset_clauses(query.dataset, "FROM");
  if (at_word("WHERE") || at("{")) {
    where_clause(query.select);
  } else {
    query.select.where = std::make_shared<const Group>();
  }
  solution_modifiers(query.select);
}

Template Parser::template_of(const std::vector<Triple>& triples, Node graph) {
  Template result;
  for (const Triple& triple : triples) {
    result.quads.push_back({triple.subject, triple.predicate, triple.object, graph});
  }
  result.blank_count = std::exchange(template_blanks_, 0);
  return result;
}

}  // namespace sinew::rdf::sparql::syntax
