#include "sinew/synthesis/effects.h"

#include "sinew/synthesis/block_specs.h"

namespace sinew::synthesis {

using algorithm::BlockSpec;
using algorithm::Role;

namespace {

std::string label_at(const Context& context, const Effect& effect, std::string_view label, Id at) {
  const std::string_view place =
      label.empty() ? algorithm::short_name(context.view.terms().text(at)) : label;
  return std::string(effect.label) + "." + std::string(place);
}

}  // namespace

std::vector<Effect> effects(const Context& context) {
  std::vector<Effect> list;
  for (const DriverGroup& group : context.drivers.groups)
    list.push_back({group.element, group.label, &group});
  for (const ConstraintDirection& direction : context.drivers.directions)
    list.push_back({direction.element, direction.label, nullptr});
  return list;
}

BlockIndex effect_block(Context& context, std::string_view slot, Id effect, Id at) {
  return context.board.find(slot, context.pair(effect, at));
}

BlockIndex make_joint_effect(Context& context, const JointEdge& edge, const Effect& effect,
                             std::string_view slot, std::string_view what) {
  const std::string label = label_at(context, effect, edge.label, edge.joint);
  BlockSpec spec = edge.coordinate(slot, what);
  spec.represents = context.pair(effect.element, edge.joint);
  spec.label = label;
  return context.make(spec);
}

BlockIndex make_effect_wrench(Context& context, const Effect& effect, std::string_view slot, Id at,
                              Id of, Id frame) {
  const std::string label = label_at(context, effect, "", at);
  return context.make({.slot = slot,
                       .represents = context.pair(effect.element, at),
                       .quantity = "wrench",
                       .of = of,
                       .reference = frame,
                       .seen_by = frame,
                       .label = label});
}

BlockIndex no_wrench(Context& context, Id frame, Id body) {
  return context.make(zero(at_frame("no-wrench", "wrench", frame, body, frame)));
}

BlockIndex no_force(Context& context, const JointEdge& edge) {
  return context.make(zero(edge.coordinate("no-joint-force", "force")));
}

BlockIndex no_energy(Context& context) {
  return context.make(zero({.slot = "no-acceleration-energy",
                            .represents = context.robot.root_body,
                            .quantity = "acceleration-energy",
                            .label = algorithm::kWholeRobot}));
}

BlockIndex times(Context& context, double number) {
  const double value[] = {number};
  return context.make({.slot = number == 0 ? "zero-times" : "once",
                       .represents = context.robot.root_body,
                       .quantity = "magnitude",
                       .role = Role::kConstant,
                       .value = value,
                       .label = algorithm::kWholeRobot});
}

BlockIndex driver_weight(Context& context, const DriverGroup& group) {
  const MotionDrivers& drivers = context.drivers;
  if (drivers.limited != kNoDriver && &drivers.groups[drivers.limited] == &group)
    return context.block("driver-scale", group.element);
  if (drivers.weighed) return context.block("driver-weight", group.element);
  return times(context, 1);
}

}  // namespace sinew::synthesis
