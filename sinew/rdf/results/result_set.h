// What a query answers: a table of terms, or yes or no.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/graph/terms.h"

namespace sinew::rdf {

struct ResultSet {
  std::vector<std::string> columns;          // names of the variables, without '?'
  std::vector<std::vector<graph::Id>> rows;  // as many ids as columns; the null Id where unbound
  std::optional<bool> boolean;  // the answer to ASK; there are no columns and rows then
};

}  // namespace sinew::rdf
