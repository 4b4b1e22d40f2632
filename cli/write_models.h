// Models and algorithms as JSON-LD, with the project's contexts.
#pragma once

#include <span>
#include <string>

#include "sinew/graph/store.h"

namespace sinew::cli {

// Every graph of the view, with the contexts of robot models. What the names of all graphs begin
// with gets the prefix "rob".
std::string models_as_jsonld(const graph::View& view);

// Triples (their graph is ignored), with the same contexts; the same text for the same triples.
std::string triples_as_jsonld(std::span<const graph::Quad> triples, const graph::Terms& terms);

// One algorithm's graph.
std::string algorithm_as_jsonld(const graph::View& view, graph::Id algorithm);

}  // namespace sinew::cli
