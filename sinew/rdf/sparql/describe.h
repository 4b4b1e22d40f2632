// DESCRIBE: what the graph says about a node. Private to this folder.
#pragma once

#include <span>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/rdf/sparql/plan/plan.h"

namespace sinew::rdf::sparql {

// Every triple of the default graph whose subject is one of the nodes, and those of blank nodes
// that they lead to.
std::vector<graph::Quad> describe(const graph::View& view, const plan::DatasetPlan& dataset,
                                  std::span<const graph::Id> nodes);

}  // namespace sinew::rdf::sparql
