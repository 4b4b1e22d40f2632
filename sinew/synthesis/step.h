// Steps: the modules of which a synthesis is made. A step declares where it applies (an expansion
// query that leads from node to node of the model, and conditions), what it needs and what it
// gives, and two passes: one that makes data blocks and one that makes closures. The framework
// (sweep.h) runs the queries, once for all steps that have the same, and walks the graph.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/graph/terms.h"

namespace sinew::synthesis {

using graph::Id;

// From the root to the leaves, or back. A local step looks at its own node only and runs in
// whichever sweep has what it needs. One that runs once is called at the root alone, in a sweep of
// its own, and looks at the whole robot.
enum class Direction : std::uint8_t { kOutward, kInward, kLocal, kOnce };
std::string_view to_string(Direction direction);

// Whom a visitor is called for: each node that the expansion reaches (and the root, by the step's
// own expansion), or each pair of a node and its child.
enum class Where : std::uint8_t { kNode, kEdge };

// What a visitor sees: the node (of an edge: the child, and its parent) and a row of a query's
// results.
struct Visit {
  Id node;
  Id parent;
  std::span<const std::string> columns;
  std::span<const Id> row;

  // The row's value in this column; Error when the query has no such column.
  Id operator[](std::string_view column) const;
};

struct Context;
using Pass = std::function<void(Context&, const Visit&)>;

// Queries may use ?node, ?algorithm, and for edges ?parent.
struct Visitor {
  Where where = Where::kEdge;
  std::vector<std::string> conditions;  // ASK; the visitor is called where all hold
  // SELECT: the visitor is called for each row. Without one, an edge's visitor gets the expansion's
  // row.
  std::string select;
  Pass configure;              // makes data blocks
  Pass compute;                // makes closures
  std::string expansion = {};  // instead of the step's, for a visitor of another kind of edge
};

struct Step {
  std::string name;     // last segment of its IRI in https://w3id.org/sinew/steps#
  std::string purpose;  // for people who ask why
  Direction direction = Direction::kOutward;
  std::string expansion;  // SELECT query with ?node that gives ?child
  // Slots of the blackboard. What a step may use, it gets if it is given or made for somebody else.
  std::vector<std::string> needs, may_use, gives;
  std::vector<Visitor> visitors;
  // Whether every joint must move by itself: no joint follows another.
  bool takes_joints_one_by_one = false;
};

// Every step that comes with Sinew, in an order in which those that give come before those that
// need.
const std::vector<Step>& steps();
const Step* find_step(std::string_view name);  // nullptr when there is none

}  // namespace sinew::synthesis
