// From algebra to plan: which operators, in which order.
//
// A group becomes a list of items (triples, paths, filters, OPTIONALs, …) that is ordered greedily
// by the number of rows that each is expected to make, given what is bound before it; statistics
// come from the graph's live counters. Filters run as soon as their variables are bound.
//
// Bindings flow from left to right into everything, also into nested groups, which is fast and
// nearly always equal to the standard's bottom-up meaning. Where it is not (an OPTIONAL or a filter
// in a nested group that mentions a variable of the outer group which its own group does not bind,
// sub-selects with aggregates or LIMIT, MINUS), the part is evaluated on its own and joined as a
// table. `safe_inside` decides.
#pragma once

#include <memory>

#include "sinew/graph/store.h"
#include "sinew/rdf/sparql/algebra/algebra.h"
#include "sinew/rdf/sparql/plan/plan.h"

namespace sinew::rdf::sparql::plan {

// Statistics are those of `view`. Throws Error when the plan would exceed a limit.
std::shared_ptr<const Plan> make_plan(const algebra::Query& query, const graph::View& view,
                                      const DatasetPlan& dataset);

// The dataset of a query: its FROM clauses, else what the caller chose.
DatasetPlan dataset_of(const syntax::DatasetClause& clause, graph::Dataset chosen);

// A tree of operators with the expected rows, for people.
std::string explain(const Plan& plan, const graph::Terms& terms);

}  // namespace sinew::rdf::sparql::plan
