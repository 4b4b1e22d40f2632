// From syntax tree to algebra (SPARQL 1.1, section 18.2).
#pragma once

#include <span>
#include <string_view>

#include "sinew/rdf/sparql/algebra/algebra.h"
#include "sinew/rdf/sparql/syntax/limits.h"

namespace sinew::rdf::sparql::algebra {

// `parameters`: names of the variables that are bound before the query runs.
Query translate(const syntax::Query& query, std::span<const std::string_view> parameters = {});

// WHERE of an update as a query whose columns are all the variables that the templates use, in the
// order in which `columns` lists them.
Query translate_where(const syntax::Operation& operation,
                      std::shared_ptr<const syntax::Source> source,
                      const std::vector<syntax::Variable>& columns,
                      std::span<const std::string_view> parameters = {});

}  // namespace sinew::rdf::sparql::algebra
