#include "sinew/synthesis/free_joint.h"

#include <algorithm>

namespace sinew::synthesis {

FreePart free_part(const Context& context, Id joint) {
  const auto& joints = context.robot.joints;
  const auto found = std::find_if(joints.begin(), joints.end(),
                                  [&](const RobotJoint& one) { return one.joint == joint; });
  if (found == joints.end() || found->compound < 0) return {};
  const RobotCompound& whole = context.robot.compounds[static_cast<std::size_t>(found->compound)];
  if (!whole.is_free()) return {};
  const auto index = static_cast<std::size_t>(found - joints.begin());
  return {&whole, whole.parts.front() == index, whole.parts.back() == index};
}

namespace {

bool ends_a_floating_one(const FreePart& part) {
  return part.whole != nullptr && part.last && part.whole->kind == "floating";
}

}  // namespace

bool floats_freely(const Context& context, const JointEdge& edge) {
  return edge.floats() || ends_a_floating_one(free_part(context, edge.joint));
}

bool floats_freely(const Context& context, const RobotJoint& joint) {
  return joint.kind == "floating" || ends_a_floating_one(free_part(context, joint.joint));
}

algorithm::BlockSpec whole_quantity(const Context& context, const RobotCompound& whole,
                                    std::string_view slot) {
  const auto& joints = context.robot.joints;
  const RobotJoint &first = joints[whole.parts.front()], &last = joints[whole.parts.back()];
  const bool pose = slot == "position", spherical = whole.kind == "spherical";
  std::string_view quantity = spherical ? "spherical-acceleration" : "floating-acceleration";
  if (pose) quantity = spherical ? "spherical-position" : "floating-position";
  if (slot == "velocity") quantity = spherical ? "spherical-velocity" : "floating-velocity";
  return {.slot = slot,
          .represents = whole.joint,
          .quantity = quantity,
          .of = pose ? first.frame : last.successor,
          .wrt = pose ? first.joint_frame : last.predecessor,
          .seen_by = last.frame};
}

BlockIndex whole_acceleration(Context& context, const RobotCompound& whole) {
  const BlockIndex given = context.board.find("acceleration", whole.joint);
  if (given != algorithm::kNoIndex) return given;
  algorithm::BlockSpec spec = whole_quantity(context, whole, "acceleration");
  std::vector<BlockIndex> blocks;
  for (const std::size_t part : whole.parts)
    blocks.push_back(context.block("acceleration", context.robot.joints[part].joint));
  algorithm::BlockSpec map = spec;
  const double count[] = {static_cast<double>(blocks.size())};
  map.slot = "parts-of-acceleration";
  map.quantity = "coordinate-map";
  map.size = 1;
  map.role = algorithm::Role::kConstant;
  map.value = count;
  blocks.push_back(context.make(map));
  blocks.push_back(context.make(spec));
  const BlockIndex made = blocks.back();
  const auto parts = static_cast<std::uint32_t>(blocks.size() - 2);
  context.closure_with_counts(whole.kind + "-acceleration-of-parts", std::move(blocks),
                              {parts, 1, 1}, whole.joint);
  return made;
}

}  // namespace sinew::synthesis
