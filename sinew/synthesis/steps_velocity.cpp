// Velocity twists. Each body's is absolute (with respect to the context's reference) and seen from
// the body's own frame. The fixed placement of a joint and its motion are transforms of their own:
// the first has constant coefficients, the second one or two that vary.
#include "sinew/synthesis/block_specs.h"
#include "sinew/synthesis/free_joint.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/step_list.h"

namespace sinew::synthesis {
namespace {

using algorithm::BlockSpec;

void configure_relative(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const BlockSpec spec = at_frame("relative-twist", "velocity-twist", edge.joint, edge.successor,
                                  edge.child, edge.predecessor);
  const FreePart part = free_part(context, edge.joint);
  context.make(part.whole != nullptr && !part.last ? zero(spec) : spec);
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
  context.make(zero(at_frame("body-twist", "velocity-twist", visit.node, visit["body"], visit.node,
                             context.reference)));
}

void configure_body(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto twist = [&](std::string_view slot, Id represents, Id of, Id frame) {
    context.make(at_frame(slot, "velocity-twist", represents, of, frame, context.reference));
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
