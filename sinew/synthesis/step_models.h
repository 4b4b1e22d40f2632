// Steps as data: a step that is a node of the graph (type ss:Step), whose expansion and conditions
// are SPARQL queries and whose passes are SPARQL INSERTs. No C++ is needed to add one: its file is
// read with the models, and the planner takes it for what it gives.
//
// All queries know ?node, ?parent (of an edge) and ?algorithm, and these prefixes:
//   tree:  the normalised tree                sa:  algorithm models       so:  operators
//   slot:  ELEMENT slot:NAME BLOCK: the data block that a step has left for an element
//   op-geom:, op-dyn:  the published operators
// A pass inserts descriptions of data blocks (a sa:DataBlock, with sa:slot, sa:represents,
// sa:quantity, sa:role and the frames that the quantity needs) and closures (a so:OPERATOR, with
// its ports), in the words of the algorithm model. Everything is checked as if a built-in step had
// made it.
#pragma once

#include <string>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/synthesis/asked.h"
#include "sinew/synthesis/step.h"

namespace sinew::synthesis {

inline constexpr std::string_view kStepModelNamespace = "https://w3id.org/sinew/step-model#";
inline constexpr std::string_view kSlotNamespace = "https://w3id.org/sinew/slots#";
// More insertions than this from one visit of one step are a query gone astray.
inline constexpr std::size_t kMostInsertions = 100'000;

// A quantity that can be asked because a step gives it.
struct AnsweredQuantity {
  std::string name, slot;
  Element element = Element::kFrame;
  bool dynamic = false;
  AskedQuantity row() const { return {name, element, slot, slot, true, dynamic}; }
};

struct StepModels {
  std::vector<Step> steps;
  std::vector<AnsweredQuantity> answers;
};

// Every step in the graph, by IRI. Faults are reported with the place of the property that has
// them, and the line within the query.
StepModels read_step_models(graph::Store& store, const graph::View& view,
                            const graph::Places* places, Report& report);

}  // namespace sinew::synthesis
