#include "sinew/synthesis/results.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/synthesis/coordinate_parts.h"
#include "sinew/synthesis/drivers.h"
#include "sinew/synthesis/free_joint.h"

namespace sinew::synthesis {
namespace {

using algorithm::BlockSpec;
using algorithm::Role;

// A force on a joint and on those that follow it, where there is one; `element(k)` is what it
// belongs to of joint k.
template <typename Element>
BlockIndex add_coupled(Context& context, std::string_view slot, std::size_t part,
                       Element&& element) {
  const auto& joints = context.robot.joints;
  std::vector<BlockIndex> blocks;
  std::vector<double> factors;
  const auto add = [&](std::size_t k, double factor) {
    const BlockIndex block = context.board.find(slot, element(k));
    if (block == algorithm::kNoIndex) return;
    blocks.push_back(block);
    factors.push_back(factor);
  };
  add(part, 1);
  for (const std::size_t k : followers(context.robot, part)) add(k, joints[k].ratio);
  if (blocks.empty()) return context.block(slot, element(part));
  if (blocks.size() == 1 && factors.front() == 1) return blocks.front();
  const std::string own_slot = "coupled-" + std::string(slot);
  BlockSpec target = joint_quantity("force", joints[part]);
  target.slot = own_slot;
  target.represents = element(part);
  const auto count = static_cast<std::uint32_t>(blocks.size());
  blocks.push_back(make_map(context, target, factors, 0));
  blocks.push_back(context.make(target));
  const BlockIndex made = blocks.back();
  context.closure_with_counts("force-of-coupled", std::move(blocks), {count, 1, 1},
                              joints[part].joint);
  return made;
}

}  // namespace

BlockIndex coupled_force(Context& context, std::string_view slot, std::size_t part) {
  const AsCoordinateStep step(context);
  return add_coupled(context, slot, part,
                     [&](std::size_t k) { return context.robot.joints[k].joint; });
}

BlockIndex coupled_effect(Context& context, std::string_view slot, Id effect, std::size_t part) {
  const AsCoordinateStep step(context);
  const auto element = [&](std::size_t k) {
    return context.pair(effect, context.robot.joints[k].joint);
  };
  bool reaches = context.board.find(slot, element(part)) != algorithm::kNoIndex;
  for (const std::size_t k : followers(context.robot, part))
    reaches |= context.board.find(slot, element(k)) != algorithm::kNoIndex;
  return reaches ? add_coupled(context, slot, part, element) : algorithm::kNoIndex;
}

namespace {

// The share that a wrench from outside has in a coordinate's force. `pair` stands for the joint and
// the frame on which the wrench acts.
BlockIndex coupled_share(Context& context, Id pair) {
  const AsCoordinateStep step(context);
  const auto& joints = context.robot.joints;
  for (std::size_t part = 0; part < joints.size(); ++part)
    for (const ExternalWrench& one : context.wrenches)
      if (context.pair(joints[part].joint, one.frame) == pair) {
        const BlockIndex share = add_coupled(context, "force-share", part, [&](std::size_t k) {
          return context.pair(joints[k].joint, one.frame);
        });
        if (share != context.board.find("force-share", pair))
          context.builder.rename(
              share,
              fmt::format("force-share.{}.{}",
                          algorithm::short_name(context.view.terms().text(joints[part].joint)),
                          one.label));
        return share;
      }
  return context.block("force-share", pair);
}

// Columns are joints of the tree where they matter; coordinates have fewer.
std::vector<double> coupling(const Context& context, bool with_rotors) {
  const auto& joints = context.robot.joints;
  std::vector<std::size_t> rows;  // joints, one entry for each number
  for (std::size_t k = 0; k < joints.size(); ++k)
    if (in_scope(context, joints[k]))
      rows.insert(rows.end(), joints[k].kind == "floating" ? 6 : 1, k);
  std::vector<std::size_t> columns;
  for (const Coordinate& coordinate : coordinates(context.robot))
    if (in_scope(context, coordinate))
      for (const std::size_t part : coordinate.parts)
        columns.insert(columns.end(), joints[part].kind == "floating" ? 6 : 1, part);
  std::vector<double> map = {static_cast<double>(rows.size()), static_cast<double>(columns.size())};
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const RobotJoint& row = joints[rows[r]];
    const auto leader = row.follows >= 0 ? static_cast<std::size_t>(row.follows) : rows[r];
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const bool same = columns[c] == leader && (row.kind != "floating" || r == c);
      map.push_back(same ? (row.follows >= 0 ? row.ratio : 1) : 0);
    }
  }
  if (with_rotors)
    for (const std::size_t k : rows) map.push_back(joints[k].rotor_inertia);
  return map;
}

std::string_view coupling_operator(std::string_view quantity) {
  for (const auto& [name, operation] :
       {std::pair<std::string_view, std::string_view>{"mass-matrix", "couple-mass-matrix"},
        {"jacobian", "couple-jacobian"},
        {"analytic-jacobian", "couple-analytic-jacobian"},
        {"linear-jacobian", "couple-linear-jacobian"},
        {"momentum-matrix", "couple-momentum-matrix"}})
    if (name == quantity) return operation;
  return {};
}

