#include "sinew/synthesis/coordinates.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/base/error.h"
#include "sinew/synthesis/coordinate_parts.h"
#include "sinew/synthesis/drivers.h"

namespace sinew::synthesis {
namespace {

using algorithm::BlockSpec;
using algorithm::Role;

// A joint of the tree from the numbers of the model's joint that it is a part of.
void take_parts(Context& context, const Coordinate& coordinate, std::string_view slot,
                BlockIndex numbers) {
  for (std::size_t k = 0; k < coordinate.parts.size(); ++k) {
    const RobotJoint& part = context.robot.joints[coordinate.parts[k]];
    BlockSpec target = joint_quantity(slot, part);
    std::vector<double> factors(coordinate.parts.size(), 0.0);
    factors[k] = 1;
    const BlockIndex map = make_map(context, target, factors, 0);
    context.closure(std::string(slot) + "-of-part", {numbers, map, context.make(target)},
                    part.joint);
  }
}

void lead(Context& context, std::size_t leader, std::string_view slot) {
  const auto& joints = context.robot.joints;
  for (const std::size_t k : followers(context.robot, leader)) {
    BlockSpec target = joint_quantity(slot, joints[k]);
    const double factor[] = {joints[k].ratio};
    const BlockIndex map =
        make_map(context, target, factor, slot == "position" ? joints[k].offset : 0);
    context.closure(std::string(slot) + "-from-leader",
                    {context.block(slot, joints[leader].joint), map, context.make(target)},
                    joints[k].joint);
  }
}

// Calls take(joint, target, map) for each joint of the tree that follows none.
template <typename Take>
void for_each_number(Context& context, std::string_view what, Take take) {
  const auto& joints = context.robot.joints;
  std::size_t width = 0, at = 0;
  for (const Coordinate& coordinate : coordinates(context.robot))
    for (const std::size_t part : coordinate.parts)
      width += joints[part].kind == "floating" ? 6 : 1;
  for (const Coordinate& coordinate : coordinates(context.robot)) {
    for (const std::size_t part : coordinate.parts) {
      std::vector<double> factors(width, 0.0);
      factors[at] = 1;
      at += joints[part].kind == "floating" ? 6 : 1;
      const BlockIndex map = make_map(context, joint_quantity(what, joints[part]), factors, 0);
      take(part, map);
    }
  }
}

std::string part_operator(std::string_view what, const RobotJoint& joint) {
  const std::string name(what);
  return joint.kind == "floating" ? "floating-" + name + "-of-robot" : name + "-of-part";
}

}  // namespace

void take_all(Context& context, std::string_view slot, BlockIndex numbers) {
  const AsCoordinateStep step(context);
  for_each_number(context, slot, [&](std::size_t part, BlockIndex map) {
    const RobotJoint& joint = context.robot.joints[part];
    const BlockIndex target = context.make(joint_quantity(slot, joint));
    context.closure(part_operator(slot, joint), {numbers, map, target}, joint.joint);
    lead(context, part, slot);
  });
}

void take_all_of(Context& context, std::string_view slot, std::string_view what, BlockIndex numbers,
                 Id effect, std::string_view label) {
  const AsCoordinateStep step(context);
  for_each_number(context, what, [&](std::size_t part, BlockIndex map) {
    const RobotJoint& joint = context.robot.joints[part];
    const std::string name =
        std::string(label) + "." +
        std::string(joint.label.empty()
                        ? algorithm::short_name(context.view.terms().text(joint.joint))
                        : std::string_view(joint.label));
    BlockSpec target = joint_quantity(what, joint);
    target.slot = slot;
    target.represents = context.pair(effect, joint.joint);
    target.label = name;
    context.closure(part_operator(what, joint), {numbers, map, context.make(target)}, joint.joint);
  });
}

std::vector<Coordinate> coordinates(const Robot& robot) {
  std::vector<Coordinate> list;
  for (std::size_t k = 0; k < robot.joints.size(); ++k) {
    const RobotJoint& joint = robot.joints[k];
    if (joint.follows >= 0) continue;
    if (joint.compound < 0) {
      list.push_back({joint.joint, -1, {k}});
      continue;
    }
    const Id whole = robot.compounds[static_cast<std::size_t>(joint.compound)].joint;
    if (list.empty() || list.back().joint != whole) list.push_back({whole, joint.compound, {}});
    list.back().parts.push_back(k);
  }
  return list;
}

std::vector<Id> followers_of_the_model(const Robot& robot) {
  std::vector<Id> found;
  for (const RobotJoint& joint : robot.joints)
    if (joint.follows >= 0 && joint.compound < 0) found.push_back(joint.joint);
  for (const RobotCompound& compound : robot.compounds) {
    const bool all = std::all_of(compound.parts.begin(), compound.parts.end(),
                                 [&](std::size_t k) { return robot.joints[k].follows >= 0; });
    if (all) found.push_back(compound.joint);
  }
  return found;
}

bool is_named(const graph::View& view, Id node, std::string_view name) {
  const std::string_view iri = view.terms().text(node);
  return iri == name || algorithm::is_called(iri, name);
}

Coordinate find_coordinate(const graph::View& view, const Robot& robot, std::string_view name) {
  const auto named = [&](Id joint) { return is_named(view, joint, name); };
  const auto list = coordinates(robot);
  for (const Coordinate& coordinate : list)
    if (named(coordinate.joint)) return coordinate;
  for (const RobotJoint& joint : robot.joints) {
    if (joint.follows < 0 || !named(joint.joint)) continue;
    const Id leader = robot.joints[static_cast<std::size_t>(joint.follows)].joint;
    throw Error(Problem{
        {},
        std::string(view.terms().text(joint.joint)),
        fmt::format("it follows <{}> and has no numbers of its own", view.terms().text(leader)),
        "ask for the joint that it follows",
        {},
        {}});
  }
  std::string known;
  for (const Coordinate& coordinate : list)
    known += (known.empty() ? "" : ", ") +
             std::string(algorithm::short_name(view.terms().text(coordinate.joint)));
  throw Error(
      Problem{{}, std::string(name), "no moving joint has this name", "one of " + known, {}, {}});
}

void make_coordinate_inputs(Context& context, std::string_view slot) {
  const AsCoordinateStep step(context);
  const auto& joints = context.robot.joints;
  for (const Coordinate& coordinate : coordinates(context.robot)) {
    if (!in_scope(context, coordinate)) continue;
    if (const RobotCompound* compound = compound_of(context, coordinate)) {
      const BlockIndex numbers = make_numbers(context, coordinate, slot, slot, Role::kInput);
      // Each of a free joint's turns and slides is at zero; what has moved is all before them.
      if (compound->is_free() && slot != "force") continue;
      take_parts(context, coordinate, slot, numbers);
    } else {
      BlockSpec spec = joint_quantity(slot, joints[coordinate.parts.front()]);
      spec.role = Role::kInput;
      context.make(spec);
    }
    if (slot == "force") continue;  // those that follow are driven by their leader
    for (const std::size_t part : coordinate.parts) lead(context, part, slot);
  }
}

}  // namespace sinew::synthesis
