// What SHACL asks of literals beyond what SPARQL does: whether the lexical form is one of its
// datatype, and which of two values comes first.
#pragma once

#include <compare>
#include <string_view>

#include "sinew/rdf/sparql/values/term_space.h"

namespace sinew::rdf::shacl {

using graph::Id;

// Whether the text is in the lexical space of the datatype, given as IRI. True for datatypes that
// are not of XML Schema: nothing is known about them.
bool is_well_formed(std::string_view lexical, std::string_view datatype);

// The order of SPARQL's `<` (SPARQL 1.1, section 17.3). Unordered where SPARQL has an error.
std::partial_ordering compare_values(Id a, Id b, const sparql::values::TermSpace& space);

}  // namespace sinew::rdf::shacl
