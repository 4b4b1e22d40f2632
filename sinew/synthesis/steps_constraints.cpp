// Where Cartesian drivers enter: unit constraint forces and external wrenches, brought to the
// frames of the bodies that they act on; the acceleration that a constrained frame has without any
// force; and the joint forces that would replace a constraint force.
#include "sinew/synthesis/effect_wrenches.h"
#include "sinew/synthesis/effects.h"
#include "sinew/synthesis/hybrid_steps.h"

namespace sinew::synthesis {
namespace {

using algorithm::kNoIndex;
using algorithm::Role;

// ---- unit constraint forces ----

const AccelerationConstraint& constraint_of(const Context& context,
                                            const ConstraintDirection& direction) {
  return context.drivers.constraints[direction.constraint];
}

template <typename Call>
void for_directions_at(const Context& context, Id frame, Call call) {
  for (const ConstraintDirection& direction : context.drivers.directions)
    if (constraint_of(context, direction).at.frame == frame)
      call(direction, constraint_of(context, direction));
}

BlockIndex make_wrench(Context& context, std::string_view slot, Id represents,
                       std::string_view label, Id body, Id frame) {
  return context.make({.slot = slot,
                       .represents = represents,
                       .quantity = "wrench",
                       .of = body,
                       .reference = frame,
                       .seen_by = frame,
                       .label = label});
}

void configure_direction(Context& context, const Visit& visit) {
  for_directions_at(context, visit.node, [&](const auto& direction, const auto& constraint) {
    const DrivenFrame& at = constraint.at;
    BlockIndex wrench = context.block("constraint-direction", direction.element);
    if (!constraint.seen_by_itself)
      wrench = make_wrench(context, "constraint-direction-at-frame", direction.element,
                           direction.label, at.body, at.frame);
    context.board.put("constraint-direction-at-frame", direction.element, wrench);
    if (at.is_body_frame())
      context.board.put("constraint-wrench", direction.element, wrench);
    else
      make_wrench(context, "constraint-wrench", direction.element, direction.label, at.body,
                  at.body_frame);
  });
}

void compute_direction(Context& context, const Visit& visit) {
  for_directions_at(context, visit.node, [&](const auto& direction, const auto& constraint) {
    const auto block = [&](std::string_view slot) {
      return context.block(slot, direction.element);
    };
    if (!constraint.seen_by_itself)
      context.closure("rotate-wrench-to-distal",
                      {context.block("pose", visit.node), block("constraint-direction"),
                       block("constraint-direction-at-frame")},
                      constraint.element);
    if (!constraint.at.is_body_frame())
      context.closure("transform-wrench-to-proximal",
                      {context.block("frame-placement", visit.node),
                       block("constraint-direction-at-frame"), block("constraint-wrench")},
                      constraint.element);
  });
}

// ---- what a constrained frame does by itself ----

algorithm::BlockSpec acceleration(std::string_view slot, const AccelerationConstraint& constraint,
                                  Id of, Id wrt, Id seen_by) {
  return {.slot = slot,
          .represents = constraint.element,
          .quantity = "acceleration-twist",
          .of = of,
          .wrt = wrt,
          .reference = constraint.at.frame,
          .seen_by = seen_by,
          .label = constraint.label};
}

template <typename Call>
void for_constraints_at(const Context& context, Id frame, Call call) {
  for (const AccelerationConstraint& constraint : context.drivers.constraints)
    if (constraint.at.frame == frame) call(constraint);
}

// Whether gravity is an input.
bool falls_as_given(const Context& context) {
  return context.has("gravity", context.robot.root_frame);
}

void configure_bias(Context& context, const Visit& visit) {
  const Id root = context.robot.root_frame, root_body = context.robot.root_body;
  const bool falls = context.reference != root_body;
  for_constraints_at(context, visit.node, [&](const AccelerationConstraint& constraint) {
    const DrivenFrame& at = constraint.at;
    const Id seen = constraint.seen_by_itself ? at.frame : root;
    if (!at.is_body_frame())
      context.make(acceleration("constraint-frame-acceleration", constraint, at.body,
                                context.reference, at.frame));
    if (!constraint.seen_by_itself)
      context.make(acceleration("constraint-frame-acceleration-rotated", constraint, at.body,
                                context.reference, root));
    if (!falls) return;
    // The observer falls; seen from the base it accelerates with gravity.
    const std::array<double, 6> value = {
        0, 0, 0, context.gravity[0], context.gravity[1], context.gravity[2]};
    algorithm::BlockSpec observer =
        acceleration("constraint-observer", constraint, context.reference, root_body, root);
    if (!falls_as_given(context)) {
      observer.role = Role::kConstant;
      observer.value = value;
    }
    context.make(observer);
    if (constraint.seen_by_itself)
      context.make(acceleration("constraint-observer-rotated", constraint, context.reference,
                                root_body, at.frame));
    context.make(acceleration("constraint-acceleration", constraint, at.body, root_body, seen));
  });
  for_directions_at(context, visit.node, [&](const auto& direction, const auto&) {
    context.make({.slot = "constraint-bias-energy",
                  .represents = direction.element,
                  .quantity = "acceleration-energy",
                  .label = direction.label});
  });
}

// The frame's acceleration with respect to the base while all joint accelerations are zero.
BlockIndex bias_acceleration(Context& context, const AccelerationConstraint& constraint) {
  const DrivenFrame& at = constraint.at;
  const Id element = constraint.element;
  const auto block = [&](std::string_view slot) { return context.block(slot, element); };
  BlockIndex own = context.block("bias-body-acceleration", at.body_frame);
  if (!at.is_body_frame()) {
    context.closure(
        "transform-acceleration-twist-to-distal-fixed",
        {context.block("frame-placement", at.frame), context.block("body-twist", at.body_frame),
         own, block("constraint-frame-acceleration")},
        element);
    own = block("constraint-frame-acceleration");
  }
  const BlockIndex pose = context.block("pose", at.frame);
  if (!constraint.seen_by_itself) {
    const BlockIndex rotated = block("constraint-frame-acceleration-rotated");
    context.closure("rotate-acceleration-twist-to-proximal", {pose, own, rotated}, element);
    own = rotated;
  }
  if (context.reference == context.robot.root_body) return own;
  BlockIndex observer = block("constraint-observer");
  if (falls_as_given(context))
    context.closure("free-fall-from-gravity",
                    {pose, context.block("gravity", context.robot.root_frame), observer}, element);
  if (constraint.seen_by_itself) {
    const BlockIndex rotated = block("constraint-observer-rotated");
    context.closure("rotate-acceleration-twist-to-distal", {pose, observer, rotated}, element);
    observer = rotated;
  }
  context.closure("add-acceleration-twist", {observer, own, block("constraint-acceleration")},
                  element);
  return block("constraint-acceleration");
}

void compute_bias(Context& context, const Visit& visit) {
  for_constraints_at(context, visit.node, [&](const AccelerationConstraint& constraint) {
    const BlockIndex acceleration = bias_acceleration(context, constraint);
    for (const ConstraintDirection& direction : context.drivers.directions)
      if (&constraint_of(context, direction) == &constraint)
        context.closure("acceleration-energy-of-wrench",
                        {context.block("constraint-direction", direction.element), acceleration,
                         context.block("constraint-bias-energy", direction.element)},
                        constraint.element);
  });
}

// ---- joint forces in place of constraint forces: J^T ----

void start_lever(Context& context, const Visit& visit) {
  for (const ConstraintDirection& direction : context.drivers.directions)
    if (constraint_of(context, direction).at.body_frame == visit.node)
      context.board.put(kLeverWrench, context.pair(direction.element, visit.node),
                        context.block("constraint-wrench", direction.element));
}

void configure_lever(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  for (const Effect& effect : effects(context)) {
    if (effect_block(context, kLeverWrench, effect.element, edge.child) == kNoIndex) continue;
    make_joint_effect(context, edge, effect, "constraint-lever", "force");
    // Held joints pass it on as it is; the predecessor feels nothing else of this constraint.
    if (edge.parent != context.robot.root_frame)
      configure_wrench_past_joint(context, edge, effect, kLeverWrench);
  }
}

void compute_lever(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  for (const Effect& effect : effects(context)) {
    const BlockIndex wrench = effect_block(context, kLeverWrench, effect.element, edge.child);
    if (wrench == kNoIndex) continue;
    context.closure("force-from-wrench-" + edge.kind,
                    {wrench, effect_block(context, "constraint-lever", effect.element, edge.joint)},
                    edge.joint);
    if (edge.parent != context.robot.root_frame)
      compute_wrench_past_joint(context, edge, effect, kLeverWrench, wrench);
  }
}

// For bodies' frames, and for frames that are fixed to them.
std::vector<Visitor> at_frames(Pass configure, Pass compute) {
  return {{Where::kNode, {}, {}, configure, compute},
          {Where::kNode, {}, {}, configure, compute, std::string(kToAskedFrames)}};
}

}  // namespace

Step constraint_wrench_step() {
  return {.name = "constraint-wrench",
          .purpose = "each constraint acts on its body through a unit force in its direction",
          .direction = Direction::kLocal,
          .expansion = std::string(kAcrossJoints),
          .needs = {"acceleration-energy", "pose", "frame-pose"},
          .may_use = {},
          .gives = {"constraint-wrench"},
          .visitors = at_frames(configure_direction, compute_direction)};
}

Step constraint_bias_step() {
  return {.name = "constraint-bias",
          .purpose = "velocities accelerate a constrained frame without any joint acceleration",
          .direction = Direction::kLocal,
          .expansion = std::string(kAcrossJoints),
          .needs = {"constraint-wrench", "body-twist", "bias-body-acceleration", "frame-pose"},
          .may_use = {},
          .gives = {"constraint-bias-energy"},
          .visitors = at_frames(configure_bias, compute_bias)};
}

Step constraint_lever_step() {
  return {
      .name = "constraint-lever",
      .purpose = "unit constraint forces on held joints: what actuators would do in their place",
      .direction = Direction::kInward,
      .expansion = std::string(kAcrossJoints),
      .needs = {"constraint-wrench", "placement", "pose-across-joint"},
      .may_use = {},
      .gives = {"constraint-lever"},
      .visitors = {{Where::kNode, {std::string(kIsNotRoot)}, {}, start_lever, {}},
                   {Where::kEdge, {}, {}, configure_lever, compute_lever}}};
}

}  // namespace sinew::synthesis
