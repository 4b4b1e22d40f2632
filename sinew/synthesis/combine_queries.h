// Several queries as one: what all of them ask, from what any of them gives. The program that
// answers it computes once what several of them need.
#pragma once

#include <span>
#include <string>

#include "sinew/synthesis/query.h"

namespace sinew::synthesis {

// In the order of the queries, each thing once. Its name is theirs, joined by "_". Error when two
// queries differ in what a query has once: base, gravity, policies.
Query combined(std::span<const Query> queries);

}  // namespace sinew::synthesis
