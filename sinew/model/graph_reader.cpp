#include "sinew/model/graph_reader.h"

#include <fmt/format.h>

#include <cmath>

namespace sinew::model {
namespace {

constexpr std::string_view kUnitNamespace = "http://qudt.org/vocab/unit/";

}  // namespace

void GraphReader::error(Id node, Id property, std::string what, std::string remedy) {
  report_.error(places_.find(node, property), std::string(text(node)), std::move(what),
                std::move(remedy));
}

void GraphReader::warning(Id node, Id property, std::string what, std::string remedy) {
  report_.warning(places_.find(node, property), std::string(text(node)), std::move(what),
                  std::move(remedy));
}

std::vector<Id> GraphReader::all(Id type) const {
  std::vector<Id> nodes;
  view.match({}, ids.type, type, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
    nodes.push_back(quad.subject);
    return true;
  });
  return nodes;
}

std::vector<Id> GraphReader::objects(Id node, Id property) const {
  std::vector<Id> values;
  view.match(node, property, {}, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
    values.push_back(quad.object);
    return true;
  });
  return values;
}

std::optional<Id> GraphReader::one(Id node, Id property, std::string_view what) {
  const std::vector<Id> values = objects(node, property);
  if (values.size() == 1) return values.front();
  error(node, property,
        values.empty() ? fmt::format("{} is missing", what)
                       : fmt::format("{} is stated {} times", what, values.size()),
        fmt::format("state <{}> exactly once", text(property)));
  return std::nullopt;
}

Id GraphReader::at_most_one(Id node, Id property, std::string_view what) {
  if (!has(node, property)) return {};
  return one(node, property, what).value_or(Id{});
}

std::optional<double> GraphReader::number(Id node, Id property) {
  const auto value = one(node, property, fmt::format("the number <{}>", text(property)));
  if (!value) return std::nullopt;
  const auto number = view.terms().number(*value);
  if (number && std::isfinite(*number)) return number;
  error(node, property, fmt::format("{} is no finite number", view.terms().to_string(*value)),
        fmt::format("give <{}> a number", text(property)));
  return std::nullopt;
}

std::optional<Vector3> GraphReader::vector(Id node, Id x, Id y, Id z) {
  const auto vx = number(node, x), vy = number(node, y), vz = number(node, z);
  if (!vx || !vy || !vz) return std::nullopt;
  return Vector3{*vx, *vy, *vz};
}

std::optional<Vector3> GraphReader::list_of_three(Id node, Id property) {
  const auto head = one(node, property, fmt::format("the list <{}>", text(property)));
  if (!head) return std::nullopt;
  double values[3] = {};
  std::size_t count = 0;
  // A list that is longer than three is a fault wherever it ends.
  for (Id cell = *head; cell && cell != ids.nil; cell = view.object(cell, ids.rest)) {
    const auto value = view.terms().number(view.object(cell, ids.first));
    if (!value || !std::isfinite(*value) || count == 3) {
      count = 4;
      break;
    }
    values[count++] = *value;
  }
  if (count == 3) return Vector3{values[0], values[1], values[2]};
  error(node, property, fmt::format("<{}> is no list of three finite numbers", text(property)),
        "write three numbers, [x, y, z]");
  return std::nullopt;
}

std::optional<Matrix3> GraphReader::direction_cosines(Id node) {
  const auto x = list_of_three(node, ids.cosine_x), y = list_of_three(node, ids.cosine_y),
             z = list_of_three(node, ids.cosine_z);
  const auto scale = this->scale(node, dimension::kNone, "the direction cosines");
  if (!x || !y || !z || !scale) return std::nullopt;
  const Vector3 a = *scale * *x, b = *scale * *y, c = *scale * *z;
  return Matrix3{a.x, b.x, c.x, a.y, b.y, c.y, a.z, b.z, c.z};
}

const GraphReader::Unit& GraphReader::unit(Id node, Id iri) {
  const auto [found, fresh] = units_.try_emplace(iri);
  if (!fresh) return found->second;
  std::string_view name = text(iri);
  data::UnitProblem problem{fmt::format("<{}> is no QUDT unit", name),
                            fmt::format("name a unit of <{}>, such as M or RAD", kUnitNamespace)};
  if (name.starts_with(kUnitNamespace)) {
    name.remove_prefix(kUnitNamespace.size());
    if (const auto unit =
            data::UnitTable::shipped().find(name, &problem, data::UnitSpelling::kQudt)) {
      found->second = {unit->dimension, unit->scale};
      if (unit->offset == 0) return found->second;
      problem = {fmt::format("the unit {} has an offset", name), "use one that starts at zero"};
    }
  }
  error(node, ids.unit, problem.what, problem.remedy);
  found->second = {};
  return found->second;
}

std::optional<double> GraphReader::scale(Id node, const data::Dimension& dimension,
                                         std::string_view quantity) {
  const std::string needed = data::to_string(dimension);
  std::optional<double> scale;
  std::string stated;
  for (const Id iri : objects(node, ids.unit)) {
    const Unit& unit = this->unit(node, iri);
    if (unit.scale == 0) return std::nullopt;
    if (unit.dimension == dimension) {
      if (scale && *scale != unit.scale) {
        error(node, ids.unit, fmt::format("two units of dimension '{}' are stated", needed),
              fmt::format("state one unit for {}", quantity));
        return std::nullopt;
      }
      scale = unit.scale;
    }
    stated += fmt::format("{}<{}> ({})", stated.empty() ? "" : ", ", text(iri),
                          data::to_string(unit.dimension));
  }
  if (scale) return scale;
  error(node, ids.unit,
        stated.empty() ? fmt::format("{} has no unit", quantity)
                       : fmt::format("no stated unit fits {}, only {}", quantity, stated),
        fmt::format("state a unit of dimension '{}' for {}", needed, quantity));
  return std::nullopt;
}

}  // namespace sinew::model
