#include "sinew/synthesis/drivers.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/synthesis/asked.h"
#include "sinew/synthesis/joint_edge.h"

namespace sinew::synthesis {
namespace {

using algorithm::Role;

bool gives(const Query& query, std::string_view quantity) {
  return std::any_of(query.given.begin(), query.given.end(),
                     [&](const Given& given) { return given.quantity == quantity; });
}

void check(const Query& query, Report& report) {
  for (std::size_t i = 0; i < query.given.size(); ++i) {
    const Given& given = query.given[i];
    const GivenQuantity* row = find_given(given.quantity);
    if (row == nullptr) {
      std::string known;
      for (const GivenQuantity& one : given_quantities())
        known += (known.empty() ? "" : ", ") + std::string(one.name);
      report.error({}, "", fmt::format("there is no driver {}", given.quantity), "one of " + known);
      continue;
    }
    if (row->element == Element::kJoint && !given.of.empty() && given.of != kEveryJoint)
      report.error({}, given.of, fmt::format("{} is given for one joint alone", given.quantity),
                   "give it for " + std::string(kEveryJoint));
    for (std::size_t j = 0; j < i; ++j)
      if (query.given[j].quantity == given.quantity)
        report.error({}, given.of, fmt::format("{} is given twice", given.quantity),
                     "give it once");
  }
  if (gives(query, "joint-force") && gives(query, "joint-acceleration"))
    report.error({}, "",
                 "both the force and the acceleration of every joint are given: they contradict "
                 "each other",
                 "give one of them; the other can be asked");
}

void make_joint_inputs(Context& context, const GivenQuantity& row) {
  for (const RobotJoint& joint : context.robot.joints) {
    if (!context.scope.empty() && !context.scope.contains(joint.frame)) continue;
    algorithm::BlockSpec spec = joint_quantity(row.slot, joint);
    spec.role = Role::kInput;
    context.make(spec);
  }
}

// Seen from an observer in free fall, a root at rest accelerates against gravity.
void make_gravity(Context& context) {
  const std::array<double, 6> value = {
      0, 0, 0, -context.gravity[0], -context.gravity[1], -context.gravity[2]};
  context.make({.slot = "base-acceleration",
                .represents = context.robot.root_frame,
                .quantity = "acceleration-twist",
                .of = context.robot.root_body,
                .wrt = context.reference,
                .reference = context.robot.root_frame,
                .seen_by = context.robot.root_frame,
                .role = Role::kConstant,
                .value = value});
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
    if (const GivenQuantity* row = find_given(given.quantity)) slots.emplace_back(row->slot);
  return slots;
}

void make_drivers(Context& context, Report& report) {
  check(context.query, report);
  for (const GivenQuantity& row : given_quantities()) {
    if (!gives(context.query, row.name)) continue;
    if (row.element == Element::kJoint)
      make_joint_inputs(context, row);
    else if (row.name == "gravity")
      make_gravity(context);
  }
}

}  // namespace sinew::synthesis
