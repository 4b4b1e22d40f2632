// The prefixes that tables and Turtle are printed with, and that queries and updates may use
// without declaring them.
#pragma once

#include "sinew/rdf/iri/prefixes.h"

namespace sinew::cli {

const rdf::Prefixes& known_prefixes();

}  // namespace sinew::cli
