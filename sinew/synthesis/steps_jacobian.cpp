// Geometric Jacobians: the twist of a frame's origin, with the root's directions, for one unit of
// each joint's velocity. Columns of joints that do not lead to the frame are zero.
#include <algorithm>

#include "sinew/synthesis/block_specs.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/step_list.h"

namespace sinew::synthesis {
namespace {

using algorithm::BlockSpec;

constexpr std::string_view kAsksJacobian =
    SINEW_ASKS_PREFIX "ASK { ?algorithm sa:asks-jacobian ?node }";

// The joints whose velocities are given, in their order.
std::vector<const RobotJoint*> columns(const Context& context) {
  std::vector<const RobotJoint*> joints;
  for (const RobotJoint& joint : context.robot.joints)
    if (context.scope.empty() || context.scope.contains(joint.frame)) joints.push_back(&joint);
  return joints;
}

bool leads_to(const Context& context, const RobotJoint& joint, Id frame) {
  const auto path = path_to(context.robot, context.view, frame);
  return std::any_of(path.begin(), path.end(), [&](std::size_t index) {
    return context.robot.joints[index].joint == joint.joint;
  });
}

void configure(Context& context, const Visit& visit) {
  const Id frame = visit.node, root = context.robot.root_frame;
  const graph::Terms& terms = context.view.terms();
  const auto joints = columns(context);
  for (const RobotJoint* joint : joints) {
    const std::string label = std::string(algorithm::short_name(terms.text(frame))) + "." +
                              std::string(algorithm::short_name(terms.text(joint->joint)));
    const BlockSpec spec = {
        .slot = "jacobian-column",
        .represents = context.pair(frame, joint->joint),
        .quantity = joint->kind == "floating" ? "jacobian-block" : "jacobian-column",
        .of = frame,
        .wrt = root,
        .reference = frame,
        .seen_by = root,
        .prismatic = joint->kind == "prismatic",
        .label = label};
    context.make(leads_to(context, *joint, frame) ? spec : zero(spec));
  }
  const bool floats = !joints.empty() && joints.front()->kind == "floating";
  context.make({.slot = "jacobian",
                .represents = frame,
                .quantity = "jacobian",
                .of = frame,
                .wrt = root,
                .reference = frame,
                .seen_by = root,
                .size = static_cast<std::uint32_t>(6 * (joints.size() + (floats ? 5 : 0)))});
}

void compute(Context& context, const Visit& visit) {
  const Id frame = visit.node;
  std::vector<BlockIndex> blocks;
  bool floats = false;
  for (const RobotJoint* joint : columns(context)) {
    blocks.push_back(context.block("jacobian-column", context.pair(frame, joint->joint)));
    if (!leads_to(context, *joint, frame)) continue;
    floats |= joint->kind == "floating";
    context.closure(
        floats && blocks.size() == 1 ? "jacobian-columns-floating"
                                     : "jacobian-column-" + joint->kind,
        {context.block("pose", joint->frame), context.block("pose", frame), blocks.back()},
        joint->joint);
  }
  const auto count = static_cast<std::uint32_t>(blocks.size());
  blocks.push_back(context.block("jacobian", frame));
  if (floats)
    context.closure_with_counts("floating-jacobian-from-columns", std::move(blocks),
                                {1, count - 1, 1}, frame);
  else
    context.closure_with_counts("jacobian-from-columns", std::move(blocks), {count, 1}, frame);
}

}  // namespace

Step jacobian_step() {
  const std::string asks(kAsksJacobian);
  return {
      .name = "jacobian",
      .purpose = "each joint on the way moves the frame about or along its axis",
      .direction = Direction::kInward,  // it looks at all poses at once, so they come first
      .expansion = std::string(kAcrossJoints),
      .needs = {"pose", "frame-pose"},
      .may_use = {},
      .gives = {"jacobian"},
      .visitors = {{Where::kNode, {asks}, {}, configure, compute},
                   {Where::kNode, {asks}, {}, configure, compute, std::string(kToAskedFrames)}}};
}

}  // namespace sinew::synthesis
