// The parameters of constraint components (section 4), by the forms that the table of components
// names.
#include <fmt/format.h>

#include <algorithm>

#include "sinew/rdf/shacl/shape_parser.h"

namespace sinew::rdf::shacl {

void ShapeParser::constraints(Id node, Shape& shape) {
  for (const ComponentRow& row : components()) {
    const Id parameter = terms().find_iri(fmt::format("{}{}", kSh, row.parameter));
    if (!parameter) continue;
    const auto values = in_.objects(node, parameter);
    if (values.empty()) continue;
    if (row.property_shapes_only && !shape.path) {
      fault(node, parameter, fmt::format("a node shape with sh:{}", row.parameter),
            "only property shapes, those with sh:path, may have it");
      continue;
    }
    constraint(node, shape, row, parameter, values);
  }
  custom_constraints(node, shape);
}

void ShapeParser::constraint(Id node, Shape& shape, const ComponentRow& row, Id parameter,
                             const std::vector<Id>& values) {
  const Id iri = store_.terms().iri(fmt::format("{}{}", kSh, row.name));
  const auto add = [&](Constraint constraint) {
    constraint.component = row.component;
    constraint.component_iri = iri;
    shape.constraints.push_back(std::move(constraint));
  };
  const auto is_single = [&] { return at_most_one(node, parameter, values); };
  const Id value = values[0];

  switch (row.form) {
    case ParameterForm::kEachIri:
      for (const Id each : values) {
        if (is_iri(node, parameter, each)) add({.component = {}, .values = {each}});
      }
      break;
    case ParameterForm::kOneIri:
      if (is_single() && is_iri(node, parameter, value)) add({.component = {}, .values = {value}});
      break;
    case ParameterForm::kNodeKind: {
      static constexpr std::string_view kKinds[] = {
          "BlankNode", "IRI", "Literal", "BlankNodeOrIRI", "BlankNodeOrLiteral", "IRIOrLiteral"};
      if (!is_single()) break;
      const std::string_view text = terms().text(value);
      const bool known = terms().is_iri(value) && text.starts_with(kSh) &&
                         std::find(std::begin(kKinds), std::end(kKinds), text.substr(kSh.size())) !=
                             std::end(kKinds);
      if (known) {
        add({.component = {}, .values = {value}});
      } else {
        fault(node, parameter, fmt::format("sh:nodeKind is {}", name(value)),
              "it must be sh:BlankNode, sh:IRI, sh:Literal, sh:BlankNodeOrIRI, "
              "sh:BlankNodeOrLiteral or sh:IRIOrLiteral");
      }
      break;
    }
    case ParameterForm::kCount:
      if (!is_single()) break;
      if (const auto number = count(node, parameter, value)) {
        add({.component = {}, .values = {value}, .count = *number});
      }
      break;
    case ParameterForm::kOneLiteral:
      if (!is_single()) break;
      if (terms().is_literal(value)) {
        add({.component = {}, .values = {value}});
      } else {
        fault(node, parameter, fmt::format("sh:{} is {}", row.parameter, name(value)),
              "it must be a literal");
      }
      break;
    case ParameterForm::kPattern:
      if (!is_single()) break;
      if (auto compiled = pattern(node, value)) {
        add({.component = {}, .values = {value}, .pattern = std::move(compiled)});
      }
      break;
    case ParameterForm::kLanguageList: {
      if (!is_single()) break;
      const auto members = list(node, parameter, value);
      if (!members) break;
      Constraint constraint{.component = {}, .values = *members};
      for (const Id member : *members) {
        if (!is_string(node, parameter, member, false)) return;
        constraint.languages.emplace_back(terms().text(member));
      }
      add(std::move(constraint));
      break;
    }
    case ParameterForm::kFlag:
      if (is_single() && boolean(node, parameter, value).value_or(false)) add({.component = {}});
      break;
    case ParameterForm::kEachShape:
      for (const Id each : values) {
        const ShapeIndex index = this->shape(each);
        if (row.component == Component::kProperty && in_.objects(each, v_.path).empty()) {
          fault(node, parameter, fmt::format("sh:property is {}, which has no sh:path", name(each)),
                "a property shape has one sh:path");
        }
        if (row.component == Component::kNode && !in_.objects(each, v_.path).empty()) {
          fault(node, parameter, fmt::format("sh:node is {}, a property shape", name(each)),
                "use sh:property for it");
        }
        add({.component = {}, .values = {each}, .shapes = {index}});
      }
      break;
    case ParameterForm::kEachShapeList:
      for (const Id each : values) {
        const auto members = list(node, parameter, each);
        if (!members) continue;
        Constraint constraint{.component = {}};
        for (const Id member : *members) constraint.shapes.push_back(this->shape(member));
        add(std::move(constraint));
      }
      break;
    case ParameterForm::kQualified:
      qualified(node, shape, row, values);
      break;
    case ParameterForm::kClosed:
      if (!is_single()) break;
      if (const auto flag = boolean(node, parameter, value)) closed(node, shape, row, *flag);
      break;
    case ParameterForm::kEachValue:
      for (const Id each : values) add({.component = {}, .values = {each}});
      break;
    case ParameterForm::kOneList:
      if (!is_single()) break;
      if (auto members = list(node, parameter, value)) {
        add({.component = {}, .values = std::move(*members)});
      }
      break;
    case ParameterForm::kEachSparql:
      for (const Id each : values) sparql_constraint(node, shape, each);
      break;
  }
}

void ShapeParser::qualified(Id node, Shape& shape, const ComponentRow& row,
                            const std::vector<Id>& counts) {
  const Id parameter = terms().find_iri(fmt::format("{}{}", kSh, row.parameter));
  const auto value_shapes = in_.objects(node, v_.qualified_value_shape);
  // Without a shape to count there is no constraint (section 4.7.3), only a suspicion.
  if (value_shapes.empty()) {
    warn(node, parameter, fmt::format("sh:{} without sh:qualifiedValueShape", row.parameter),
         "say which values to count");
    return;
  }
  if (!shape.path) {
    fault(node, parameter, "a node shape with sh:qualifiedValueShape",
          "only property shapes, those with sh:path, may have it");
    return;
  }
  if (!at_most_one(node, parameter, counts) ||
      !at_most_one(node, v_.qualified_value_shape, value_shapes)) {
    return;
  }
  const auto number = count(node, parameter, counts[0]);
  if (!number) return;
  Constraint constraint{.component = row.component};
  constraint.component_iri = store_.terms().iri(fmt::format("{}{}", kSh, row.name));
  constraint.count = *number;
  constraint.values = {counts[0], value_shapes[0]};
  constraint.shapes = {this->shape(value_shapes[0])};
  const auto disjoint = in_.objects(node, v_.qualified_disjoint);
  if (at_most_one(node, v_.qualified_disjoint, disjoint) && !disjoint.empty() &&
      boolean(node, v_.qualified_disjoint, disjoint[0]).value_or(false)) {
    constraint.siblings = siblings(node, value_shapes[0]);
  }
  shape.constraints.push_back(std::move(constraint));
}

// The qualified value shapes of the property shapes that have a parent in common with `node`.
std::vector<ShapeIndex> ShapeParser::siblings(Id node, Id own) {
  std::vector<ShapeIndex> found;
  for (const Id parent : in_.subjects(v_.property, node)) {
    for (const Id sibling : in_.objects(parent, v_.property)) {
      for (const Id other : in_.objects(sibling, v_.qualified_value_shape)) {
        if (other == own) continue;
        const ShapeIndex index = shape(other);
        if (std::find(found.begin(), found.end(), index) == found.end()) found.push_back(index);
      }
    }
  }
  return found;
}

void ShapeParser::closed(Id node, Shape& shape, const ComponentRow& row, bool is_closed) {
  Constraint constraint{.component = row.component};
  constraint.component_iri = store_.terms().iri(fmt::format("{}{}", kSh, row.name));
  const auto ignored = in_.objects(node, v_.ignored_properties);
  if (!at_most_one(node, v_.ignored_properties, ignored)) return;
  if (!ignored.empty()) {
    const auto members = list(node, v_.ignored_properties, ignored[0]);
    if (!members) return;
    for (const Id member : *members) {
      if (!is_iri(node, v_.ignored_properties, member)) return;
    }
    constraint.values = *members;
  }
  for (const Id property : in_.objects(node, v_.property)) {
    for (const Id path : in_.objects(property, v_.path)) {
      if (terms().is_iri(path)) constraint.values.push_back(path);
    }
  }
  std::sort(constraint.values.begin(), constraint.values.end());
  if (is_closed) shape.constraints.push_back(std::move(constraint));
}

std::shared_ptr<const sparql::values::Regex> ShapeParser::pattern(Id node, Id text) {
  const auto flags = in_.objects(node, v_.flags);
  if (!is_string(node, v_.pattern, text, false) || !at_most_one(node, v_.flags, flags)) return {};
  if (!flags.empty() && !is_string(node, v_.flags, flags[0], false)) return {};
  std::string why;
  auto regex = sparql::values::Regex::compile(
      terms().text(text), flags.empty() ? std::string_view() : terms().text(flags[0]), &why);
  if (!regex) {
    fault(node, v_.pattern, fmt::format("sh:pattern {}: {}", name(text), why),
          "write a regular expression of XPath (flags i s m x q)");
  }
  return regex;
}

}  // namespace sinew::rdf::shacl
