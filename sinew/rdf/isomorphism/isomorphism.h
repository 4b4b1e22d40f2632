// Whether two sets of quads say the same, up to the names of their blank nodes.
//
// Colour refinement settles nearly every case in time close to linear; what stays symmetric is
// tried out, with a bound on the work, because the general problem has no known polynomial
// algorithm.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "sinew/graph/store.h"

namespace sinew::rdf {

enum class Likeness { kIsomorphic, kDifferent, kUndecided };

struct Comparison {
  Likeness likeness = Likeness::kDifferent;
  // Empty when isomorphic; else what differs, with some of the quads at fault in N-Quads form.
  std::string difference;
  explicit operator bool() const { return likeness == Likeness::kIsomorphic; }
};

// Nodes that may be looked at while trying out; kUndecided beyond.
inline constexpr std::size_t kIsomorphismBudget = 20'000'000;

// Both sets take their terms from the same dictionary. Quads that come several times count once.
// Blank nodes may stand in every field.
Comparison compare_quads(std::span<const graph::Quad> left, std::span<const graph::Quad> right,
                         const graph::Terms& terms, std::size_t budget = kIsomorphismBudget);

}  // namespace sinew::rdf
