// Reading and writing xsd:integer and its subtypes, xsd:float and xsd:double.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sinew/rdf/sparql/values/decimal.h"

namespace sinew::rdf::sparql::values {

// `datatype`: the IRI of xsd:integer or of one of its subtypes, whose range is checked.
std::optional<Decimal> parse_integer(std::string_view text, std::string_view datatype);
// The lexical form of xsd:double and xsd:float; INF, -INF and NaN among them.
std::optional<double> parse_double(std::string_view text);

// Literals: canonical form (XML Schema 1.1, part 2, section 3.3.5): "1.0E0", "INF".
std::string double_text(double value);
std::string float_text(float value);
// As a string (XPath and XQuery functions 3.1, section 19.1.2): "1", "0.000001", "1.0E-7".
std::string double_as_string(double value);
std::string float_as_string(float value);

}  // namespace sinew::rdf::sparql::values
