// From text to syntax tree. Every rule of the grammar (SPARQL 1.1, section 19.8) and every
// restriction beside it is checked here: prefixes, the scope of AS, blank-node labels, where
// aggregates may stand.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "sinew/graph/terms.h"
#include "sinew/rdf/iri/prefixes.h"
#include "sinew/rdf/sparql/syntax/ast.h"
#include "sinew/rdf/sparql/syntax/limits.h"

namespace sinew::rdf::sparql::syntax {

struct ParseOptions {
  std::string name;  // of the text, for messages: a file name, or empty
  std::string base;  // IRI that relative IRIs are resolved against; empty: they are errors
  Limits limits = {};
  const Prefixes* prefixes = nullptr;  // declared before the text begins; alive during the call
  // Parameters are variables that have a value before the query begins: they may be selected beside
  // aggregates without being a group key.
  std::span<const std::string_view> parameters = {};
};

// Both throw Error with line, column and remedy. Constants are added to `terms`.
Query parse_query(graph::Terms& terms, std::string_view text, const ParseOptions& options = {});
Update parse_update(graph::Terms& terms, std::string_view text, const ParseOptions& options = {});

}  // namespace sinew::rdf::sparql::syntax
