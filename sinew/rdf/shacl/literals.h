// What SHACL asks of literals: is the lexical form one of its datatype, which of two values is
// less, and how long is a text.
#pragma once

#include <compare>
#include <cstddef>
#include <string_view>

#include "sinew/graph/terms.h"

namespace sinew::rdf::shacl {

using graph::Id;

// Whether the text is in the lexical space of the datatype, given as IRI. True for datatypes that
// are not of XML Schema: nothing is known about them.
bool is_well_formed(std::string_view lexical, std::string_view datatype);

// The order of SPARQL's `<` (SPARQL 1.1, section 17.3): numbers, strings, booleans, dates and
// times. Unordered for everything else, and for values of different kinds. Exact for integers and
// decimals.
std::partial_ordering compare_values(Id a, Id b, const graph::Terms& terms);

// SPARQL's langMatches: basic filtering of RFC 4647.
bool language_matches(std::string_view language, std::string_view range);

// Characters, not bytes.
std::size_t character_count(std::string_view text);

std::string to_lower(std::string_view ascii);

}  // namespace sinew::rdf::shacl
