// What the readers of this folder refuse, with an Error, so that a hostile text cannot exhaust
// memory or stack.
#pragma once

#include <cstddef>

namespace sinew::rdf {

inline constexpr std::size_t kMaxNesting = 256;            // of [ ] and ( ), in Turtle and TriG
inline constexpr std::size_t kMaxTermBytes = 64ull << 20;  // of one IRI, name or literal

}  // namespace sinew::rdf
