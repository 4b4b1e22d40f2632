// Components that ask whether values conform to other shapes (sections 4.6 and 4.7).
#include <fmt/format.h>

#include <algorithm>

#include "sinew/rdf/shacl/validator.h"

namespace sinew::rdf::shacl {
namespace {

std::size_t conforming(Check& check, Id value) {
  return static_cast<std::size_t>(
      std::count_if(check.constraint.shapes.begin(), check.constraint.shapes.end(),
                    [&](ShapeIndex shape) { return check.validator.conforms(shape, value); }));
}

void logic(Check& check) {
  const std::size_t shapes = check.constraint.shapes.size();
  for (const Id value : check.values) {
    std::string what, remedy;
    const auto matched = [&](auto&& test) {
      return test(check.constraint.shapes.begin(), check.constraint.shapes.end(),
                  [&](ShapeIndex shape) { return check.validator.conforms(shape, value); });
    };
    switch (check.constraint.component) {
      case Component::kNot:
        if (conforming(check, value) == 0) continue;
        remedy = fmt::format("it must not conform to {}",
                             check.validator.name(check.constraint.values[0]));
        break;
      case Component::kAnd:
        if (matched([](auto... a) { return std::all_of(a...); })) continue;
        remedy = fmt::format("it must conform to all {} shapes", shapes);
        break;
      case Component::kOr:
        if (matched([](auto... a) { return std::any_of(a...); })) continue;
        remedy = fmt::format("it must conform to at least one of {} shapes", shapes);
        break;
      default: {
        const std::size_t count = conforming(check, value);
        if (count == 1) continue;
        what = fmt::format("{} conforms to {} of {} shapes", check.validator.name(value), count,
                           shapes);
        remedy = "it must conform to exactly one";
        break;
      }
    }
    if (what.empty()) what = fmt::format("the value is {}", check.validator.name(value));
    check.violation(value, std::move(what), std::move(remedy));
    if (check.done()) return;
  }
}

void node(Check& check) {
  const Shape& other = check.validator.shapes().shapes[check.constraint.shapes[0]];
  for (const Id value : check.values) {
    std::vector<Result> details;
    if (check.validator.validate(other, value, check.results ? &details : nullptr)) continue;
    Result* result =
        check.violation(value, fmt::format("{} does not conform", check.validator.name(value)),
                        fmt::format("it must conform to {}", check.validator.name(other.node)));
    if (!result) return;
    result->details = std::move(details);
  }
}

// The results are those of the property shape itself.
void property(Check& check) {
  const Shape& other = check.validator.shapes().shapes[check.constraint.shapes[0]];
  for (const Id value : check.values) {
    if (!check.validator.validate(other, value, check.results)) check.fail();
    if (check.done()) return;
  }
}

void qualified(Check& check) {
  const Constraint& constraint = check.constraint;
  std::uint64_t count = 0;
  for (const Id value : check.values) {
    if (!check.validator.conforms(constraint.shapes[0], value)) continue;
    const bool excluded =
        std::any_of(constraint.siblings.begin(), constraint.siblings.end(),
                    [&](ShapeIndex shape) { return check.validator.conforms(shape, value); });
    if (!excluded) ++count;
  }
  const bool at_least = constraint.component == Component::kQualifiedMinCount;
  if (at_least ? count >= constraint.count : count <= constraint.count) return;
  check.violation(
      {}, fmt::format("{} values conform to {}", count, check.validator.name(constraint.values[1])),
      fmt::format("there must be at {} {}", at_least ? "least" : "most", constraint.count));
}

}  // namespace

void check_shapes(Check& check) {
  switch (check.constraint.component) {
    case Component::kNode:
      return node(check);
    case Component::kProperty:
      return property(check);
    case Component::kQualifiedMinCount:
    case Component::kQualifiedMaxCount:
      return qualified(check);
    default:
      return logic(check);
  }
}

}  // namespace sinew::rdf::shacl
