// Faults of a query: each has the IRI of the node that says what cannot be (or of the query, where
// that node has none) and the place where it is written. What came from the command line has
// neither and is named by the element that it speaks of.
#pragma once

#include <string>

#include "sinew/base/error.h"
#include "sinew/synthesis/query.h"

namespace sinew::synthesis {

// `about`: the element or driver in question; empty: the part of the query as a whole.
Problem fault_in(const Query& query, const Origin& origin, std::string about, std::string what,
                 std::string remedy);

// The same for what a search for elements has thrown.
void add_faults(Report& report, const Query& query, const Origin& origin, const Error& error);

}  // namespace sinew::synthesis
