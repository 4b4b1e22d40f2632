// Arithmetic with instants and durations (XPath and XQuery functions 3.1, sections 8 and 9).
// Private to this folder.
#pragma once

#include "sinew/rdf/sparql/syntax/operators.h"
#include "sinew/rdf/sparql/values/value.h"

namespace sinew::rdf::sparql::values {

// kError unless one is an instant or a duration and the other fits.
Value time_arithmetic(Operator op, const Value& a, const Value& b);

}  // namespace sinew::rdf::sparql::values
