// Velocity twists. Each body's is absolute (with respect to the context's reference) and seen from
// the body's own frame. The fixed placement of a joint and its motion are transforms of their own:
// the first has constant coefficients, the second one or two that vary.
#include "sinew/synthesis/free_joint.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/step_list.h"

namespace sinew::synthesis {
namespace {

using algorithm::BlockSpec;
using algorithm::Role;

constexpr double kZero[6] = {};

void configure_relative(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  BlockSpec spec = {.slot = "relative-twist",
                    .represents = edge.joint,
                    .quantity = "velocity-twist",
                    .of = edge.successor,
                    .wrt = edge.predecessor,
                    .reference = edge.child,
                    .seen_by = edge.child};
  const FreePart part = free_part(context, edge.joint);
  if (part.whole != nullptr && !part.last) {
    spec.role = Role::kConstant;
    spec.value = kZero;
  }
  context.make(spec);
}

void compute_relative(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  if (const FreePart part = free_part(context, edge.joint); part.whole != nullptr) {
    if (part.last)
      context.closure("velocity-to-twist-" + part.whole->kind,
                      {context.block("velocity", part.whole->joint),
                       context.block("relative-twist", edge.joint)},
                      edge.joint);
    return;
  }
  context.closure(
      "velocity-to-twist-" + edge.kind,
      {context.block("velocity", edge.joint), context.block("relative-twist", edge.joint)},
      edge.joint);
}

// The root is at rest.
void configure_root(Context& context, const Visit& visit) {
  context.make({.slot = "body-twist",
                .represents = visit.node,
                .quantity = "velocity-twist",
                .of = visit["body"],
                .wrt = context.reference,
                .reference = visit.node,
                .seen_by = visit.node,
                .role = Role::kConstant,
                .value = kZero});
}

void configure_body(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto twist = [&](std::string_view slot, Id represents, Id of, Id frame) {
    context.make({.slot = slot,
                  .represents = represents,
                  .quantity = "velocity-twist",
                  .of = of,
                  .wrt = context.reference,
                  .reference = frame,
                  .seen_by = frame});
  };
  twist("twist-at-joint", edge.joint, edge.predecessor, edge.joint_frame);
  twist("twist-across-joint", edge.joint, edge.predecessor, edge.child);
  twist("body-twist", edge.child, edge.successor, edge.child);
}

void compute_body(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const BlockIndex at = context.block("twist-at-joint", edge.joint);
  const BlockIndex across = context.block("twist-across-joint", edge.joint);
  context.closure(
      "transform-velocity-twist-to-distal",
      {context.block("placement", edge.joint), context.block("body-twist", edge.parent), at},
      edge.joint);
  context.closure("transform-velocity-twist-to-distal",
                  {context.block("pose-across-joint", edge.joint), at, across}, edge.joint);
  context.closure("add-velocity-twist",
                  {across, context.block("relative-twist", edge.joint),
                   context.block("body-twist", edge.child)},
                  edge.child);
}

}  // namespace

Step joint_velocity_step() {
  return {.name = "joint-velocity",
          .purpose = "the twist across each joint follows from its velocity",
          .direction = Direction::kOutward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"velocity"},
          .may_use = {},
          .gives = {"relative-twist"},
          .visitors = {{Where::kEdge, {}, {}, configure_relative, compute_relative}}};
}

Step velocity_step() {
  return {.name = "velocity",
          .purpose = "twists add up from the root outward",
          .direction = Direction::kOutward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"placement", "pose-across-joint", "relative-twist"},
          .may_use = {},
          .gives = {"body-twist", "twist-at-joint"},
          .visitors = {
              {Where::kNode, {std::string(kIsRoot)}, std::string(kBodyOfNode), configure_root, {}},
              {Where::kEdge, {}, {}, configure_body, compute_body}}};
}

}  // namespace sinew::synthesis
