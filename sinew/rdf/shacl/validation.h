// Validating a data graph against shapes (SHACL, section 3).
//
//   const Shapes shapes = parse_shapes(store, GraphReader(store.view(), shapes_graph));
//   const ValidationReport report = validate(shapes, GraphReader(store.view()));
//   if (!report.conforms()) std::cerr << to_text(report, store.terms(), &places);   //
//   report_text.h
//
// Recursion: what shapes that refer to themselves mean is left open by SHACL. Here they are
// followed as far as the data goes; a shape that needs its own verdict on the same node, or a depth
// of more than kMaxValidationDepth, is an Error.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sinew/rdf/shacl/shapes.h"

namespace sinew::rdf::shacl {

struct Result {
  Id focus_node;
  std::shared_ptr<const Path> path;  // null for node shapes
  Id value;                          // 0 where the component gives none
  Id source_shape;
  Component component;
  Id component_iri;
  Id source_constraint;  // of sh:sparql, else 0
  Id severity;
  std::vector<Message> messages;  // those that the shape or the constraint has
  // In our own words, for people: what is wrong, and what would be right.
  std::string what, remedy;
  std::vector<Result> details;  // why a value does not conform to the shape of sh:node
};

struct ValidationReport {
  std::vector<Result> results;
  bool conforms() const { return results.empty(); }
};

inline constexpr std::size_t kMaxValidationDepth = 500;
inline constexpr std::size_t kMaxResults = 100'000;

struct ValidationOptions {
  // Error when there are more.
  std::size_t max_results = kMaxResults;
};

// The whole data graph, by the targets of all shapes. Throws Error on failure in the sense of
// SHACL.
ValidationReport validate(const Shapes& shapes, const GraphReader& data,
                          const ValidationOptions& options = {});
// One node against one shape, whatever its targets.
ValidationReport validate_node(const Shapes& shapes, Id shape, Id focus_node,
                               const GraphReader& data, const ValidationOptions& options = {});

}  // namespace sinew::rdf::shacl
