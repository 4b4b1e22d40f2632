#include "sinew/rdf/shacl/validation.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/rdf/shacl/validator.h"

namespace sinew::rdf::shacl {
namespace {

Error failure(std::string iri, std::string what, std::string remedy) {
  Problem problem;
  problem.iri = std::move(iri);
  problem.what = std::move(what);
  problem.remedy = std::move(remedy);
  return Error(std::move(problem));
}

void check_constraint(Check& check) {
  switch (check.constraint.component) {
    case Component::kMinCount:
    case Component::kMaxCount:
    case Component::kUniqueLang:
    case Component::kEquals:
    case Component::kDisjoint:
    case Component::kLessThan:
    case Component::kLessThanOrEquals:
    case Component::kClosed:
    case Component::kHasValue:
      return check_set(check);
    case Component::kNot:
    case Component::kAnd:
    case Component::kOr:
    case Component::kXone:
    case Component::kNode:
    case Component::kProperty:
    case Component::kQualifiedMinCount:
    case Component::kQualifiedMaxCount:
      return check_shapes(check);
    case Component::kSparql:
    case Component::kCustom:
      return check_sparql(check);
    default:
      return check_value(check);
  }
}

}  // namespace

ValidationReport validate(const Shapes& shapes, const GraphReader& data,
                          const ValidationOptions& options) {
  Validator validator(shapes, data, options);
  for (const Shape& shape : shapes.shapes) {
    if (shape.has_target() && !shape.deactivated) validator.validate_targets(shape);
  }
  return {validator.take()};
}

ValidationReport validate_node(const Shapes& shapes, Id shape, Id focus_node,
                               const GraphReader& data, const ValidationOptions& options) {
  const auto found = shapes.by_node.find(shape);
  if (found == shapes.by_node.end()) {
    throw failure(std::string(data.terms().text(shape)), "this is no shape that is known",
                  "declare it as sh:NodeShape or sh:PropertyShape in the shapes graph");
  }
  Validator validator(shapes, data, options);
  ValidationReport report;
  validator.validate(shapes.shapes[found->second], focus_node, &report.results);
  return report;
}

// ---- Validator ----

void Validator::validate_targets(const Shape& shape) {
  for (const Id focus_node : focus_nodes(shape)) validate(shape, focus_node, &results_);
}

std::vector<Id> Validator::focus_nodes(const Shape& shape) {
  std::vector<Id> nodes;
  std::unordered_set<Id> seen;
  const auto add = [&](Id node) {
    if (seen.insert(node).second) nodes.push_back(node);
    return true;
  };
  for (const Id node : shape.target_nodes) add(node);
  for (const Id target : shape.target_classes) {
    for (const Id type : classes_below(target)) {
      data_.match({}, vocabulary().rdf_type, type,
                  [&](const graph::Quad& quad) { return add(quad.subject); });
    }
  }
  for (const Id predicate : shape.target_subjects_of) {
    data_.match({}, predicate, {}, [&](const graph::Quad& quad) { return add(quad.subject); });
  }
  for (const Id predicate : shape.target_objects_of) {
    data_.match({}, predicate, {}, [&](const graph::Quad& quad) { return add(quad.object); });
  }
  // By id, so that the report does not depend on the order of sets of classes.
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

bool Validator::validate(const Shape& shape, Id focus_node, std::vector<Result>* results) {
  if (shape.deactivated) return true;
  if (depth_ == kMaxValidationDepth) {
    throw failure(name(focus_node),
                  fmt::format("shapes were followed through the data to a depth of {}, last {}",
                              kMaxValidationDepth, name(shape.node)),
                  "make the shapes less recursive, for example by a path with sh:zeroOrMorePath");
  }
  if (shape.recursive) {
    const std::pair<const Shape*, Id> here(&shape, focus_node);
    if (std::find(under_way_.begin(), under_way_.end(), here) != under_way_.end()) {
      throw failure(name(focus_node),
                    fmt::format("whether it conforms to {} depends on itself", name(shape.node)),
                    "shapes may refer to themselves only where the data has no cycle");
    }
    under_way_.push_back(here);
  }
  ++depth_;

  std::vector<Id> values;
  if (shape.path) {
    values = nodes_at(*shape.path, focus_node, data_);
  } else {
    values.push_back(focus_node);
  }
  bool conforms = true;
  for (const Constraint& constraint : shape.constraints) {
    Check check(*this, shape, constraint, focus_node, values, results);
    check_constraint(check);
    conforms = conforms && !check.failed();
    if (check.done()) break;
  }

  --depth_;
  if (shape.recursive) under_way_.pop_back();
  if (results && results->size() > options_.max_results) {
    throw failure(name(shape.node), fmt::format("more than {} results", options_.max_results),
                  "mend some of the data first, or raise the limit");
  }
  return conforms;
}

const std::unordered_set<Id>& Validator::classes_below(Id super_class) {
  const auto known = classes_below_.find(super_class);
  if (known != classes_below_.end()) return known->second;
  std::unordered_set<Id> classes = {super_class};
  std::vector<Id> waiting = {super_class};
  while (!waiting.empty()) {
    const Id above = waiting.back();
    waiting.pop_back();
    data_.match({}, vocabulary().rdfs_sub_class_of, above, [&](const graph::Quad& quad) {
      if (classes.insert(quad.subject).second) waiting.push_back(quad.subject);
      return true;
    });
  }
  return classes_below_.emplace(super_class, std::move(classes)).first->second;
}

bool Validator::is_instance(Id node, Id of_class) {
  const auto& classes = classes_below(of_class);
  return !data_.match(node, vocabulary().rdf_type, {},
                      [&](const graph::Quad& quad) { return !classes.contains(quad.object); });
}

std::string Validator::name(Id id) const {
  return terms().is_iri(id) ? fmt::format("<{}>", terms().text(id)) : terms().to_string(id);
}

// ---- Check ----

Result* Check::violation(Id value, std::string what, std::string remedy) {
  failed_ = true;
  if (!results) return nullptr;
  Result& result = results->emplace_back();
  result.focus_node = focus_node;
  result.path = shape.path;
  result.value = value;
  result.source_shape = shape.node;
  result.component = constraint.component;
  result.component_iri = constraint.component_iri;
  result.severity = shape.severity;
  result.messages = shape.messages;
  result.what = std::move(what);
  result.remedy = std::move(remedy);
  return &result;
}

}  // namespace sinew::rdf::shacl
