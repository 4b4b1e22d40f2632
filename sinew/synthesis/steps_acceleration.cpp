// Acceleration twists, classical, each body's absolute and seen from the body's own frame. Gravity
// is an acceleration of the root: all is seen from an observer in free fall.
#include "sinew/synthesis/block_specs.h"
#include "sinew/synthesis/free_joint.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/motion.h"
#include "sinew/synthesis/step_list.h"

namespace sinew::synthesis {
namespace {

using algorithm::BlockSpec;

// Across the joint alone.
BlockSpec across(const JointEdge& edge, std::string_view slot, std::string_view quantity) {
  return at_frame(slot, quantity, edge.joint, edge.successor, edge.child, edge.predecessor);
}

void configure_relative(Motion motion, Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const std::string slot = slot_of(motion, "relative-acceleration");
  if (motion == Motion::kDriven && floats_freely(context, edge))
    context.make(zero(across(edge, "no-relative-twist", "velocity-twist")));
  const BlockSpec spec = across(edge, slot, "acceleration-twist");
  const FreePart part = free_part(context, edge.joint);
  context.make(part.whole != nullptr && !part.last ? zero(spec) : spec);
}

void compute_relative(Motion motion, Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const FreePart part = free_part(context, edge.joint);
  if (part.whole != nullptr && !part.last) return;
  const BlockIndex given = part.whole != nullptr ? whole_acceleration(context, *part.whole)
                                                 : context.block("acceleration", edge.joint);
  const BlockIndex relative = context.block(slot_of(motion, "relative-acceleration"), edge.joint);
  const bool floats = floats_freely(context, edge);
  const std::string operation =
      "acceleration-to-twist-" + (part.whole != nullptr ? part.whole->kind : edge.kind);
  if (floats)
    context.closure(
        operation,
        {given, context.block(at_rest(motion) ? "no-relative-twist" : "relative-twist", edge.joint),
         relative},
        edge.joint);
  else
    context.closure(operation, {given, relative}, edge.joint);
}

void configure_root(Motion motion, Context& context, const Visit& visit) {
  const std::string slot = slot_of(motion, "body-acceleration");
  if (falls(motion) && context.has("base-acceleration", visit.node)) {
    context.board.put(slot, visit.node, context.block("base-acceleration", visit.node));
    return;
  }
  context.make(zero(at_frame(slot, "acceleration-twist", visit.node, visit["body"], visit.node,
                             context.reference)));
}

// The velocity of a floating base has coordinates in its own frame: while these do not change, its
// origin may still accelerate.
bool accelerates_by_velocity(Motion motion, const Context& context, const JointEdge& edge) {
  return !at_rest(motion) && floats_freely(context, edge);
}

void configure_body(Motion motion, Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto acceleration = [&](std::string_view slot, Id represents, Id of, Id frame) {
    context.make(at_frame(slot_of(motion, slot), "acceleration-twist", represents, of, frame,
                          context.reference));
  };
  acceleration("acceleration-at-joint", edge.joint, edge.predecessor, edge.joint_frame);
  acceleration("acceleration-across-joint", edge.joint, edge.predecessor, edge.child);
  acceleration("body-acceleration", edge.child, edge.successor, edge.child);
  if (is_driven(motion)) return;
  if (!accelerates_by_velocity(motion, context, edge)) {
    context.make(zero(across(edge, "no-relative-acceleration", "acceleration-twist")));
    return;
  }
  BlockSpec still = edge.coordinate("no-acceleration", "acceleration");
  still.quantity = "floating-acceleration";
  still.prismatic = false;
  context.make(zero(still));
  context.make(across(edge, "bias-relative-acceleration", "acceleration-twist"));
}

// Of the joint alone.
BlockIndex relative_acceleration(Motion motion, Context& context, const JointEdge& edge) {
  if (motion == Motion::kFull) return context.block("relative-acceleration", edge.joint);
  if (motion == Motion::kDriven) return context.block("driven-relative-acceleration", edge.joint);
  if (!accelerates_by_velocity(motion, context, edge))
    return context.block("no-relative-acceleration", edge.joint);
  const BlockIndex bias = context.block("bias-relative-acceleration", edge.joint);
  context.closure("acceleration-to-twist-floating",
                  {context.block("no-acceleration", edge.joint),
                   context.block("relative-twist", edge.joint), bias},
                  edge.joint);
  return bias;
}

void compute_body(Motion motion, Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const BlockIndex from = context.block(slot_of(motion, "body-acceleration"), edge.parent);
  const BlockIndex at = context.block(slot_of(motion, "acceleration-at-joint"), edge.joint);
  const BlockIndex across = context.block(slot_of(motion, "acceleration-across-joint"), edge.joint);
  const BlockIndex placement = context.block("placement", edge.joint);
  const BlockIndex pose = context.block("pose-across-joint", edge.joint);
  if (at_rest(motion)) {
    context.closure("transform-acceleration-twist-to-distal-at-rest", {placement, from, at},
                    edge.joint);
    context.closure("transform-acceleration-twist-to-distal-at-rest", {pose, at, across},
                    edge.joint);
  } else {
    context.closure("transform-acceleration-twist-to-distal-fixed",
                    {placement, context.block("body-twist", edge.parent), from, at}, edge.joint);
    context.closure("transform-acceleration-twist-to-distal",
                    {pose, context.block("twist-at-joint", edge.joint),
                     context.block("relative-twist", edge.joint), at, across},
                    edge.joint);
  }
  const BlockIndex relative = relative_acceleration(motion, context, edge);
  context.closure(
      "add-acceleration-twist",
      {across, relative, context.block(slot_of(motion, "body-acceleration"), edge.child)},
      edge.child);
}

void compute_gravity(Context& context, const Visit& visit) {
  context.closure(
      "base-acceleration-from-gravity",
      {context.block("gravity", visit.node), context.block("base-acceleration", visit.node)},
      visit.node);
}

}  // namespace

Step gravity_step() {
  return {.name = "gravity",
          .purpose = "seen from what falls freely, the base accelerates against gravity",
          .direction = Direction::kOutward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"gravity"},
          .may_use = {},
          .gives = {"base-acceleration"},
          .visitors = {{Where::kNode, {std::string(kIsRoot)}, {}, {}, compute_gravity}}};
}

