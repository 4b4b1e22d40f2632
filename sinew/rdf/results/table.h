// Result sets for people: an aligned table for a terminal.
#pragma once

#include <string>

#include "sinew/rdf/iri/prefixes.h"
#include "sinew/rdf/results/result_set.h"

namespace sinew::rdf {

// A line of variables, a line below it, a line for each row, and how many rows there are. Terms are
// in Turtle's short forms; unbound ones are empty. The answer to ASK is "yes" or "no".
std::string write_table(const ResultSet& results, const graph::Terms& terms,
                        const Prefixes& prefixes);

}  // namespace sinew::rdf
