// Single terms as text, in the forms that the Turtle family, TSV results and tables share.
#pragma once

#include <string>
#include <string_view>

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

// The same in Turtle's short forms: prefixed names, bare numbers and booleans, """ for texts of
// several lines.
class ShortTerms {
 public:
  ShortTerms(const graph::Terms& terms, const Prefixes& prefixes)
      : terms_(terms), prefixes_(prefixes) {}
  void append(std::string& out, graph::Id id);
  // The prefixes that were needed so far, in the order of the given ones.
  Prefixes used() const;

 private:
  void append_iri(std::string& out, graph::Id id);
  void append_literal(std::string& out, graph::Id id);

  const graph::Terms& terms_;
  const Prefixes& prefixes_;
  Prefixes used_;
};

// True when Turtle reads the bare text as a literal of this type: integers, decimals, doubles,
// booleans.
bool is_bare_literal(std::string_view text, std::string_view datatype);

}  // namespace sinew::rdf
