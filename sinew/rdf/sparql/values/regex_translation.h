// From the regular expressions of XPath to those of PCRE2. Private to this folder.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sinew::rdf::sparql::values {

// Nothing when the pattern is not one of XPath's; `why` then says so. `extended`: flag x, under
// which white space outside of brackets is left out. `dot_all`: flag s.
std::optional<std::string> to_pcre(std::string_view pattern, bool extended, bool dot_all,
                                   std::string& why);

}  // namespace sinew::rdf::sparql::values
