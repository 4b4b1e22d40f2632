// One validation under way; private to check_*.cpp and validation.cpp.
#pragma once

#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "sinew/rdf/shacl/validation.h"
#include "sinew/rdf/sparql/values/term_space.h"

namespace sinew::rdf::shacl {

class Validator {
 public:
  Validator(const Shapes& shapes, const GraphReader& data, const ValidationOptions& options)
      : shapes_(shapes), data_(data), options_(options) {
    values_.begin(data.terms(), 0);
  }

  void validate_targets(const Shape& shape);
  // Adds what is wrong to `results`. With null, only answers whether the node conforms, as soon as
  // that is known.
  bool validate(const Shape& shape, Id focus_node, std::vector<Result>* results);
  bool conforms(ShapeIndex shape, Id node) {
    return validate(shapes_.shapes[shape], node, nullptr);
  }

  const Shapes& shapes() const { return shapes_; }
  const Vocabulary& vocabulary() const { return shapes_.vocabulary; }
  const GraphReader& data() const { return data_; }
  const graph::Terms& terms() const { return data_.terms(); }
  const sparql::values::TermSpace& values() const { return values_; }  // for comparing
  bool is_instance(Id node, Id of_class);
  std::string name(Id id) const;  // short, for messages

  std::vector<Result> take() { return std::move(results_); }

 private:
  const std::unordered_set<Id>& classes_below(Id super_class);
  std::vector<Id> focus_nodes(const Shape& shape);

  const Shapes& shapes_;
  const GraphReader& data_;
  const ValidationOptions& options_;
  sparql::values::TermSpace values_;
  std::vector<Result> results_;
  std::unordered_map<Id, std::unordered_set<Id>> classes_below_;
  std::vector<std::pair<const Shape*, Id>> under_way_;  // of recursive shapes
  std::size_t depth_ = 0;
};

// One constraint of one shape, being checked for one focus node.
class Check {
 public:
  Check(Validator& validator, const Shape& shape, const Constraint& constraint, Id focus_node,
        std::span<const Id> values, std::vector<Result>* results)
      : validator(validator),
        shape(shape),
        constraint(constraint),
        focus_node(focus_node),
        values(values),
        results(results) {}

  // The violation, for the caller to complete; null when only conformance is asked.
  Result* violation(Id value, std::string what = {}, std::string remedy = {});
  void fail() { failed_ = true; }  // the results are there already
  bool failed() const { return failed_; }
  // Nothing more needs to be checked.
  bool done() const { return failed_ && !results; }

  Validator& validator;
  const Shape& shape;
  const Constraint& constraint;
  const Id focus_node;
  const std::span<const Id> values;  // value nodes
  std::vector<Result>* const results;

 private:
  bool failed_ = false;
};

// The checks of each group of components, in the files of the same names.
void check_value(Check& check);   // check_value.cpp: components that look at one value at a time
void check_set(Check& check);     // check_set.cpp: those that look at all values together
void check_shapes(Check& check);  // check_shapes.cpp: logic, sh:node, sh:property, qualified
void check_sparql(Check& check);  // check_sparql.cpp

}  // namespace sinew::rdf::shacl
