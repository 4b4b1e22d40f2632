// Small tasks as JSON-LD text, read into plain values.
#pragma once

#include <string>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/model/load.h"
#include "sinew/task/read_task.h"

namespace sinew::task {

inline const std::string kContexts = R"("@context": [
  "https://comp-rob2b.github.io/metamodels/geometry/spatial-relations.json",
  "https://comp-rob2b.github.io/metamodels/geometry/coordinates.json",
  "https://comp-rob2b.github.io/metamodels/kinematic-chain/state.json",
  "https://comp-rob2b.github.io/metamodels/newtonian-rigid-body-dynamics/structural-entities.json",
  "https://comp-rob2b.github.io/metamodels/newtonian-rigid-body-dynamics/coordinates.json",
  "https://comp-rob2b.github.io/metamodels/task/map.json",
  "https://comp-rob2b.github.io/metamodels/task/constraint.json",
  "https://comp-rob2b.github.io/metamodels/task/constraint-handler.json",
  "https://comp-rob2b.github.io/metamodels/task/motion-specification.json",
  "https://comp-rob2b.github.io/metamodels/task/solver-specification.json",
  "https://comp-rob2b.github.io/metamodels/qudt.json",
  "https://w3id.org/sinew/task.json",
  { "t": "https://example.org/task/" } ])";

struct Loaded {
  graph::Store store;
  graph::Places places;
  Report report;
  Task task;

  // All problems, one a line.
  std::string problems() const {
    std::string text;
    for (const Problem& problem : report.problems()) text += to_string(problem) + "\n";
    return text;
  }
  graph::Id id(const std::string& name) {
    return store.terms().iri("https://example.org/task/" + name);
  }
};

// `nodes`: the nodes of @graph.
inline void load(const std::string& nodes, Loaded& loaded) {
  const model::Source source{
      "task.jsonld", "{" + kContexts + ", \"@id\": \"t:task\", \"@graph\": [" + nodes + "]}"};
  model::load(std::span(&source, 1), {}, loaded.store, loaded.places, loaded.report);
  if (!loaded.report.has_errors())
    loaded.task = read_task(loaded.store, loaded.places, loaded.report);
}

}  // namespace sinew::task
