// From the graph to an algorithm in memory.
#pragma once

#include "sinew/algorithm/model.h"
#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"

namespace sinew::algorithm {

// Limit of an RDF list's length, against endless ones.
inline constexpr std::size_t kMaximumListLength = 1'000'000;

// The algorithms of the store: every node with type sa:Algorithm.
std::vector<graph::Id> find_algorithms(const graph::View& view);

// The order of what `read` returns. Blocks: inputs, then outputs, each by index and name; then the
// others as the schedule meets them.
void put_in_order(Algorithm& model);

// Reads one algorithm from its graph. What is missing or of the wrong kind (an unknown operator or
// quantity, a port that is not connected, a broken list) is reported; what came through is
// returned. The order of blocks and closures is that of the schedule, inputs first, so it does not
// depend on how the graph was written.
Algorithm read(const graph::View& view, graph::Id algorithm, Report& report,
               const graph::Places* places = nullptr);

// Reads, checks, and throws Error if anything is wrong.
Algorithm read_checked(const graph::View& view, graph::Id algorithm,
                       const graph::Places* places = nullptr);

}  // namespace sinew::algorithm
