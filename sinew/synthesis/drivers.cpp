#include "sinew/synthesis/drivers.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/synthesis/asked.h"
#include "sinew/synthesis/control.h"
#include "sinew/synthesis/coordinates.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/query_faults.h"

namespace sinew::synthesis {
namespace {

using algorithm::Role;

bool gives(const Query& query, std::string_view quantity) {
  return std::any_of(query.given.begin(), query.given.end(),
                     [&](const Given& given) { return given.quantity == quantity; });
}

void check(const Query& query, Report& report) {
  const auto refuse = [&](const Given& given, std::string about, std::string what,
                          std::string remedy) {
    report.add(fault_in(query, given.origin, std::move(about), std::move(what), std::move(remedy)));
  };
  for (std::size_t i = 0; i < query.given.size(); ++i) {
    const Given& given = query.given[i];
    const GivenQuantity* row = find_given(given.quantity);
    if (row == nullptr) {
      std::string known;
      for (const GivenQuantity& one : given_quantities())
        known += (known.empty() ? "" : ", ") + std::string(one.name);
      refuse(given, "", fmt::format("there is no driver {}", given.quantity), "one of " + known);
      continue;
    }
    if (row->element == Element::kJoint && !given.of.empty() && given.of != kEveryJoint)
      refuse(given, given.of, fmt::format("{} is given for one joint alone", given.quantity),
             "give it for " + std::string(kEveryJoint));
    if (given.varies && given.quantity != "gravity")
      refuse(given, given.of, fmt::format("{} that varies", given.quantity),
             "only gravity can be stated to vary; every other driver does anyway");
    for (std::size_t j = 0; j < i; ++j)
      if (query.given[j].quantity == given.quantity && row->element != Element::kFrame)
        refuse(given, given.of, fmt::format("{} is given twice", given.quantity), "give it once");
  }
  for (const Given& force : query.given)
    for (const Given& acceleration : query.given) {
      if (force.quantity != "joint-force" || acceleration.quantity != "joint-acceleration" ||
          force.of != acceleration.of)
        continue;
      const bool all = force.of.empty() || force.of == kEveryJoint;
      refuse(acceleration, all ? "" : force.of,
             fmt::format("both the force and the acceleration of {} are given: they "
                         "contradict each other",
                         all ? "every joint" : "this joint"),
             "give one of them; the other can be asked");
    }
}

// Seen from an observer in free fall, a root at rest accelerates against gravity.
algorithm::BlockSpec base_acceleration(const Context& context) {
  return {.slot = "base-acceleration",
          .represents = context.robot.root_frame,
          .quantity = "acceleration-twist",
          .of = context.robot.root_body,
          .wrt = context.reference,
          .reference = context.robot.root_frame,
          .seen_by = context.robot.root_frame};
}

void make_gravity(Context& context) {
  const std::array<double, 6> value = {
      0, 0, 0, -context.gravity[0], -context.gravity[1], -context.gravity[2]};
  algorithm::BlockSpec spec = base_acceleration(context);
  spec.role = Role::kConstant;
  spec.value = value;
  context.make(spec);
}

// The same from an input. What falls freely is the reference of all motion.
void make_varying_gravity(Context& context) {
  context.make({.slot = "gravity",
                .represents = context.robot.root_frame,
                .quantity = "linear-acceleration",
                .of = context.reference,
                .wrt = context.robot.root_body,
                .seen_by = context.robot.root_frame,
                .role = Role::kInput,
                .label = algorithm::kWholeRobot});
  context.make(base_acceleration(context));
}

void make_wrenches(Context& context) {
  for (const ExternalWrench& one : context.wrenches) {
    algorithm::BlockSpec spec = {
        .slot = "wrench",
        .represents = one.frame,
        .quantity = "wrench",
        .of = one.body,
        .reference = one.frame,
        .seen_by = one.seen_from_base ? context.robot.root_frame : one.frame,
        .role = Role::kInput,
        .label = one.label};
    context.make(spec);
  }
}

// First all directions that are inputs, then the setpoints of all directions.
void make_constraints(Context& context) {
  const MotionDrivers& drivers = context.drivers;
  for (const ConstraintDirection& direction : drivers.directions) {
    const AccelerationConstraint& constraint = drivers.constraints[direction.constraint];
    algorithm::BlockSpec spec = {
        .slot = "constraint-direction",
        .represents = direction.element,
        .quantity = "wrench",
        .of = constraint.at.body,
        .reference = constraint.at.frame,
        .seen_by = constraint.seen_by_itself ? constraint.at.frame : context.robot.root_frame,
        .role = direction.unit_force ? Role::kConstant : Role::kInput,
        .label = direction.label};
    if (direction.unit_force) spec.value = *direction.unit_force;
    context.make(spec);
  }
  for (const ConstraintDirection& direction : drivers.directions)
    context.make(
        {.slot = "acceleration-energy",
         .represents = direction.element,
         .quantity = "acceleration-energy",
         .role = energy_of(context.control, drivers, direction) ? Role::kInternal : Role::kInput,
         .label = direction.label});
}

void make_weights(Context& context) {
  for (std::size_t i = 0; i < context.drivers.groups.size(); ++i) {
    if (!context.drivers.weighed || i == context.drivers.limited) continue;
    const DriverGroup& group = context.drivers.groups[i];
    context.make({.slot = "driver-weight",
                  .represents = group.element,
                  .quantity = "magnitude",
                  .role = Role::kInput,
                  .label = group.label});
  }
}

}  // namespace

algorithm::BlockSpec joint_quantity(std::string_view slot, const RobotJoint& joint) {
  const bool pose = slot == "position";
  return {.slot = slot,
          .represents = joint.joint,
          .quantity = joint_quantity_name(joint.kind, slot),
          .of = pose ? joint.frame : joint.successor,
          .wrt = pose ? joint.joint_frame : joint.predecessor,
          .seen_by = joint.frame,
          .prismatic = joint.kind == "prismatic",
          .label = joint.label};
}

std::vector<std::string> given_slots(const Query& query) {
  std::vector<std::string> slots;
  for (const Given& given : query.given)
    if (const GivenQuantity* row = find_given(given.quantity))
      slots.emplace_back(given.varies ? "gravity" : row->slot);
  return slots;
}

bool gravity_varies(const Query& query) {
  return std::any_of(query.given.begin(), query.given.end(), [](const Given& given) {
    return given.quantity == "gravity" && given.varies;
  });
}

void make_drivers(Context& context, Report& report) {
  check(context.query, report);
  for (const GivenQuantity& row : given_quantities()) {
    if (!gives(context.query, row.name)) continue;
    if (row.element == Element::kJoint)
      make_coordinate_inputs(context, row.slot);
    else if (row.name == "external-wrench")
      make_wrenches(context);
    else if (row.name == "acceleration-constraint")
      make_constraints(context);
    else if (gravity_varies(context.query))
      make_varying_gravity(context);
    else
      make_gravity(context);
  }
  make_weights(context);
}

}  // namespace sinew::synthesis
