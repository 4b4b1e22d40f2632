// From a normalised tree and a query to an algorithm model in its own named graph.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/algorithm/model.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/synthesis/query.h"
#include "sinew/synthesis/sweep.h"

namespace sinew::synthesis {

struct Synthesis {
  graph::Id algorithm;  // the algorithm's node, and the name of its graph
  // What that graph says, as algorithm::read would give it; nothing for a task's, to which more
  // than the steps is added.
  std::optional<algorithm::Algorithm> model;
  std::vector<std::string> why;    // a line for each step, in the order of the sweeps
  std::vector<std::string> notes;  // what a user should know: no gravity stated, ...
  TraversalCounts counts;
};

// Whether the algorithm becomes a graph of the store. Its triples take a third of the time of the
// synthesis; whoever only lowers `Synthesis::model` can do without.
enum class AlgorithmGraph : std::uint8_t {
  kWritten,
  kIfNeeded,  // for want of a model, and where steps are data: their queries may look at the graph
};

// Writes the algorithm in one transaction: all of it or, when Error is thrown, nothing. The same
// model and query give the same nodes; an algorithm of the same query that is there already is
// replaced. A query that cannot be answered is refused with all that is missing and how to give it.
// Steps that are in the graph (step_models.h) stand beside those that come with Sinew; `places`
// says where they, and whatever else is at fault, were written.
Synthesis synthesise(graph::Store& store, const Query& query, const graph::Places* places = nullptr,
                     AlgorithmGraph graph = AlgorithmGraph::kWritten);

}  // namespace sinew::synthesis
