// Names of people's choosing in IRIs: what an IRI cannot hold stands there as %XX (RFC 3986, 2.1).
#pragma once

#include <string>
#include <string_view>

namespace sinew::graph {

// "base link" of "base%20link". What is no encoding stays as it is.
std::string percent_decoded(std::string_view text);

}  // namespace sinew::graph
