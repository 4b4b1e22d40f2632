// Property paths (SPARQL 1.1, section 9; grammar rules 88 to 96).
#include <fmt/format.h>

#include <utility>

#include "sinew/graph/standard_iris.h"
#include "sinew/rdf/sparql/syntax/parser_class.h"

namespace sinew::rdf::sparql::syntax {
namespace {

Path wrap(Path::Kind kind, Path inner) {
  Path path;
  path.kind = kind;
  path.parts.push_back(std::move(inner));
  return path;
}

}  // namespace

Path Parser::path() {
  const Level level(*this);
  Path first = path_sequence();
  if (!at("|")) return first;
  Path alternative = wrap(Path::Kind::kAlternative, std::move(first));
  while (accept("|")) alternative.parts.push_back(path_sequence());
  return alternative;
}

Path Parser::path_sequence() {
  Path first = path_element();
  if (!at("/")) return first;
  Path sequence = wrap(Path::Kind::kSequence, std::move(first));
  while (accept("/")) sequence.parts.push_back(path_element());
  return sequence;
}

Path Parser::path_element() {
  const bool inverse = accept("^");
  Path path = path_primary();
  // The modifier belongs to the path without the '^' (rule 92: '^' PathElt), which makes no
  // difference to what it matches.
  if (accept("*")) {
    path = wrap(Path::Kind::kZeroOrMore, std::move(path));
  } else if (accept("+")) {
    path = wrap(Path::Kind::kOneOrMore, std::move(path));
  } else if (accept("?")) {
    path = wrap(Path::Kind::kZeroOrOne, std::move(path));
  }
  return inverse ? wrap(Path::Kind::kInverse, std::move(path)) : path;
}

Path Parser::path_primary() {
  Path path;
  if (accept_word("a")) {
    path.iri = terms_.iri(graph::kRdfType);
    return path;
  }
  if (at_iri()) {
    path.iri = iri();
    return path;
  }
  if (accept("!")) return path_negated_set();
  if (accept("(")) {
    path = this->path();
    expect(")", "close the path");
    return path;
  }
  fail(fmt::format("{} stands in a path", describe_token()),
       "write an IRI, a, !, or a path in parentheses");
}

Path Parser::path_negated_set() {
  Path path;
  path.kind = Path::Kind::kNegated;
  if (!accept("(")) {
    path_one_in_set(path);
    return path;
  }
  if (accept(")")) {
    path.walks_forward = true;
    return path;
  }
  do {
    path_one_in_set(path);
  } while (accept("|"));
  expect(")", "close the negated set");
  return path;
}

void Parser::path_one_in_set(Path& into) {
  const bool backward = accept("^");
  const graph::Id id = accept_word("a") ? terms_.iri(graph::kRdfType) : iri();
  (backward ? into.backward : into.forward).push_back(id);
  (backward ? into.walks_backward : into.walks_forward) = true;
}

}  // namespace sinew::rdf::sparql::syntax
