// Single terms as text, in the forms that the Turtle family, TSV results and tables share.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include "sinew/graph/terms.h"
#include "sinew/rdf/iri/prefixes.h"

namespace sinew::rdf {

// <iri>. Throws Error when the text is no absolute IRI.
void append_iri(std::string& out, std::string_view iri);
// "value" with the escapes of canonical N-Triples (RDF 1.1 N-Triples, section 4).
void append_quoted(std::string& out, std::string_view value);
// <iri> or "value", with ^^<datatype> or @language where there is one. Not for blank nodes, whose
// labels depend on the document.
void append_term(std::string& out, graph::Id id, const graph::Terms& terms);

// Labels of blank nodes for one document: _:b0, _:b1, ... in the order in which they are asked for.
class BlankLabels {
 public:
  void append(std::string& out, graph::Id node);

 private:
  std::unordered_map<graph::Id, std::size_t> numbers_;
};

// The same in Turtle's short forms: prefixed names, bare numbers and booleans, """ for texts of
// several lines.
class ShortTerms {
 public:
  ShortTerms(const graph::Terms& terms, const Prefixes& prefixes, bool several_lines = true)
      : terms_(terms), prefixes_(prefixes), several_lines_(several_lines) {}
  void append(std::string& out, graph::Id id);
  // The same, but with false and nothing written where append would throw.
  bool try_append(std::string& out, graph::Id id);
  // The prefixes that were needed so far, in the order of the given ones.
  Prefixes used() const;

 private:
  void append_iri(std::string& out, graph::Id id);
  void append_literal(std::string& out, graph::Id id);

  const graph::Terms& terms_;
  const Prefixes& prefixes_;
  const bool several_lines_;
  Prefixes used_;
};

// True when Turtle reads the bare text as a literal of this type: integers, decimals, doubles,
// booleans.
bool is_bare_literal(std::string_view text, std::string_view datatype);

}  // namespace sinew::rdf
