// Triples with their abbreviations: [ ], ( ), ; and , - in patterns, templates and data alike.
#include <fmt/format.h>

#include "sinew/graph/standard_iris.h"
#include "sinew/rdf/sparql/syntax/parser_class.h"

namespace sinew::rdf::sparql::syntax {
bool Parser::at_graph_node() const {
  return at_variable() || at_iri() || at_literal() || token_.kind == TokenKind::kBlankLabel ||
         at("[") || at("(");
}

bool Parser::at_verb() const {
  if (at_variable() || at_iri() || at_word("a")) return true;
  return triple_mode_ == TripleMode::kPattern && (at("^") || at("!") || at("("));
}

void Parser::verb(Triple& into) {
  into.offset = token_.offset;
  into.path = nullptr;
  if (at_variable()) {
    if (triple_mode_ == TripleMode::kData) {
      fail("a variable stands in data",
           "write a term; for a pattern use INSERT or DELETE with WHERE");
    }
    into.predicate = Node::variable(variable());
    if (triple_mode_ == TripleMode::kPattern) scope_.see(into.predicate.value);
    return;
  }
  if (triple_mode_ != TripleMode::kPattern) {
    into.predicate = Node::term(accept_word("a") ? terms_.iri(graph::kRdfType) : iri());
    return;
  }
  Path parsed = path();
  if (parsed.kind == Path::Kind::kIri) {
    into.predicate = Node::term(parsed.iri);
  } else {
    into.path = std::make_shared<const Path>(std::move(parsed));
  }
}

void Parser::add_triple(Node subject, const Triple& verb, Node object, std::size_t offset,
                        std::vector<Triple>& out) {
  out.push_back({subject, verb.predicate, verb.path, object, offset});
}

void Parser::triples_same_subject(std::vector<Triple>& out) {
  const bool is_node = at_graph_node();
  if (!is_node) {
    fail(fmt::format("{} stands where a triple should begin", describe_token()),
         "begin it with a variable, an IRI, a literal, a blank node or a list");
  }
  const bool has_own_triples = at("[") || at("(");
  const std::size_t before = out.size();
  const Node subject = graph_node(out);
  // "[ :p :o ]" and "( 1 2 )" may stand alone; "[]" and "()" may not.
  const bool may_stand_alone = has_own_triples && out.size() > before;
  if (!at_verb()) {
    if (may_stand_alone) return;
    fail(fmt::format("{} stands where a predicate should", describe_token()),
         "write an IRI, a variable, a or a path");
  }
  property_list(subject, out);
}

void Parser::property_list(Node subject, std::vector<Triple>& out) {
  while (true) {
    Triple parsed;
    verb(parsed);
    object_list(subject, parsed, out);
    if (!at(";")) return;
    while (accept(";")) {
    }
    if (!at_verb()) return;
  }
}

void Parser::object_list(Node subject, const Triple& verb, std::vector<Triple>& out) {
  do {
    if (!at_graph_node()) {
      fail(fmt::format("{} stands where an object should", describe_token()),
           "write a variable, an IRI, a literal, a blank node or a list");
    }
    // The triple comes before those of its object, as in the text.
    const std::size_t place = out.size();
    add_triple(subject, verb, {}, verb.offset, out);
    const Node object = graph_node(out);
    out[place].object = object;
  } while (accept(","));
}

Node Parser::graph_node(std::vector<Triple>& out) {
  if (at_variable()) {
    if (triple_mode_ == TripleMode::kData) {
      fail("a variable stands in data",
           "write a term; for a pattern use INSERT or DELETE with WHERE");
    }
    const Node node = Node::variable(variable());
    if (triple_mode_ == TripleMode::kPattern) scope_.see(node.value);
    return node;
  }
  if (at_iri()) return Node::term(iri());
  if (at_literal()) return Node::term(literal());
  if (token_.kind == TokenKind::kBlankLabel) {
    const Node node = blank_node(token_.text, token_.offset);
    advance();
    return node;
  }
  if (at("[")) return blank_node_property_list(out);
  return collection(out);
}

Node Parser::blank_node_property_list(std::vector<Triple>& out) {
  const Level level(*this);
  advance();
  const Node node = fresh_blank_node();
  if (accept("]")) return node;
  if (!at_verb()) {
    fail(fmt::format("{} stands where a predicate should", describe_token()),
         "write an IRI, a variable, a or a path, or close the ']'");
  }
  property_list(node, out);
  expect("]", "close the blank node");
  return node;
}

Node Parser::collection(std::vector<Triple>& out) {
  const Level level(*this);
  advance();
  const Node nil = Node::term(terms_.iri(graph::kRdfNil));
  if (accept(")")) return nil;
  Triple first, rest;
  first.predicate = Node::term(terms_.iri(graph::kRdfFirst));
  rest.predicate = Node::term(terms_.iri(graph::kRdfRest));
  const Node head = fresh_blank_node();
  Node cell = head;
  while (true) {
    if (!at_graph_node()) {
      fail(fmt::format("{} stands in a list", describe_token()), "write a term, or close the ')'");
    }
    const std::size_t offset = token_.offset;
    const Node item = graph_node(out);
    add_triple(cell, first, item, offset, out);
    if (accept(")")) {
      add_triple(cell, rest, nil, offset, out);
      return head;
    }
    const Node next = fresh_blank_node();
    add_triple(cell, rest, next, offset, out);
    cell = next;
  }
}

}  // namespace sinew::rdf::sparql::syntax
