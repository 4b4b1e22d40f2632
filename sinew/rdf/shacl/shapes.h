// Shapes as plain structs, parsed once from a shapes graph and then validated against any view.
//
// Shapes refer to each other by index, so that shapes that refer to themselves are no special case
// here.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/rdf/shacl/components.h"
#include "sinew/rdf/shacl/path.h"
#include "sinew/rdf/shacl/vocabulary.h"
#include "sinew/rdf/sparql/values/regex.h"

namespace sinew::rdf::shacl {

using ShapeIndex = std::uint32_t;

struct SparqlCheck;  // sparql_check.h

struct Constraint {
  Component component;
  Id component_iri = {};
  // What is compared with or looked for: classes, a datatype, a node kind, a bound, a value, the
  // members of a list, predicates of a pair, ignored properties.
  std::vector<Id> values = {};
  std::vector<ShapeIndex> shapes = {};  // of sh:not, sh:node, sh:property, the list of sh:and, …
  std::uint64_t count = 0;              // of the cardinality and length components
  std::vector<ShapeIndex> siblings = {};  // qualified components: shapes that a value must not have
  std::vector<std::string> languages = {};
  std::shared_ptr<const sparql::values::Regex> pattern = {};
  std::shared_ptr<const SparqlCheck> sparql = {};
};

// A message as the shapes graph gives it; in those of SHACL-SPARQL, {?name} and {$name} stand for
// values.
struct Message {
  std::string text;
  std::string language;
};

struct Shape {
  Id node;
  std::shared_ptr<const Path> path;  // null for node shapes
  Id severity;
  std::vector<Message> messages;
  bool deactivated = false;
  bool recursive = false;  // it can be reached from itself
  std::vector<Constraint> constraints;

  // Focus nodes; for implicit class targets the class is among target_classes.
  std::vector<Id> target_nodes, target_classes, target_subjects_of, target_objects_of;
  bool has_target() const {
    return !target_nodes.empty() || !target_classes.empty() || !target_subjects_of.empty() ||
           !target_objects_of.empty();
  }
};

struct Shapes {
  Vocabulary vocabulary;
  std::vector<Shape> shapes;
  std::unordered_map<Id, ShapeIndex> by_node;
  Id graph;  // the name of the shapes graph, if it has one: $shapesGraph of SHACL-SPARQL
  std::vector<Problem> warnings;  // of what is strange but has a meaning
};

// A shape may hold or refer to shapes to this depth; a list may have so many members.
inline constexpr std::size_t kMaxShapeDepth = 128;
inline constexpr std::size_t kMaxListLength = 100'000;

// Parses every shape that has a target, is declared as sh:NodeShape or sh:PropertyShape, or is used
// by one of these. Throws Error with every shape that is ill-formed, at its place in `places`. The
// store's dictionary is that of the shapes and of all data that is validated later.
Shapes parse_shapes(graph::Store& store, const GraphReader& shapes_graph,
                    const graph::Places* places = nullptr);

}  // namespace sinew::rdf::shacl
