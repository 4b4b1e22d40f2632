// Comparison and arithmetic of values (SPARQL 1.1, section 17.3), and the order of ORDER BY.
#pragma once

#include "sinew/rdf/sparql/syntax/operators.h"
#include "sinew/rdf/sparql/values/value.h"

namespace sinew::rdf::sparql::values {

// Of two terms that are not both literals: whether they are the same IRI or blank node. A derived
// node is the same as the IRI that has its text.
bool same_node(graph::Id a, graph::Id b, const TermSpace& space);
// The same of any two terms, without a look at their values: kError where that would be needed.
Truth same_without_values(graph::Id a, graph::Id b, const TermSpace& space);

// `=`: values where both datatypes are known, else terms. Literals that might be equal in a
// datatype that is not known are an error.
Truth equals(const Value& a, const Value& b, const TermSpace& space);
// `<`; kError where the two cannot be compared.
Truth less(const Value& a, const Value& b);

// op: kAdd, kSubtract, kMultiply, kDivide.
Value arithmetic(Operator op, const Value& a, const Value& b);
Value negated(const Value& a);

// < 0, 0, > 0: unbound, blank nodes, IRIs, literals (section 15.1); a total order, in which
// literals that `<` cannot compare go by datatype, language and text.
int order(graph::Id a, graph::Id b, const TermSpace& space);

}  // namespace sinew::rdf::sparql::values
