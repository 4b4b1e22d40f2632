// Outputs of the frames that are asked for: bodies' frames, and those that are fixed to them.
#include <fmt/format.h>

#include "sinew/synthesis/asked.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/step_list.h"

namespace sinew::synthesis {
namespace {

using algorithm::Block;
using algorithm::Role;

constexpr std::string_view kAsksTwist = SINEW_ASKS_PREFIX "ASK { ?algorithm sa:asks-twist ?node }";
constexpr std::string_view kAsksAcceleration =
    SINEW_ASKS_PREFIX "ASK { ?algorithm sa:asks-acceleration-twist ?node }";

void configure_pose(Context& context, const Visit& visit) {
  context.make({.slot = "frame-placement",
                .represents = visit.node,
                .quantity = "pose",
                .of = visit.node,
                .wrt = visit.parent,
                .role = Role::kConstant,
                .value = context.numbers(visit["placement"])});
  context.make({.slot = "pose",
                .represents = visit.node,
                .quantity = "pose",
                .of = visit.node,
                .wrt = context.robot.root_frame});
}

void compute_pose(Context& context, const Visit& visit) {
  context.closure("compose-pose",
                  {context.block("pose", visit.parent),
                   context.block("frame-placement", visit.node), context.block("pose", visit.node)},
                  visit.node);
}

// One row for velocities and one for accelerations: they differ in names alone, but for the
// transform to the frame.
struct MotionOfFrame {
  std::string_view quantity, of_body, of_frame, of_observer, from_observer, output, rotate, add;
  bool by_jacobian = false;
};
constexpr MotionOfFrame kTwist = {"velocity-twist",
                                  "body-twist",
                                  "frame-twist",
                                  "observer-twist",
                                  "frame-twist-from-observer",
                                  "twist",
                                  "rotate-velocity-twist-to-proximal",
                                  "add-velocity-twist"};
constexpr MotionOfFrame kTwistByJacobian = [] {
  MotionOfFrame row = kTwist;
  row.by_jacobian = true;
  return row;
}();
constexpr MotionOfFrame kAcceleration = {"acceleration-twist",
                                         "body-acceleration",
                                         "frame-acceleration",
                                         "observer-acceleration",
                                         "frame-acceleration-from-observer",
                                         "acceleration-twist",
                                         "rotate-acceleration-twist-to-proximal",
                                         "add-acceleration-twist"};

algorithm::BlockSpec motion(const MotionOfFrame& row, std::string_view slot, Id frame, Id of,
                            Id wrt, Id seen_by) {
  return {.slot = slot,
          .represents = frame,
          .quantity = row.quantity,
          .of = of,
          .wrt = wrt,
          .reference = frame,
          .seen_by = seen_by};
}

// Whether the observer's motion follows from an input.
bool falls_as_given(const MotionOfFrame& row, const Context& context) {
  return row.quantity == kAcceleration.quantity && context.has("gravity", context.robot.root_frame);
}

// From a frame's motion in its own directions to the same in the root's; and, where the observer
// falls freely, to the motion with respect to the root.
void configure_output(const MotionOfFrame& row, Context& context, Id frame, Id body) {
  const Id root = context.robot.root_frame, root_body = context.robot.root_body;
  if (context.reference == root_body) {
    context.make(motion(row, row.output, frame, body, root_body, root));
    return;
  }
  context.make(motion(row, row.from_observer, frame, body, context.reference, root));
  // At this moment the observer rests and falls.
  std::vector<double> value(6, 0.0);
  if (row.quantity == kAcceleration.quantity)
    for (std::size_t i = 0; i < 3; ++i) value[3 + i] = context.gravity[i];
  algorithm::BlockSpec observer =
      motion(row, row.of_observer, frame, context.reference, root_body, root);
  if (!falls_as_given(row, context)) {
    observer.role = Role::kConstant;
    observer.value = value;
  }
  context.make(observer);
  context.make(motion(row, row.output, frame, body, root_body, root));
}

// The velocities of joints times their columns of the frame's Jacobian, which is there anyway, are
// the velocity of its origin. How it turns, its body knows. `result` has the root's directions.
void add_columns(Context& context, Id frame, BlockIndex own, BlockIndex result) {
  const Block block = context.builder.at(result);
  const auto next = [&](std::string_view slot, Id element, const std::string& label) {
    return context.make({.slot = slot,
                         .represents = element,
                         .quantity = "velocity-twist",
                         .of = block.symbols[0],
                         .wrt = block.symbols[1],
                         .reference = block.symbols[2],
                         .seen_by = block.symbols[3],
                         .label = label});
  };
  const std::string name(algorithm::short_name(context.view.terms().text(frame)));
  BlockIndex twist = next("turning", frame, name);
  context.closure("turning-seen-from-proximal", {context.block("pose", frame), own, twist}, frame);
  const std::vector<std::size_t> path = path_to(context.robot, context.view, frame);
  for (const std::size_t k : path) {
    const RobotJoint& joint = context.robot.joints[k];
    const Id pair = context.pair(frame, joint.joint);
    const std::string_view label =
        joint.label.empty() ? algorithm::short_name(context.view.terms().text(joint.joint))
                            : std::string_view(joint.label);
    const BlockIndex with =
        k == path.back() ? result : next("twist-so-far", pair, fmt::format("{}.{}", name, label));
    context.closure("add-linear-motion-of-column",
                    {twist, context.block("jacobian-column", pair),
                     context.block("velocity", joint.joint), with},
                    joint.joint);
    twist = with;
  }
}

void to_root_directions(const MotionOfFrame& row, Context& context, Id frame, BlockIndex own,
                        BlockIndex result) {
  const bool moves = !path_to(context.robot, context.view, frame).empty();
  if (row.by_jacobian && moves)
    add_columns(context, frame, own, result);
  else
    context.closure(row.rotate, {context.block("pose", frame), own, result}, frame);
}

void compute_output(const MotionOfFrame& row, Context& context, Id frame) {
  const BlockIndex pose = context.block("pose", frame);
  const BlockIndex own = context.block(row.of_frame, frame);
  const BlockIndex output = context.block(row.output, frame);
  if (context.reference == context.robot.root_body) {
    to_root_directions(row, context, frame, own, output);
    return;
  }
  const BlockIndex from_observer = context.block(row.from_observer, frame);
  to_root_directions(row, context, frame, own, from_observer);
  if (falls_as_given(row, context))
    context.closure("free-fall-from-gravity",
                    {pose, context.block("gravity", context.robot.root_frame),
                     context.block(row.of_observer, frame)},
                    frame);
  context.closure(row.add, {context.block(row.of_observer, frame), from_observer, output}, frame);
}

void configure_frame(const MotionOfFrame& row, Context& context, const Visit& visit) {
  context.make(motion(row, row.of_frame, visit.node, visit["body"], context.reference, visit.node));
  configure_output(row, context, visit.node, visit["body"]);
}

void compute_frame(const MotionOfFrame& row, Context& context, const Visit& visit) {
  const BlockIndex placement = context.block("frame-placement", visit.node);
  const BlockIndex own = context.block(row.of_frame, visit.node);
  const BlockIndex twist = context.block("body-twist", visit.parent);
  if (row.quantity == kTwist.quantity)
    context.closure("transform-velocity-twist-to-distal", {placement, twist, own}, visit.node);
  else
    context.closure("transform-acceleration-twist-to-distal-fixed",
                    {placement, twist, context.block(row.of_body, visit.parent), own}, visit.node);
  compute_output(row, context, visit.node);
}

void configure_body(const MotionOfFrame& row, Context& context, const Visit& visit) {
  context.board.put(row.of_frame, visit.node, context.block(row.of_body, visit.node));
  configure_output(row, context, visit.node, visit["body"]);
}

void compute_body(const MotionOfFrame& row, Context& context, const Visit& visit) {
  compute_output(row, context, visit.node);
}

std::vector<Visitor> motion_visitors(const MotionOfFrame& row, std::string_view asks) {
  const auto bind = [&](auto pass) {
    return [&row, pass](Context& context, const Visit& visit) { pass(row, context, visit); };
  };
  return {{Where::kEdge,
           {std::string(asks)},
           {},
           bind(configure_frame),
           bind(compute_frame),
           std::string(kToAskedFrames)},
          {Where::kNode,
           {std::string(asks)},
           std::string(kBodyOfNode),
           bind(configure_body),
           bind(compute_body)}};
}

}  // namespace

Step frame_pose_step() {
  return {.name = "frame-pose",
          .purpose = "the poses of the frames that are asked for follow from their bodies'",
          .direction = Direction::kOutward,
          .expansion = std::string(kToAskedFrames),
          .needs = {"pose"},
          .may_use = {},
          .gives = {"frame-pose"},
          .visitors = {{Where::kEdge, {}, {}, configure_pose, compute_pose}}};
}

Step frame_twist_step(bool by_jacobian) {
  Step step = {.name = "frame-twist",
               .purpose = "the twists that are asked for, with the root's directions",
               .direction = Direction::kOutward,
               .expansion = std::string(kAcrossJoints),
               .needs = {"frame-pose", "body-twist"},
               .may_use = {},
               .gives = {"twist"},
               .visitors = motion_visitors(kTwist, kAsksTwist)};
  if (!by_jacobian) return step;
  step.name = "frame-twist-by-jacobian";
  step.purpose += "; their Jacobians, which are asked for too, give the linear part";
  step.direction = Direction::kInward;  // as the Jacobians
  step.needs.insert(step.needs.end(), {"jacobian", "velocity"});
  step.visitors = motion_visitors(kTwistByJacobian, kAsksTwist);
  return step;
}

Step frame_acceleration_step() {
  return {.name = "frame-acceleration",
          .purpose = "the accelerations that are asked for, with the root's directions",
          .direction = Direction::kOutward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"frame-pose", "body-twist", "body-acceleration"},
          .may_use = {},
          .gives = {"acceleration-twist"},
          .visitors = motion_visitors(kAcceleration, kAsksAcceleration)};
}

}  // namespace sinew::synthesis
