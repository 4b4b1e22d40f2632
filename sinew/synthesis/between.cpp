#include "sinew/synthesis/between.h"

#include <stdexcept>

#include "sinew/synthesis/free_joint.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/relation.h"

namespace sinew::synthesis {

using algorithm::BlockSpec;
using algorithm::kNoIndex;
using algorithm::Role;

namespace {

constexpr double kZero[6] = {};
constexpr double kIdentity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

std::string name_of(const Context& context, Id frame) {
  return std::string(algorithm::short_name(context.view.terms().text(frame)));
}

}  // namespace

Id Between::body(Id frame) const { return body_of(context_.robot, context_.view, frame); }

const RobotJoint& Between::joint_to(Id body_frame) const {
  for (const RobotJoint& joint : context_.robot.joints)
    if (joint.frame == body_frame) return joint;
  throw std::logic_error("no joint leads to the root");
}

// A block for a frame as it is seen from a base frame. Its reference is the frame's origin.
BlockIndex Between::make(std::string_view slot, Id base_frame, Id frame, std::string_view quantity,
                         Id of, Id wrt, std::span<const double> constant) {
  const std::string label = name_of(context_, frame) + ".from." + name_of(context_, base_frame);
  BlockSpec spec = {.slot = slot,
                    .represents = context_.pair(base_frame, frame),
                    .quantity = quantity,
                    .of = of,
                    .wrt = wrt,
                    .label = label};
  if (quantity != "pose") spec.reference = spec.seen_by = frame;
  if (!constant.empty()) {
    spec.role = Role::kConstant;
    spec.value = constant;
  }
  return context_.make(spec);
}

BlockIndex Between::placement(Id frame) {
  const Id body = body_frame(context_.view, frame);
  const Id property =
      context_.view.terms().find_iri(std::string(algorithm::kTreeNamespace) + "placement");
  const std::vector<double> numbers = context_.numbers(context_.view.object(frame, property));
  return context_.make({.slot = "frame-placement",
                        .represents = frame,
                        .quantity = "pose",
                        .of = frame,
                        .wrt = body,
                        .role = Role::kConstant,
                        .value = numbers});
}

BlockIndex Between::pose_from(Id base_frame, Id of) {
  if (base_frame == context_.robot.root_frame && context_.has("pose", of))
    return context_.block("pose", of);
  const Id pair = context_.pair(base_frame, of);
  if (context_.has("pose-from", pair)) return context_.block("pose-from", pair);
  if (base_frame == of) return pose(of, of);
  const Id body = body_frame(context_.view, of);
  if (body != of) {
    const BlockIndex to_frame = placement(of);
    if (body == base_frame) return to_frame;
    const BlockIndex to_body = pose_from(base_frame, body);
    const BlockIndex made = make("pose-from", base_frame, of, "pose", of, base_frame);
    context_.closure("compose-pose", {to_body, to_frame, made}, of);
    return made;
  }
  const RobotJoint& joint = joint_to(of);
  BlockIndex to_joint = context_.block("placement", joint.joint);
  if (joint.parent_frame != base_frame) {
    const BlockIndex to_parent = pose_from(base_frame, joint.parent_frame);
    const BlockIndex here =
        make("pose-from", base_frame, joint.joint_frame, "pose", joint.joint_frame, base_frame);
    context_.closure("compose-pose", {to_parent, to_joint, here}, joint.joint);
    to_joint = here;
  }
  const BlockIndex made = make("pose-from", base_frame, of, "pose", of, base_frame);
  context_.closure("compose-pose",
                   {to_joint, context_.block("pose-across-joint", joint.joint), made}, of);
  return made;
}

BlockIndex Between::pose(Id wrt, Id of) {
  if (wrt == of) return make("pose-of-itself", of, of, "pose", of, of, kIdentity);
  const Id base = way_between(context_.robot, context_.view, wrt, of).base_frame;
  const BlockIndex there = pose_from(base, of);
  if (wrt == base) return there;
  const Id pair = context_.pair(wrt, of);
  if (context_.has("pose-between", pair)) return context_.block("pose-between", pair);
  const BlockIndex back = pose_from(base, wrt);
  const BlockIndex inverse = make("pose-back", base, wrt, "pose", base, wrt);
  context_.closure("invert-pose", {back, inverse}, wrt);
  if (of == base) return inverse;
  const BlockIndex made = make("pose-between", wrt, of, "pose", of, wrt);
  context_.closure("compose-pose", {inverse, there, made}, of);
  return made;
}

// Absolute motion, if it is known of both bodies, else motion from the last body on the way to
// both.
Id Between::base_of_motions(Id wrt, Id of, std::string_view absolute) {
  const Id a = body_frame(context_.view, wrt), b = body_frame(context_.view, of);
  if (a != b && context_.has(absolute, a) && context_.has(absolute, b))
    return context_.robot.root_frame;
  return way_between(context_.robot, context_.view, wrt, of).base_frame;
}

// What motion from a base is with respect to: its body, or what absolute motion is with respect to.
Id Between::reference_of(Id base_frame, std::string_view absolute) {
  if (base_frame == context_.robot.root_frame && context_.has(absolute, base_frame))
    return context_.reference;
  return body(base_frame);
}

BlockIndex Between::twist_from(Id base_frame, Id of) {
  if (base_frame == context_.robot.root_frame && context_.has("body-twist", of))
    return context_.block("body-twist", of);
  const Id pair = context_.pair(base_frame, of), reference = reference_of(base_frame, "body-twist");
  if (context_.has("twist-from", pair)) return context_.block("twist-from", pair);
  if (of == base_frame)
    return make("twist-from", of, of, "velocity-twist", body(of), reference, kZero);
  const Id at_body = body_frame(context_.view, of);
  if (at_body != of) {
    const BlockIndex from = twist_from(base_frame, at_body);
    const BlockIndex made =
        make("twist-from", base_frame, of, "velocity-twist", body(of), reference);
    context_.closure("transform-velocity-twist-to-distal", {placement(of), from, made}, of);
    return made;
  }
  const RobotJoint& joint = joint_to(of);
  const BlockIndex from = twist_from(base_frame, joint.parent_frame);
  const BlockIndex at = make("twist-from", base_frame, joint.joint_frame, "velocity-twist",
                             joint.predecessor, reference);
  context_.closure("transform-velocity-twist-to-distal",
                   {context_.block("placement", joint.joint), from, at}, joint.joint);
  const BlockIndex across =
      make("twist-across-from", base_frame, of, "velocity-twist", joint.predecessor, reference);
  context_.closure("transform-velocity-twist-to-distal",
                   {context_.block("pose-across-joint", joint.joint), at, across}, joint.joint);
  const BlockIndex made =
      make("twist-from", base_frame, of, "velocity-twist", joint.successor, reference);
  context_.closure("add-velocity-twist",
                   {across, context_.block("relative-twist", joint.joint), made}, of);
  return made;
}

BlockIndex Between::twist(Id wrt, Id of) {
  const Id pair = context_.pair(wrt, of);
  if (context_.has("twist-between", pair)) return context_.block("twist-between", pair);
  const Id base = base_of_motions(wrt, of, "body-twist");
  const BlockIndex moved = twist_from(base, of), moving = twist_from(base, wrt);
  const BlockIndex there =
      make("twist-carried", wrt, of, "velocity-twist", body(wrt), reference_of(base, "body-twist"));
  context_.closure("transform-velocity-twist-to-distal", {pose(wrt, of), moving, there}, of);
  const BlockIndex made = make("twist-between", wrt, of, "velocity-twist", body(of), body(wrt));
  context_.closure("subtract-velocity-twist", {moved, there, made}, of);
  return made;
}

// Of the joint alone. The velocity of a floating base has coordinates in its own frame: while these
// do not change, its origin may still accelerate.
BlockIndex Between::relative_acceleration(Motion motion, const RobotJoint& joint) {
  if (motion == Motion::kFull) return context_.block("relative-acceleration", joint.joint);
  const std::string_view quantity = "acceleration-twist";
  if (!floats_freely(context_, joint))
    return make("no-acceleration-across", joint.joint_frame, joint.frame, quantity, joint.successor,
                joint.predecessor, kZero);
  const std::string label = joint.label + ".alone";
  const BlockIndex none = context_.make({.slot = "no-acceleration",
                                         .represents = joint.joint,
                                         .quantity = "floating-acceleration",
                                         .of = joint.successor,
                                         .wrt = joint.predecessor,
                                         .seen_by = joint.frame,
                                         .role = Role::kConstant,
                                         .value = kZero,
                                         .label = label});
  const BlockIndex made = make("acceleration-across", joint.joint_frame, joint.frame, quantity,
                               joint.successor, joint.predecessor);
  context_.closure("acceleration-to-twist-floating",
                   {none, context_.block("relative-twist", joint.joint), made}, joint.joint);
  return made;
}

BlockIndex Between::acceleration_from(Id base_frame, Id of, Motion motion) {
  const std::string absolute = slot_of(motion, "body-acceleration");
  const std::string slot = slot_of(motion, "acceleration-from"),
                    across_slot = slot_of(motion, "acceleration-across-from");
  const std::string_view quantity = "acceleration-twist";
  if (base_frame == context_.robot.root_frame && context_.has(absolute, of))
    return context_.block(absolute, of);
  const Id pair = context_.pair(base_frame, of), reference = reference_of(base_frame, "body-twist");
  if (context_.has(slot, pair)) return context_.block(slot, pair);
  if (of == base_frame) {
    // Where all motion is with respect to what falls freely, a root at rest accelerates.
    if (of == context_.robot.root_frame && reference == context_.reference &&
        context_.has("base-acceleration", of))
      return context_.block("base-acceleration", of);
    return make(slot, of, of, quantity, body(of), reference, kZero);
  }
  const std::string_view fixed = "transform-acceleration-twist-to-distal-fixed";
  const Id at_body = body_frame(context_.view, of);
  if (at_body != of) {
    const BlockIndex from = acceleration_from(base_frame, at_body, motion);
    const BlockIndex made = make(slot, base_frame, of, quantity, body(of), reference);
    context_.closure(fixed, {placement(of), twist_from(base_frame, at_body), from, made}, of);
    return made;
  }
  const RobotJoint& joint = joint_to(of);
  const BlockIndex from = acceleration_from(base_frame, joint.parent_frame, motion);
  const BlockIndex twist = twist_from(base_frame, joint.parent_frame);
  const BlockIndex at =
      make(slot, base_frame, joint.joint_frame, quantity, joint.predecessor, reference);
  const BlockIndex placed = context_.block("placement", joint.joint);
  context_.closure(fixed, {placed, twist, from, at}, joint.joint);
  const BlockIndex twist_at = make("twist-from", base_frame, joint.joint_frame, "velocity-twist",
                                   joint.predecessor, reference);
  context_.closure("transform-velocity-twist-to-distal", {placed, twist, twist_at}, joint.joint);
  const BlockIndex across =
      make(across_slot, base_frame, of, quantity, joint.predecessor, reference);
  context_.closure("transform-acceleration-twist-to-distal",
                   {context_.block("pose-across-joint", joint.joint), twist_at,
                    context_.block("relative-twist", joint.joint), at, across},
                   joint.joint);
  const BlockIndex made = make(slot, base_frame, of, quantity, joint.successor, reference);
  context_.closure("add-acceleration-twist", {across, relative_acceleration(motion, joint), made},
                   of);
  return made;
}

BlockIndex Between::acceleration(Id wrt, Id of, Motion motion) {
  const Id pair = context_.pair(wrt, of);
  const std::string slot = slot_of(motion, "acceleration-between");
  if (context_.has(slot, pair)) return context_.block(slot, pair);
  const Id base = base_of_motions(wrt, of, slot_of(motion, "body-acceleration"));
  const BlockIndex moved = acceleration_from(base, of, motion),
                   moving = acceleration_from(base, wrt, motion);
  const BlockIndex there = make(slot_of(motion, "acceleration-carried"), wrt, of,
                                "acceleration-twist", body(wrt), reference_of(base, "body-twist"));
  context_.closure("transform-acceleration-twist-to-distal",
                   {pose(wrt, of), twist_from(base, wrt), twist(wrt, of), moving, there}, of);
  const BlockIndex made = make(slot, wrt, of, "acceleration-twist", body(of), body(wrt));
  context_.closure("subtract-acceleration-twist", {moved, there, made}, of);
  return made;
}

void Between::turn(BlockIndex from, Id of, Id seen_by, BlockIndex to) {
  const std::string quantity(context_.builder.at(from).quantity->name);
  context_.closure("rotate-" + quantity + "-to-proximal", {pose(seen_by, of), from, to}, of);
}

}  // namespace sinew::synthesis