bool has_rotors(const Robot& robot) {
  return std::any_of(robot.joints.begin(), robot.joints.end(),
                     [](const RobotJoint& joint) { return joint.rotor_inertia != 0; });
}

}  // namespace

BlockIndex gathered(Context& context, std::string_view slot, Id joint) {
  const AsCoordinateStep step(context);
  const auto list = coordinates(context.robot);
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const Coordinate& one) { return one.joint == joint; });
  if (found == list.end()) {
    // Behind the last part of a joint that follows another; see below.
    for (const RobotCompound& compound : context.robot.compounds)
      if (compound.joint == joint)
        return context.block(slot, context.robot.joints[compound.parts.back()].joint);
    return context.block(slot, joint);
  }
  const BlockIndex first = context.block(slot, context.robot.joints[found->parts.front()].joint);
  const std::string_view quantity = context.builder.at(first).quantity->name;
  const bool force = quantity == "joint-force";
  const RobotCompound* compound = compound_of(context, *found);
  if (!force && quantity != "joint-acceleration") {
    // What a joint of several parts has only one of is behind the last of them.
    const std::size_t last = compound != nullptr ? compound->parts.back() : found->parts.back();
    return context.block(slot, context.robot.joints[last].joint);
  }
  if (compound == nullptr)
    return force ? coupled_force(context, slot, found->parts.front()) : first;
  if (!force && compound->is_free()) return whole_acceleration(context, *compound);
  std::vector<BlockIndex> blocks;
  for (const std::size_t part : found->parts)
    blocks.push_back(force ? coupled_force(context, slot, part)
                           : context.block(slot, context.robot.joints[part].joint));
  const BlockIndex made =
      make_numbers(context, *found, slot, force ? "force" : "acceleration", Role::kInternal);
  context.closure_of_many(force ? "join-joint-forces" : "join-joint-accelerations", blocks, {made},
                          joint);
  return made;
}

BlockIndex coupled_matrix(Context& context, BlockIndex matrix) {
  const algorithm::Block block = context.builder.at(matrix);
  const std::string_view operation = coupling_operator(block.quantity->name);
  const bool mass = block.quantity->name == "mass-matrix";
  if (operation.empty() || (!context.robot.coupled() && !(mass && has_rotors(context.robot))))
    return matrix;
  const AsCoordinateStep step(context);
  const std::vector<double> map = coupling(context, mass);
  const std::string slot = "coupled-" + block.slot, map_slot = "coupling-of-" + block.slot;
  BlockSpec spec = {.slot = map_slot,
                    .represents = block.represents,
                    .quantity = "coordinate-map",
                    .of = context.robot.root_body,
                    .wrt = context.robot.root_body,
                    .seen_by = context.robot.root_frame,
                    .role = Role::kConstant,
                    .size = static_cast<std::uint32_t>(map.size()),
                    .value = map};
  const BlockIndex map_block = context.make(spec);
  const auto rows = static_cast<std::uint32_t>(map[0]),
             columns = static_cast<std::uint32_t>(map[1]);
  const BlockIndex coupled =
      context.make({.slot = slot,
                    .represents = block.represents,
                    .quantity = block.quantity->name,
                    .of = block.symbols[0],
                    .wrt = block.symbols[1],
                    .reference = block.symbols[2],
                    .seen_by = block.symbols[3],
                    .size = mass ? columns * columns : block.size / rows * columns,
                    .label = mass ? algorithm::kWholeRobot : std::string_view()});
  context.closure_with_counts(operation, {matrix, map_block, coupled}, {1, 1, 1}, block.represents);
  return coupled;
}

void hand_out(Context& context, std::string_view slot, Id element, std::string_view name) {
  if (slot == "force-share" && context.robot.coupled()) {
    const BlockIndex alone = context.board.find(slot, element);
    if (alone != algorithm::kNoIndex)
      context.builder.rename(alone, "alone-" + context.builder.at(alone).name);
    const BlockIndex share = coupled_share(context, element);
    if (share == alone) context.builder.rename(share, context.builder.at(share).name.substr(6));
    context.builder.output(share);
    return;
  }
  const BlockIndex own = context.board.find(slot, element);
  const bool input = own != algorithm::kNoIndex && context.builder.at(own).role == Role::kInput;
  const BlockIndex result =
      input ? own
            : coupled_matrix(context, own != algorithm::kNoIndex && !context.robot.coupled()
                                          ? own
                                          : gathered(context, slot, element));
  if (own == algorithm::kNoIndex && name.empty() &&
      context.builder.at(result).represents != element)
    context.builder.rename(
        result, std::string(slot) + "." +
                    std::string(algorithm::short_name(context.view.terms().text(element))));
  if (result != own && own != algorithm::kNoIndex) {
    // The joint's alone, and that of all that it moves, cannot have the same name.
    const std::string taken = name.empty() ? context.builder.at(own).name : std::string(name);
    context.builder.rename(own, "alone-" + taken);
    context.builder.rename(result, taken);
  }
  context.builder.output(result, name);
}

}  // namespace sinew::synthesis
