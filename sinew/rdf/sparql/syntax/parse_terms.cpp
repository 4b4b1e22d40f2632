#include <fmt/format.h>

#include "sinew/graph/standard_iris.h"
#include "sinew/rdf/iri/iri.h"
#include "sinew/rdf/sparql/syntax/parser_class.h"

namespace sinew::rdf::sparql::syntax {
void Parser::prologue() {
  while (true) {
    if (accept_word("BASE")) {
      if (token_.kind != TokenKind::kIri) {
        fail(fmt::format("{} stands behind BASE", describe_token()), "write BASE <iri>");
      }
      base_ = iri_text();
      advance();
    } else if (accept_word("PREFIX")) {
      if (token_.kind != TokenKind::kName || !token_.text.empty()) {
        fail(fmt::format("{} stands behind PREFIX", describe_token()), "write PREFIX name: <iri>");
      }
      const std::string name = token_.prefix;
      advance();
      if (token_.kind != TokenKind::kIri) {
        fail(fmt::format("{} stands where the prefix's IRI should", describe_token()),
             "write PREFIX name: <iri>");
      }
      prefixes_.set(name, iri_text());
      advance();
    } else {
      return;
    }
  }
}

// The whole IRI of the present token, which stays.
std::string Parser::iri_text() {
  if (token_.kind == TokenKind::kName) {
    const auto found = prefixes_.find(token_.prefix);
    if (!found) {
      std::string remedy =
          fmt::format("declare it at the beginning: PREFIX {}: <iri>", token_.prefix);
      if (options_.prefixes && !options_.prefixes->empty()) {
        remedy += "; without that there are";
        for (const Prefix& known : options_.prefixes->list()) remedy += " " + known.name + ":";
      }
      fail(fmt::format("the prefix '{}:' is not declared", token_.prefix), std::move(remedy));
    }
    return std::string(*found) + token_.text;
  }
  if (is_absolute_iri(token_.text) && base_.empty()) return token_.text;
  if (base_.empty()) {
    fail(fmt::format("the IRI <{}> is relative and there is no base", token_.text),
         "write the whole IRI, or declare BASE <iri>");
  }
  auto resolved = resolve_iri(token_.text, base_);
  if (!resolved) {
    fail(fmt::format("the IRI <{}> cannot be resolved against <{}>", token_.text, base_),
         "give an absolute IRI as base");
  }
  return *std::move(resolved);
}

graph::Id Parser::iri() {
  if (!at_iri()) {
    fail(fmt::format("{} stands where an IRI should", describe_token()),
         "write <iri> or prefix:name");
  }
  const graph::Id id = terms_.iri(iri_text());
  advance();
  return id;
}

bool Parser::at_literal() const {
  switch (token_.kind) {
    case TokenKind::kString:
    case TokenKind::kInteger:
    case TokenKind::kDecimal:
    case TokenKind::kDouble:
      return true;
    case TokenKind::kWord:
      return token_.text == "TRUE" || token_.text == "FALSE";
    case TokenKind::kPunctuation:
      return token_.text == "+" || token_.text == "-";
    default:
      return false;
  }
}

graph::Id Parser::numeric_literal(std::string_view sign) {
  std::string_view type;
  if (token_.kind == TokenKind::kInteger) type = "integer";
  if (token_.kind == TokenKind::kDecimal) type = "decimal";
  if (token_.kind == TokenKind::kDouble) type = "double";
  if (type.empty()) {
    fail(fmt::format("{} stands where a number should", describe_token()), "write a number");
  }
  const std::string lexical = std::string(sign) + token_.text;
  advance();
  return terms_.literal(lexical, std::string(graph::kXsd) + std::string(type));
}

// Precondition: at_literal().
graph::Id Parser::literal() {
  if (at("+") || at("-")) {
    const std::string sign = token_.text;
    const std::size_t end = token_.end;
    advance();
    if (token_.offset != end) {
      fail(fmt::format("{} does not follow its sign at once", describe_token()),
           "write the sign and the number without space");
    }
    return numeric_literal(sign);
  }
  if (token_.kind == TokenKind::kWord) {
    const graph::Id id = terms_.boolean(token_.text == "TRUE");
    advance();
    return id;
  }
  if (token_.kind != TokenKind::kString) return numeric_literal("");
  const std::string lexical = token_.text;
  advance();
  if (token_.kind == TokenKind::kLanguage) {
    const graph::Id id = terms_.literal(lexical, {}, token_.text);
    advance();
    return id;
  }
  if (accept("^^")) return terms_.literal(lexical, iri());
  return terms_.literal(lexical);
}

Variable Parser::variable_named(std::string_view name, bool hidden) {
  const auto [found, is_new] =
      variables_.try_emplace(std::string(name), static_cast<Variable>(names_.texts.size()));
  if (is_new) {
    if (names_.texts.size() >= kMaximumVariables) {
      fail(fmt::format("there are more than {} variables", kMaximumVariables), "split the query");
    }
    names_.texts.emplace_back(name);
    names_.hidden.push_back(hidden);
  }
  return found->second;
}

Variable Parser::variable() {
  if (!at_variable()) {
    fail(fmt::format("{} stands where a variable should", describe_token()), "write ?name");
  }
  const Variable result = variable_named(token_.text, false);
  advance();
  return result;
}

// No text can hold a name that begins with a dot.
Variable Parser::fresh_variable() {
  return variable_named(fmt::format(".{}", names_.texts.size()), true);
}

Node Parser::variable_or_iri() {
  if (at_variable()) return Node::variable(variable());
  if (!at_iri()) {
    fail(fmt::format("{} stands where a variable or an IRI should", describe_token()),
         "write ?name, <iri> or prefix:name");
  }
  return Node::term(iri());
}

Node Parser::fresh_blank_node() {
  if (triple_mode_ == TripleMode::kPattern) return Node::variable(fresh_variable());
  return Node::blank(template_blanks_++);
}

Node Parser::blank_node(std::string_view label, std::size_t offset) {
  auto& known = triple_mode_ == TripleMode::kData ? data_labels_ : labels_;
  const auto found = known.find(std::string(label));
  if (found == known.end()) {
    const Node node = fresh_blank_node();
    known.emplace(std::string(label), Label{node, basic_pattern_});
    return node;
  }
  // Section 19.6: one label, one basic graph pattern; and one INSERT DATA of a request.
  if (found->second.basic_pattern != basic_pattern_ && triple_mode_ != TripleMode::kTemplate) {
    fail_at(offset, fmt::format("the blank node _:{} stands in two patterns or operations", label),
            "use a variable for a node that both mean, or another label");
  }
  return found->second.node;
}

}  // namespace sinew::rdf::sparql::syntax