Step joint_acceleration_step(Motion motion) {
  std::vector<std::string> needs = {"acceleration"};
  if (!at_rest(motion)) needs.emplace_back("relative-twist");
  return {.name = slot_of(motion, "joint-acceleration"),
          .purpose = "the relative acceleration across each joint follows from the joint's" +
                     phrase_of(motion),
          .direction = Direction::kOutward,
          .expansion = std::string(kAcrossJoints),
          .needs = needs,
          .may_use = {},
          .gives = {slot_of(motion, "relative-acceleration")},
          .visitors = {{Where::kEdge,
                        {},
                        {},
                        std::bind_front(configure_relative, motion),
                        std::bind_front(compute_relative, motion)}}};
}

Step acceleration_step(Motion motion) {
  std::vector<std::string> needs = {"placement", "pose-across-joint"};
  if (!at_rest(motion)) needs.insert(needs.end(), {"body-twist", "relative-twist"});
  if (is_driven(motion)) needs.push_back(slot_of(motion, "relative-acceleration"));
  std::vector<std::string> may_use;
  if (falls(motion)) may_use.emplace_back("base-acceleration");
  return {.name = slot_of(motion, "body-acceleration"),
          .purpose = "accelerations add up from the root outward" + phrase_of(motion),
          .direction = Direction::kOutward,
          .expansion = std::string(kAcrossJoints),
          .needs = needs,
          .may_use = may_use,
          .gives = {slot_of(motion, "body-acceleration")},
          .visitors = {{Where::kNode,
                        {std::string(kIsRoot)},
                        std::string(kBodyOfNode),
                        std::bind_front(configure_root, motion),
                        {}},
                       {Where::kEdge,
                        {},
                        {},
                        std::bind_front(configure_body, motion),
                        std::bind_front(compute_body, motion)}}};
}

}  // namespace sinew::synthesis
