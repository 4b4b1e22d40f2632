// When may outer bindings flow into a pattern? Private to this folder.
#pragma once

#include "sinew/rdf/sparql/algebra/algebra.h"

namespace sinew::rdf::sparql::plan {

// True when joining the pattern's solutions with a solution that may bind any of `outer` gives the
// same as evaluating the pattern with those bindings in place. Variables that count as constants
// (parameters, what an EXISTS sees from around it) must not be in `outer`.
bool safe_inside(const algebra::Pattern& pattern, const algebra::VariableSet& outer);

// A sub-select that is nothing but a projection of its pattern and select expressions.
bool is_plain(const algebra::Select& select);

// True when there is an EXISTS in the expression.
bool has_exists(const algebra::Expression& expression);

// True when each solution of the pattern comes from at least one triple of the graph that it is
// evaluated in, so that the graph need not be looked for separately.
bool needs_a_triple(const algebra::Pattern& pattern);

}  // namespace sinew::rdf::sparql::plan
