// SPARQL 1.1 Update (grammar rules 29 to 52).
#include <fmt/format.h>

#include <utility>

#include "sinew/rdf/sparql/syntax/parser_class.h"

namespace sinew::rdf::sparql::syntax {

Update Parser::update() {
  Update update;
  update.source = source_;
  while (true) {
    prologue();
    if (token_.kind == TokenKind::kEnd) break;
    begin_operation();
    Operation parsed = operation();
    parsed.names = std::move(names_);
    parsed.base = base_;
    update.operations.push_back(std::move(parsed));
    if (!accept(";")) break;
  }
  if (token_.kind != TokenKind::kEnd) {
    fail(fmt::format("{} stands behind an operation", describe_token()),
         "separate operations with ';'");
  }
  return update;
}

// Variables belong to one operation; blank-node labels of patterns and data to the whole request.
void Parser::begin_operation() {
  names_ = {};
  variables_.clear();
  scope_ = {};
  end_of_basic_pattern();
}

Operation Parser::operation() {
  Operation result;
  result.offset = token_.offset;
  if (accept_word("INSERT")) {
    if (accept_word("DATA")) {
      result.kind = Operation::Kind::kInsertData;
      result.inserts = quads(TripleMode::kData);
      return result;
    }
    result.kind = Operation::Kind::kModify;
    result.inserts = quads(TripleMode::kTemplate);
    modify(result, false);
    return result;
  }
  if (at_word("DELETE")) {
    const std::size_t offset = token_.offset;
    advance();
    if (accept_word("DATA")) {
      result.kind = Operation::Kind::kDeleteData;
      result.deletes = quads(TripleMode::kData);
      if (result.deletes.blank_count > 0) {
        fail_at(offset, "DELETE DATA names a blank node", "use DELETE with WHERE and a variable");
      }
      return result;
    }
    result.kind = Operation::Kind::kModify;
    if (accept_word("WHERE")) {
      delete_where(result);
      return result;
    }
    delete_template(result.deletes);
    modify(result, true);
    return result;
  }
  if (accept_word("WITH")) {
    result.kind = Operation::Kind::kModify;
    result.with = iri();
    if (accept_word("DELETE")) {
      delete_template(result.deletes);
    } else if (!at_word("INSERT")) {
      fail(fmt::format("{} stands behind WITH", describe_token()), "write DELETE or INSERT");
    }
    modify(result, true);
    return result;
  }
  graph_management(result);
  return result;
}

// The template of a DELETE.
void Parser::delete_template(Template& into) {
  const std::size_t offset = token_.offset;
  into = quads(TripleMode::kTemplate);
  if (into.blank_count > 0) {
    fail_at(offset, "the template of DELETE names a blank node",
            "use a variable, and bind it in WHERE");
  }
}

// [INSERT {}] USING* WHERE {}
void Parser::modify(Operation& operation, bool may_insert) {
  if (may_insert && accept_word("INSERT")) {
    operation.inserts = quads(TripleMode::kTemplate);
  }
  dataset_clauses(operation.using_clause, "USING");
  expect_word("WHERE", "follow");
  const ScopeStack::Mark outer = scope_.open();
  operation.where = group();
  scope_.close(outer);
}

// DELETE WHERE { quads }: pattern and template are the same.
void Parser::delete_where(Operation& operation) {
  const std::size_t offset = token_.offset;
  operation.deletes = quads(TripleMode::kTemplate);
  if (operation.deletes.blank_count > 0) {
    fail_at(offset, "DELETE WHERE names a blank node", "use a variable");
  }
  operation.where = group_of(operation.deletes);
}

std::shared_ptr<const Group> Parser::group_of(const Template& pattern) {
  auto result = std::make_shared<Group>();
  for (const TemplateQuad& quad : pattern.quads) {
    Element triples;
    triples.triples.push_back({quad.subject, quad.predicate, nullptr, quad.object, 0});
    if (quad.graph == Node{}) {
      result->elements.push_back(std::move(triples));
      continue;
    }
    auto inner = std::make_shared<Group>();
    inner->elements.push_back(std::move(triples));
    Element graph;
    graph.kind = Element::Kind::kGraph;
    graph.name = quad.graph;
    graph.groups.push_back(std::move(inner));
    result->elements.push_back(std::move(graph));
  }
  return result;
}

// { triples GRAPH name { triples } ... }
Template Parser::quads(TripleMode mode) {
  triple_mode_ = mode;
  if (mode == TripleMode::kTemplate) labels_.swap(template_labels_);
  template_blanks_ = 0;
  Template result;
  expect("{", "open the triples");
  std::vector<Triple> triples;
  quads_block({}, triples, result);
  while (accept_word("GRAPH")) {
    const Node graph = mode == TripleMode::kData ? Node::term(iri()) : variable_or_iri();
    expect("{", "open the graph");
    quads_block(graph, triples, result);
    expect("}", "close the graph");
    accept(".");
    quads_block({}, triples, result);
  }
  expect("}", "close the triples");
  result.blank_count = template_blanks_;
  if (mode == TripleMode::kTemplate) {
    labels_.swap(template_labels_);
    template_labels_.clear();
  }
  triple_mode_ = TripleMode::kPattern;
  return result;
}

void Parser::quads_block(Node graph, std::vector<Triple>& triples, Template& into) {
  while (at_graph_node()) {
    triples.clear();
    triples_same_subject(triples);
    for (const Triple& triple : triples) {
      into.quads.push_back({triple.subject, triple.predicate, triple.object, graph});
    }
    if (!accept(".")) return;
  }
}

graph::Id Parser::graph_reference() {
  expect_word("GRAPH", "name the graph");
  return iri();
}

// The null Id for the unnamed graph.
graph::Id Parser::graph_or_default() {
  if (accept_word("DEFAULT")) return {};
  accept_word("GRAPH");
  return iri();
}

void Parser::graph_management(Operation& operation) {
  using Kind = Operation::Kind;
  using Target = Operation::Target;
  struct Word {
    std::string_view text;
    Kind kind;
  };
  static constexpr Word kWords[] = {{"LOAD", Kind::kLoad}, {"CLEAR", Kind::kClear},
                                    {"DROP", Kind::kDrop}, {"CREATE", Kind::kCreate},
                                    {"ADD", Kind::kAdd},   {"MOVE", Kind::kMove},
                                    {"COPY", Kind::kCopy}};
  const Word* word = nullptr;
  for (const Word& candidate : kWords) {
    if (at_word(candidate.text)) word = &candidate;
  }
  if (word == nullptr) {
    fail(fmt::format("{} stands where an operation should begin", describe_token()),
         "write INSERT, DELETE, WITH, LOAD, CLEAR, DROP, CREATE, ADD, MOVE or COPY");
  }
  advance();
  operation.kind = word->kind;
  operation.silent = accept_word("SILENT");
  operation.target = Target::kGraph;
  switch (word->kind) {
    case Kind::kLoad:
      operation.source = iri();
      if (accept_word("INTO")) {
        operation.graph = graph_reference();
      } else {
        operation.target = Target::kDefault;
      }
      break;
    case Kind::kCreate:
      operation.graph = graph_reference();
      break;
    case Kind::kClear:
    case Kind::kDrop:
      if (accept_word("DEFAULT")) {
        operation.target = Target::kDefault;
      } else if (accept_word("NAMED")) {
        operation.target = Target::kNamed;
      } else if (accept_word("ALL")) {
        operation.target = Target::kAll;
      } else {
        operation.graph = graph_reference();
      }
      break;
    default:
      operation.source = graph_or_default();
      expect_word("TO", "name where to");
      operation.graph = graph_or_default();
      if (!operation.graph) operation.target = Target::kDefault;
      break;
  }
}

}  // namespace sinew::rdf::sparql::syntax
