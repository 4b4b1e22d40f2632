// Constructor functions: xsd:integer("1") and the like (SPARQL 1.1, section 17.5; XPath and XQuery
// functions 3.1, section 19).
#pragma once

#include <string>

#include "sinew/rdf/sparql/values/value.h"

namespace sinew::rdf::sparql::values {

// kError when the value cannot be cast. `text` gets the text that the result refers to, if any.
Value cast(const Value& value, Datatype to, const TermSpace& space, std::string& text);

// STR(): the lexical form or the IRI; nothing of blank nodes and errors. Uses `text` if need be.
std::optional<std::string_view> as_text(const Value& value, const TermSpace& space,
                                        std::string& text);

}  // namespace sinew::rdf::sparql::values
