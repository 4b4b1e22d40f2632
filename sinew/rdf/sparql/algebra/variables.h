// Fills in which variables a pattern binds. Private to this folder.
#pragma once

#include "sinew/rdf/sparql/algebra/algebra.h"

namespace sinew::rdf::sparql::algebra {

// Sets pattern.possible and pattern.certain from its own content and from its parts, which have
// theirs already.
void find_variables(Pattern& pattern);

}  // namespace sinew::rdf::sparql::algebra
