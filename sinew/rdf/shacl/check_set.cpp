// Components that look at all value nodes together, or at other properties of the focus node
// (sections 4.2, 4.4.5, 4.5, 4.8.1, 4.8.2).
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

#include "sinew/rdf/shacl/literals.h"
#include "sinew/rdf/shacl/validator.h"
#include "sinew/rdf/sparql/values/strings.h"

namespace sinew::rdf::shacl {
namespace {

bool contains(std::span<const Id> ids, Id id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

void unique_lang(Check& check) {
  const graph::Terms& terms = check.validator.terms();
  std::map<std::string, int> uses;
  for (const Id value : check.values) {
    const std::string_view language = terms.language(value);
    if (!language.empty()) ++uses[sparql::values::lower_case(language)];
  }
  for (const auto& [language, count] : uses) {
    if (count < 2) continue;
    check.violation({}, fmt::format("{} values have the language \"{}\"", count, language),
                    "each language may be used once");
    if (check.done()) return;
  }
}

void equals(Check& check, std::span<const Id> others, const std::string& other) {
  for (const Id value : check.values) {
    if (contains(others, value)) continue;
    check.violation(value, fmt::format("{} is no value of {}", check.validator.name(value), other),
                    "the two must have the same values");
    if (check.done()) return;
  }
  for (const Id value : others) {
    if (contains(check.values, value)) continue;
    check.violation(value,
                    fmt::format("{} is a value of {} alone", check.validator.name(value), other),
                    "the two must have the same values");
    if (check.done()) return;
  }
}

void disjoint(Check& check, std::span<const Id> others, const std::string& other) {
  for (const Id value : check.values) {
    if (!contains(others, value)) continue;
    check.violation(value,
                    fmt::format("{} is a value of {}, too", check.validator.name(value), other),
                    "the two must have no value in common");
    if (check.done()) return;
  }
}

// One result for each pair that is not in order, or that cannot be compared.
void less_than(Check& check, std::span<const Id> others, const std::string& other) {
  const bool or_equal = check.constraint.component == Component::kLessThanOrEquals;
  for (const Id value : check.values) {
    for (const Id bound : others) {
      const std::partial_ordering order = compare_values(value, bound, check.validator.values());
      if (order < 0 || (or_equal && order == 0)) continue;
      check.violation(
          value,
          fmt::format("{} is not less than{} {}, the value of {}", check.validator.name(value),
                      or_equal ? " or equal to" : "", check.validator.name(bound), other),
          "change one of the two");
      if (check.done()) return;
    }
  }
}

// Looks at the properties of each value node; only those that are listed are allowed.
void closed(Check& check) {
  const std::vector<Id>& allowed = check.constraint.values;  // sorted
  const graph::Terms& terms = check.validator.terms();
  for (const Id node : check.values) {
    if (terms.is_literal(node)) continue;
    check.validator.data().match(node, {}, {}, [&](const graph::Quad& quad) {
      if (std::binary_search(allowed.begin(), allowed.end(), quad.predicate)) return true;
      Result* result = check.violation(
          quad.object, fmt::format("it has the property <{}>", terms.text(quad.predicate)),
          "the shape is closed: remove it, or use one of the shape's properties");
      if (!result) return false;
      result->path = std::make_shared<Path>(Path::of(quad.predicate));
      return true;
    });
    if (check.done()) return;
  }
}

}  // namespace

void check_set(Check& check) {
  const Constraint& constraint = check.constraint;
  const std::size_t count = check.values.size();
  switch (constraint.component) {
    case Component::kMinCount:
      if (count < constraint.count) {
        check.violation({}, fmt::format("there are {} values", count),
                        fmt::format("at least {} are needed", constraint.count));
      }
      return;
    case Component::kMaxCount:
      if (count > constraint.count) {
        check.violation({}, fmt::format("there are {} values", count),
                        fmt::format("at most {} are allowed", constraint.count));
      }
      return;
    case Component::kUniqueLang:
      return unique_lang(check);
    case Component::kClosed:
      return closed(check);
    case Component::kHasValue:
      if (!contains(check.values, constraint.values[0])) {
        check.violation(
            {}, "a value is missing",
            fmt::format("one of them must be {}", check.validator.name(constraint.values[0])));
      }
      return;
    default:
      break;
  }
  const Id predicate = constraint.values[0];
  const auto others = check.validator.data().objects(check.focus_node, predicate);
  const std::string other = check.validator.name(predicate);
  switch (constraint.component) {
    case Component::kEquals:
      return equals(check, others, other);
    case Component::kDisjoint:
      return disjoint(check, others, other);
    default:
      return less_than(check, others, other);
  }
}

}  // namespace sinew::rdf::shacl
