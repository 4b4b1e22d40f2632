// How many rows a pattern makes for each row that comes in, from the graph's live counters.
#include <algorithm>
#include <cmath>

#include "sinew/rdf/sparql/plan/planner_class.h"

namespace sinew::rdf::sparql::plan {
namespace {

// What is assumed of a predicate that has no triple yet: queries are often prepared before the data
// come.
constexpr double kUnknownTriples = 1000;
constexpr double kUnknownSubjects = 500;
constexpr double kUnknownObjects = 100;
// Of a variable predicate.
constexpr double kUnknownPredicates = 30;
// A filter of unknown effect, a row that comes from a table.
constexpr double kTableRows = 100;

}  // namespace

double Planner::triple_rows(const algebra::Triple& triple, const VariableSet& bound) const {
  const auto known = [&](algebra::Node node) { return !node.is_variable || bound.has(node.value); };
  const auto term = [&](algebra::Node node) {
    return node.is_variable ? graph::Id{} : graph::Id{node.value};
  };
  const graph::Id subject = term(triple.subject);
  const graph::Id predicate = term(triple.predicate);
  const graph::Id object = term(triple.object);
  double rows = static_cast<double>(view_.estimate(subject, predicate, object));
  double subjects = kUnknownSubjects;
  double objects = kUnknownObjects;
  if (predicate && view_.distinct_subjects(predicate) > 0) {
    subjects = static_cast<double>(view_.distinct_subjects(predicate));
    objects = static_cast<double>(std::max<std::size_t>(1, view_.distinct_objects(predicate)));
  } else if (!predicate) {
    const double size = static_cast<double>(std::max<std::size_t>(view_.size(), 1));
    subjects = std::max(1.0, size / 5);
    objects = std::max(1.0, size / 3);
  }
  if (rows == 0) {
    rows = kUnknownTriples;
    if (subject) rows /= kUnknownSubjects;
    if (object) rows /= kUnknownObjects;
  }
  if (!subject && known(triple.subject)) rows /= subjects;
  if (!object && known(triple.object)) rows /= objects;
  if (!predicate && known(triple.predicate)) rows /= kUnknownPredicates;
  return rows;
}

double Planner::path_rows(const algebra::Triple& triple, const VariableSet& bound) const {
  const bool from = !triple.subject.is_variable || bound.has(triple.subject.value);
  const bool to = !triple.object.is_variable || bound.has(triple.object.value);
  const double size = static_cast<double>(std::max<std::size_t>(view_.size(), 100));
  if (from && to) return 0.5;
  if (from || to) return std::sqrt(size);
  return size * 10;
}

double Planner::pattern_rows(const Pattern& pattern, const VariableSet& bound) const {
  using Kind = Pattern::Kind;
  switch (pattern.kind) {
    case Kind::kTriples: {
      double rows = 1;
      VariableSet now = bound;
      for (const algebra::Triple& triple : pattern.triples) {
        rows *= triple.path ? path_rows(triple, now) : triple_rows(triple, now);
        for (const algebra::Node node : {triple.subject, triple.predicate, triple.object}) {
          if (node.is_variable) now.add(node.value);
        }
      }
      return rows;
    }
    case Kind::kJoin: {
      double rows = 1;
      VariableSet now = bound;
      for (const Pattern& part : pattern.parts) {
        rows *= pattern_rows(part, now);
        now.add(part.certain);
      }
      return rows;
    }
    case Kind::kUnion: {
      double rows = 0;
      for (const Pattern& part : pattern.parts) rows += pattern_rows(part, bound);
      return rows;
    }
    case Kind::kValues:
      return static_cast<double>(pattern.value_rows.size());
    case Kind::kSelect:
      return pattern_rows(pattern.select->where, bound);
    case Kind::kService:
      return 1;
    default:
      return pattern_rows(pattern.parts[0], bound);
  }
}

double Planner::cost(const Item& item, const Context& context) {
  switch (item.kind) {
    case Item::Kind::kTriple:
      return triple_rows(item.triple, context.bound);
    case Item::Kind::kPath:
      return path_rows(item.triple, context.bound);
    case Item::Kind::kValues:
    case Item::Kind::kUnion:
      return pattern_rows(*item.pattern, context.bound);
    case Item::Kind::kScope:
      return 10 * pattern_rows(*item.pattern, context.bound);
    case Item::Kind::kTable:
      return item.certain.intersects(context.bound) ? 1 : kTableRows;
    default:
      return 1;
  }
}

}  // namespace sinew::rdf::sparql::plan
