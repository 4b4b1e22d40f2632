#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "sinew/rdf/shacl/shape_parser.h"

namespace sinew::rdf::shacl {

Shapes parse_shapes(graph::Store& store, const GraphReader& shapes_graph,
                    const graph::Places* places) {
  return ShapeParser(store, shapes_graph, places).parse();
}

ShapeParser::ShapeParser(graph::Store& store, const GraphReader& in, const graph::Places* places)
    : store_(store),
      in_(in),
      places_(places),
      out_{Vocabulary(store.terms()), {}, {}, in.graph(), {}},
      v_(out_.vocabulary) {}

Shapes ShapeParser::parse() {
  find_custom_components();
  for (const Id node : roots()) shape(node);
  report_.throw_if_errors();
  mark_recursive();
  return std::move(out_);
}

std::vector<Id> ShapeParser::sub_classes_of(Id super_class) const {
  Path path{Path::Kind::kZeroOrMore,
            {},
            {Path{Path::Kind::kInverse, {}, {Path::of(v_.rdfs_sub_class_of)}}}};
  return nodes_at(path, super_class, in_);
}

// Declared shapes and nodes with a target, each once, in the order of the graph.
std::vector<Id> ShapeParser::roots() const {
  std::vector<Id> found;
  std::unordered_set<Id> seen;
  const auto add_subjects = [&](Id predicate, Id object) {
    in_.match({}, predicate, object, [&](const graph::Quad& quad) {
      if (seen.insert(quad.subject).second) found.push_back(quad.subject);
      return true;
    });
  };
  for (const Id kind : {v_.node_shape, v_.property_shape}) {
    for (const Id type : sub_classes_of(kind)) add_subjects(v_.rdf_type, type);
  }
  for (const Id target :
       {v_.target_node, v_.target_class, v_.target_subjects_of, v_.target_objects_of}) {
    add_subjects(target, {});
  }
  return found;
}

ShapeIndex ShapeParser::shape(Id node) {
  const auto index = static_cast<ShapeIndex>(out_.shapes.size());
  const auto [known, is_new] = out_.by_node.try_emplace(node, index);
  if (!is_new) return known->second;
  out_.shapes.emplace_back();
  out_.shapes.back().node = node;
  if (open_.size() == kMaxShapeDepth) {
    fault(node, {}, fmt::format("shapes are nested deeper than {}", kMaxShapeDepth),
          "declare the inner ones as sh:NodeShape or sh:PropertyShape of their own");
    return index;
  }
  open_.push_back(node);
  // Filled aside, because `shapes` grows meanwhile.
  Shape filled;
  filled.node = node;
  fill(node, filled);
  out_.shapes[index] = std::move(filled);
  open_.pop_back();
  return index;
}

void ShapeParser::fill(Id node, Shape& shape) {
  if (terms().is_literal(node)) {
    fault(node, {}, "a literal is used as a shape", "a shape is an IRI or a blank node");
    return;
  }
  const auto paths = in_.objects(node, v_.path);
  if (!paths.empty() && at_most_one(node, v_.path, paths)) {
    if (auto parsed = path(paths[0], node)) shape.path = std::make_shared<Path>(std::move(*parsed));
  } else if (in_.contains(node, v_.rdf_type, v_.property_shape)) {
    fault(node, {}, "a sh:PropertyShape without sh:path", "give it one sh:path");
  }
  if (!paths.empty() && in_.contains(node, v_.rdf_type, v_.node_shape)) {
    fault(node, v_.path, "a sh:NodeShape with sh:path",
          "declare it as sh:PropertyShape, or remove the path");
  }

  shape.severity = v_.violation;
  const auto severities = in_.objects(node, v_.severity);
  if (at_most_one(node, v_.severity, severities) && !severities.empty() &&
      is_iri(node, v_.severity, severities[0])) {
    shape.severity = severities[0];
  }
  const auto deactivated = in_.objects(node, v_.deactivated);
  if (at_most_one(node, v_.deactivated, deactivated) && !deactivated.empty()) {
    shape.deactivated = boolean(node, v_.deactivated, deactivated[0]).value_or(false);
  }
  shape.messages = messages(node);
  targets(node, shape);
  constraints(node, shape);
}

void ShapeParser::targets(Id node, Shape& shape) {
  shape.target_nodes = in_.objects(node, v_.target_node);
  for (const Id target : shape.target_nodes) {
    if (terms().is_blank(target)) {
      fault(node, v_.target_node, "sh:targetNode is a blank node",
            "it must be an IRI or a literal; use another kind of target");
    }
  }
  const auto iris = [&](Id property) {
    std::vector<Id> values = in_.objects(node, property);
    for (const Id value : values) is_iri(node, property, value);
    return values;
  };
  shape.target_classes = iris(v_.target_class);
  shape.target_subjects_of = iris(v_.target_subjects_of);
  shape.target_objects_of = iris(v_.target_objects_of);

  // Implicit class targets (section 2.1.3.3): the shape is a class, too.
  const auto has_type = [&](Id super_class) {
    const auto all = sub_classes_of(super_class);
    return std::any_of(all.begin(), all.end(),
                       [&](Id type) { return in_.contains(node, v_.rdf_type, type); });
  };
  if (!has_type(v_.rdfs_class) || !(has_type(v_.node_shape) || has_type(v_.property_shape))) return;
  if (terms().is_iri(node)) {
    shape.target_classes.push_back(node);
  } else {
    fault(node, {}, "a blank node is both a class and a shape", "give it an IRI");
  }
}

// A shape is recursive if it can be reached from itself. Iterative, from each shape: shapes graphs
// are small, and this is done once.
void ShapeParser::mark_recursive() {
  const std::size_t count = out_.shapes.size();
  std::vector<ShapeIndex> visited_from(count, static_cast<ShapeIndex>(count));
  std::vector<ShapeIndex> waiting;
  for (ShapeIndex start = 0; start < count; ++start) {
    waiting.assign(1, start);
    while (!waiting.empty() && !out_.shapes[start].recursive) {
      const ShapeIndex from = waiting.back();
      waiting.pop_back();
      const auto reach = [&](ShapeIndex to) {
        if (to == start) out_.shapes[start].recursive = true;
        if (visited_from[to] == start) return;
        visited_from[to] = start;
        waiting.push_back(to);
      };
      for (const Constraint& constraint : out_.shapes[from].constraints) {
        for (const ShapeIndex to : constraint.shapes) reach(to);
        for (const ShapeIndex to : constraint.siblings) reach(to);
      }
    }
  }
}

}  // namespace sinew::rdf::shacl
