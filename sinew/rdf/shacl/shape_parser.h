// From a shapes graph to Shapes; private to parse_*.cpp. Faults are collected and thrown together.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/rdf/shacl/shapes.h"

namespace sinew::rdf::shacl {

class ShapeParser {
 public:
  ShapeParser(graph::Store& store, const GraphReader& in, const graph::Places* places);
  Shapes parse();

 private:
  // ---- shapes (parse_shapes.cpp) ----
  std::vector<Id> roots() const;
  std::vector<Id> sub_classes_of(Id super_class) const;
  ShapeIndex shape(Id node);
  void fill(Id node, Shape& shape);
  void targets(Id node, Shape& shape);
  void mark_recursive();

  // ---- paths (parse_path.cpp) ----
  // Reports what is wrong at `shape` and gives nothing.
  std::optional<Path> path(Id node, Id shape, std::size_t depth = 0);
  std::optional<Path> wrapped(Path::Kind kind, Id node, Id shape, std::size_t depth);
  std::optional<Path> several(Path::Kind kind, Id list, Id shape, std::size_t depth);

  // ---- constraints (parse_constraints.cpp) ----
  void constraints(Id node, Shape& shape);
  void constraint(Id node, Shape& shape, const ComponentRow& row, Id parameter,
                  const std::vector<Id>& values);
  void qualified(Id node, Shape& shape, const ComponentRow& row, const std::vector<Id>& counts);
  std::vector<ShapeIndex> siblings(Id node, Id own);
  void closed(Id node, Shape& shape, const ComponentRow& row, bool is_closed);
  std::shared_ptr<const sparql::values::Regex> pattern(Id node, Id text);

  // ---- SHACL-SPARQL (parse_sparql.cpp) ----
  struct CustomComponent;
  void find_custom_components();
  void sparql_constraint(Id node, Shape& shape, Id constraint);
  void custom_constraints(Id node, Shape& shape);
  void custom_constraint(Id node, Shape& shape, const CustomComponent& component,
                         const std::vector<Id>& values);
  SparqlCheck new_check(Id shape, bool is_ask) const;
  bool prepare(Id holder, Id property, const Shape& shape, SparqlCheck& check);
  std::string prologue(Id node);

  // ---- values (parse_values.cpp): report what is wrong and give nothing ----
  bool at_most_one(Id node, Id property, const std::vector<Id>& values);
  std::optional<bool> boolean(Id node, Id property, Id value);
  std::optional<std::uint64_t> count(Id node, Id property, Id value);
  std::optional<std::vector<Id>> list(Id node, Id property, Id head);
  bool is_iri(Id node, Id property, Id value);
  bool is_string(Id node, Id property, Id value, bool or_lang_string);
  std::vector<Message> messages(Id node);

  // Of the property, else of the node, else of the innermost shape around it.
  Place place(Id node, Id property) const;
  void fault(Id node, Id property, std::string what, std::string remedy);
  void warn(Id node, Id property, std::string what, std::string remedy);
  std::string name(Id id) const;  // short, for messages
  const graph::Terms& terms() const { return store_.terms(); }

  graph::Store& store_;
  const GraphReader& in_;
  const graph::Places* places_;
  Shapes out_;
  const Vocabulary& v_;
  Report report_;
  std::vector<Id> open_;  // shapes that are being parsed, each inside the one before

  std::vector<std::shared_ptr<const CustomComponent>> custom_;
};

}  // namespace sinew::rdf::shacl
