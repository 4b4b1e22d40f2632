// Constraints that are SPARQL queries: sh:sparql, and validators of components that a shapes graph
// defines (SHACL, sections 5 and 6).
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sinew/rdf/shacl/shapes.h"
#include "sinew/rdf/sparql/prepared.h"

namespace sinew::rdf::shacl {

// A query that is ready to run for one shape: prefixes and $PATH are in its text, and the variables
// that have a value before it begins are its parameters.
struct SparqlCheck {
  bool is_ask = false;  // asked for each value node; true where it conforms
  // By the dataset that patterns match: graph::Dataset as index.
  std::array<std::shared_ptr<const sparql::Prepared>, 2> queries;
  // Names and values of the parameters, in the order of the query's. $this comes first; for ASK,
  // $value second; their values here are 0 and set for each run.
  std::vector<std::string> names;
  std::vector<Id> values;
  Id source_constraint;  // of sh:sparql, else 0
  std::vector<Message> messages;
  // Of SELECT: where the row has them.
  std::optional<std::size_t> value_column, path_column, message_column, failure_column;
};

}  // namespace sinew::rdf::shacl
