#include "sinew/synthesis/driver_list.h"

#include <fmt/format.h>

#include <algorithm>

namespace sinew::synthesis {

std::vector<Id> driver_elements(graph::Store& store, const Robot& robot, const Query& query,
                                const MotionDrivers& drivers, const Asked& asked, Element kind) {
  std::vector<Id> found;
  graph::Terms& terms = store.terms();
  const Id pair = terms.iri(algorithm::kPair);
  if (kind == Element::kConstraint)
    for (const ConstraintDirection& direction : drivers.directions)
      found.push_back(direction.element);
  if (kind == Element::kDriver)
    for (const DriverGroup& group : drivers.groups) found.push_back(group.element);
  if (kind == Element::kDriverJoint)
    for (const DriverGroup& group : drivers.groups)
      for (const RobotJoint& joint : robot.joints)
        if (joint.follows < 0) found.push_back(terms.derived(pair, {group.element, joint.joint}));
  if (kind == Element::kLimited && drivers.limited != kNoDriver)
    found.push_back(drivers.groups[drivers.limited].element);
  if (!found.empty()) return found;
  throw Error(Problem{{},
                      query.name,
                      fmt::format("{} is asked, but {}", asked.quantity,
                                  kind == Element::kLimited      ? "no driver is scaled down"
                                  : kind == Element::kConstraint ? "nothing is constrained"
                                                                 : "drivers are not kept apart"),
                      kind == Element::kLimited      ? "name it as limited"
                      : kind == Element::kConstraint ? "give an acceleration-constraint"
                                                     : "state drivers: apart",
                      {},
                      {}});
}

std::vector<Id> constrained_frames(const MotionDrivers& drivers) {
  std::vector<Id> frames;
  for (const AccelerationConstraint& constraint : drivers.constraints)
    if (std::find(frames.begin(), frames.end(), constraint.at.frame) == frames.end())
      frames.push_back(constraint.at.frame);
  return frames;
}

void check_drivers_are_used(const MotionDrivers& drivers, const Plan& plan, Report& report) {
  for (const Sweep& sweep : plan.sweeps)
    for (const Step* step : sweep.steps)
      if (std::find(step->needs.begin(), step->needs.end(), "acceleration-energy") !=
          step->needs.end())
        return;
  for (const AccelerationConstraint& constraint : drivers.constraints)
    report.error({}, constraint.label,
                 "an acceleration constraint is given, but nothing that is asked depends on it",
                 "ask for joint-acceleration or control-force, or leave it out");
}

void write_driver_list(const Context& context, graph::Transaction& transaction) {
  if (!context.drivers.any) return;
  graph::Terms& terms = context.builder.terms();
  const Id algorithm = context.builder.algorithm().id;
  const auto sa = [&](std::string_view name) {
    return terms.iri(std::string(algorithm::kAlgorithmNamespace) + std::string(name));
  };
  const algorithm::Names& names = context.builder.names();
  const Id pair = terms.iri(algorithm::kPair);
  std::vector<Id> list;
  for (const DriverGroup& group : context.drivers.groups) {
    const Id node = group.element;
    const auto add = [&](Id property, Id object) {
      transaction.add({node, property, object, algorithm});
    };
    const auto add_effect = [&](std::string_view slot, Id element) {
      const BlockIndex block = context.board.find(slot, element);
      if (block != algorithm::kNoIndex) add(sa("effect"), context.builder.at(block).id);
    };
    add(names.type, sa("Driver"));
    add(sa("at-index"), terms.integer(static_cast<int>(list.size())));
    add(sa("origin"), group.origin);
    add(names.name, terms.literal(group.label));
    for (const RobotJoint& joint : context.robot.joints)
      for (const std::string_view slot : {"effect-force", "driver-acceleration"})
        add_effect(slot, terms.derived(pair, {node, joint.joint}));
    add_effect("effect-drive", node);
    for (const ConstraintDirection& direction : context.drivers.directions)
      add_effect("driver-magnitude", terms.derived(pair, {direction.element, node}));
    list.push_back(node);
  }
  transaction.add({algorithm, sa("drivers"),
                   algorithm::write_list(terms, transaction, names, algorithm, list), algorithm});
}

}  // namespace sinew::synthesis
