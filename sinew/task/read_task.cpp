#include "sinew/task/read_task.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/data/units.h"
#include "sinew/task/reader.h"
#include "sinew/vocab/vocab.h"

namespace sinew::task {
namespace {

constexpr std::string_view kUnitNamespace = "http://qudt.org/vocab/unit/";

// There is no command that is safe for every robot, so it is stated.
void read_interface(Reader& reader, Id node) {
  RobotInterface robot;
  robot.id = node;
  robot.interface = reader.required(node, vocab::st::interface, "the interface");
  const Id safe = reader.number(node, vocab::st::safe_command, "the safe command");
  if (!robot.interface || !safe) return;
  const Quantity& quantity = reader.task.quantities.at(safe);
  if ((quantity.dimension != model::dimension::kTorque &&
       quantity.dimension != model::dimension::kForce) ||
      !quantity.value)
    reader.error(safe, "", "this is no command of a joint", "state a torque or a force");
  else
    robot.safe = *quantity.value;
  reader.task.robot_interface = robot;
}

}  // namespace

const Handler* Task::handler_of(Id element) const {
  for (const Handler& handler : handlers)
    for (const std::vector<Id>* list :
         {&handler.evaluators, &handler.monitors, &handler.controllers})
      if (std::find(list->begin(), list->end(), element) != list->end()) return &handler;
  return nullptr;
}

Id Reader::optional(Id node, std::string_view property) {
  const std::vector<Id> found = objects(node, property);
  if (found.size() > 1)
    error(node, property, fmt::format("has {} values of <{}>", found.size(), property),
          "state one");
  return found.empty() ? Id{} : found.front();
}

Id Reader::required(Id node, std::string_view property, std::string_view what) {
  return graph.one(node, iri(property), what).value_or(Id{});
}

bool Reader::read_quantity(Id node, std::string_view what) {
  if (task.quantities.contains(node)) return true;
  if (graph.view.terms().is_literal(node)) return false;
  Quantity quantity;
  quantity.id = node;
  const std::vector<Id> units = objects(node, vocab::qudt::unit);
  if (units.size() != 1) {
    error(node, vocab::qudt::unit,
          units.empty() ? fmt::format("{} states no unit", what)
                        : fmt::format("{} states {} units", what, units.size()),
          "state one by \"unit\"");
    return false;
  }
  std::string_view name = graph.text(units.front());
  data::UnitProblem problem{fmt::format("<{}> is no QUDT unit", name),
                            fmt::format("name a unit of <{}>", kUnitNamespace)};
  std::optional<data::Unit> unit;
  if (name.starts_with(kUnitNamespace))
    unit = data::UnitTable::shipped().find(name.substr(kUnitNamespace.size()), &problem,
                                           data::UnitSpelling::kQudt);
  if (unit && unit->offset != 0) {
    problem = {fmt::format("the unit {} has an offset", name), "use one that starts at zero"};
    unit.reset();
  }
  if (!unit) {
    error(node, vocab::qudt::unit, problem.what, problem.remedy);
    return false;
  }
  quantity.dimension = unit->dimension;
  quantity.unit = data::coherent_unit(unit->dimension);
  quantity.setpoint = is_a(node, vocab::st::Setpoint);
  if (const Id value = optional(node, vocab::qudt::value)) {
    const auto number = graph.view.terms().number(value);
    if (!number || !std::isfinite(*number)) {
      error(node, vocab::qudt::value, "its value is no finite number", "state a number");
      return false;
    }
    quantity.value = *number * unit->scale;
    // A number that is not zero does not become it by its unit.
    if (!has_good_size(*quantity.value) || (*quantity.value == 0 && *number != 0)) {
      error(node, vocab::qudt::value,
            fmt::format("its value is {:g} {}, neither zero nor from {:g} to {:g}", *quantity.value,
                        quantity.unit, kSmallestQuantity, kLargestQuantity),
            "check the number and its unit");
      return false;
    }
  }
  task.quantities.emplace(node, std::move(quantity));
  return true;
}

Id Reader::number(Id node, std::string_view property, std::string_view what) {
  const Id value = required(node, property, what);
  if (!value) return {};
  if (graph.view.terms().is_literal(value)) {
    error(node, property, fmt::format("{} is a number alone, without a unit", what),
          "make it a quantity: {\"@type\": \"Quantity\", \"unit\": ..., \"value\": ...}");
    return {};
  }
  return read_quantity(value, what) ? value : Id{};
}

Id Reader::optional_number(Id node, std::string_view property, std::string_view what) {
  return objects(node, property).empty() ? Id{} : number(node, property, what);
}

Task read_task(graph::Store& store, const graph::Places& places, Report& report) {
  Report found;
  Reader reader{model::GraphReader(store, places, found), store};
  read_constraints(reader);
  read_views(reader);
  read_monitors(reader);
  read_controllers(reader);
  read_handlers(reader);
  read_solver(reader);
  const std::vector<Id> interfaces = reader.graph.all(reader.iri(vocab::st::RobotInterface));
  if (interfaces.size() > 1)
    reader.error(interfaces[1], "", "a second robot interface", "name one for one algorithm");
  if (!interfaces.empty()) read_interface(reader, interfaces.front());
  if (!found.has_errors()) check_task(reader);
  for (const Problem& problem : found.problems()) report.add(problem);
  return std::move(reader.task);
}

}  // namespace sinew::task
