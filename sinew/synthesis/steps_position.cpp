// Poses: across each joint, and of each body's frame with respect to the root.
#include "sinew/synthesis/free_joint.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/step_list.h"

namespace sinew::synthesis {
namespace {

using algorithm::Role;

constexpr double kIdentity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

void configure_joint(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  context.make({.slot = "placement",
                .represents = edge.joint,
                .quantity = "pose",
                .of = edge.joint_frame,
                .wrt = edge.parent,
                .role = Role::kConstant,
                .value = context.numbers(edge.placement)});
  algorithm::BlockSpec across = {.slot = "pose-across-joint",
                                 .represents = edge.joint,
                                 .quantity = "pose",
                                 .of = edge.child,
                                 .wrt = edge.joint_frame};
  const FreePart part = free_part(context, edge.joint);
  if (part.whole != nullptr && !part.first) {
    across.role = Role::kConstant;
    across.value = kIdentity;
  }
  context.make(across);
}

void compute_joint(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  if (const FreePart part = free_part(context, edge.joint); part.whole != nullptr) {
    if (part.first)
      context.closure(
          part.whole->kind == "spherical" ? "position-to-pose-spherical" : "position-to-pose-free",
          {context.block("position", part.whole->joint),
           context.block("pose-across-joint", edge.joint)},
          edge.joint);
    return;
  }
  context.closure(
      "position-to-pose-" + edge.kind,
      {context.block("position", edge.joint), context.block("pose-across-joint", edge.joint)},
      edge.joint);
}

// The root's own pose is the identity; its successors' poses need no composing with it.
void configure_first(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  context.board.put("pose-of-joint-frame", edge.joint, context.block("placement", edge.joint));
  context.make({.slot = "pose",
                .represents = edge.child,
                .quantity = "pose",
                .of = edge.child,
                .wrt = context.robot.root_frame});
}

void configure_later(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  context.make({.slot = "pose-of-joint-frame",
                .represents = edge.joint,
                .quantity = "pose",
                .of = edge.joint_frame,
                .wrt = context.robot.root_frame});
  context.make({.slot = "pose",
                .represents = edge.child,
                .quantity = "pose",
                .of = edge.child,
                .wrt = context.robot.root_frame});
}

void compute_first(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  context.closure(
      "compose-pose",
      {context.block("pose-of-joint-frame", edge.joint),
       context.block("pose-across-joint", edge.joint), context.block("pose", edge.child)},
      edge.child);
}

void compute_later(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  context.closure("compose-pose",
                  {context.block("pose", edge.parent), context.block("placement", edge.joint),
                   context.block("pose-of-joint-frame", edge.joint)},
                  edge.joint);
  compute_first(context, visit);
}

void configure_root(Context& context, const Visit& visit) {
  context.make({.slot = "pose",
                .represents = visit.node,
                .quantity = "pose",
                .of = visit.node,
                .wrt = visit.node,
                .role = Role::kConstant,
                .value = kIdentity});
}

}  // namespace

Step joint_pose_step() {
  return {.name = "joint-pose",
          .purpose = "the pose across each joint follows from its position",
          .direction = Direction::kOutward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"position"},
          .may_use = {},
          .gives = {"placement", "pose-across-joint"},
          .visitors = {{Where::kEdge, {}, {}, configure_joint, compute_joint}}};
}

Step pose_step() {
  const std::string first(kParentIsRoot), later(kParentIsNotRoot), root(kIsRoot);
  return {.name = "pose",
          .purpose = "poses are composed from the root outward",
          .direction = Direction::kOutward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"pose-across-joint"},
          .may_use = {},
          .gives = {"pose", "pose-of-joint-frame"},
          .visitors = {{Where::kNode, {root}, {}, configure_root, {}},
                       {Where::kEdge, {first}, {}, configure_first, compute_first},
                       {Where::kEdge, {later}, {}, configure_later, compute_later}}};
}

}  // namespace sinew::synthesis
