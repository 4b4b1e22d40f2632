// Whether two result sets say the same.
#pragma once

#include "sinew/rdf/isomorphism/isomorphism.h"
#include "sinew/rdf/results/result_set.h"

namespace sinew::rdf {

// As multisets of rows, or in their order where `ordered` says so; up to the names of blank nodes;
// whatever the order of the columns. Both take their terms from one dictionary, to which helper
// nodes are added.
Comparison compare_results(const ResultSet& left, const ResultSet& right, bool ordered,
                           graph::Terms& terms);

}  // namespace sinew::rdf
