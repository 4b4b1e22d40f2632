// Small data in TriG, and results as short names, so that a test reads as a table.
#pragma once

#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/rdf/sparql/engine.h"
#include "sinew/rdf/sparql/prepared.h"

namespace sinew::rdf::sparql {

// Rows of terms, sorted unless said otherwise. Terms are written as in Turtle with the prefixes :
// for http://e/ and xsd:; "-" is unbound, "_" any blank node.
using Rows = std::vector<std::vector<std::string>>;

// A query of a table of tests, and what it gives.
struct QueryCase {
  const char* name;
  const char* query;
  Rows expected;
};
inline std::ostream& operator<<(std::ostream& out, const QueryCase& c) { return out << c.name; }

struct Table {
  // The data may use the prefix : without declaring it.
  explicit Table(std::string_view trig = "");

  graph::Id id(std::string_view name);  // ":name"
  std::string name(graph::Id id) const;

  // The text may use the prefixes : and xsd: without declaring them.
  Answer answer(std::string_view text, const QueryOptions& options = {});
  Rows rows(std::string_view text, const QueryOptions& options = {});  // sorted
  Rows ordered_rows(std::string_view text);
  bool ask(std::string_view text, const QueryOptions& options = {});
  Rows triples(std::string_view text);  // of CONSTRUCT and DESCRIBE, sorted
  Rows rows(const Prepared& query, const std::vector<graph::Id>& parameters);

  UpdateCounts update(std::string_view text, const UpdateOptions& options = {});
  Rows quads() const;  // subject, predicate, object, graph ("-": unnamed); sorted

  // The Error's message for a text that must be refused.
  std::string refusal(std::string_view text, const QueryOptions& options = {});
  std::string update_refusal(std::string_view text, const UpdateOptions& options = {});

  graph::Store store;
};

}  // namespace sinew::rdf::sparql
