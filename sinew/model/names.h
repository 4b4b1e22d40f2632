// Finding the elements of a model by name: an IRI, or the last segment of one, also as it was
// before it was percent-encoded.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/graph/terms.h"

namespace sinew::model {

// "link7" of ".../7dof/link7" and of ".../robot#link7".
std::string_view last_segment(std::string_view iri);

struct Match {
  graph::Id element;                  // nothing when there is none, or more than one
  std::vector<graph::Id> candidates;  // all that have the name
};

// Looks through the groups in order; the first group with a match decides.
Match find_by_name(const graph::Terms& terms, std::string_view name,
                   const std::vector<std::vector<graph::Id>>& groups);

}  // namespace sinew::model
