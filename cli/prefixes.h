// The prefixes that tables and Turtle are printed with, and that -e texts may use without declaring
// them.
#pragma once

#include <string>
#include <string_view>

#include "sinew/rdf/iri/prefixes.h"

namespace sinew::cli {

const rdf::Prefixes& known_prefixes();

// The text with PREFIX declarations for those known prefixes that it uses but does not declare.
// Lines keep their numbers.
std::string with_known_prefixes(const std::string& text);

}  // namespace sinew::cli
