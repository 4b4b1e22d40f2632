// Forces: the wrench that moves each body as it moves, their sums from the leaves inward, and the
// share of each sum that acts along the joint.
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/motion.h"
#include "sinew/synthesis/step_list.h"

namespace sinew::synthesis {
namespace {

using algorithm::kNoIndex;
using algorithm::Role;

constexpr double kZero[6] = {};

void configure_inertia(Context& context, const Visit& visit) {
  const auto found = context.inertias.find(visit["body"]);
  if (found == context.inertias.end()) return;
  context.make({.slot = "inertia",
                .represents = visit["body"],
                .quantity = "rigid-body-inertia",
                .of = visit["body"],
                .reference = visit.node,
                .seen_by = visit.node,
                .role = Role::kConstant,
                .value = found->second});
}

algorithm::BlockSpec wrench(std::string_view slot, Id represents, Id of, Id frame) {
  return {.slot = slot,
          .represents = represents,
          .quantity = "wrench",
          .of = of,
          .reference = frame,
          .seen_by = frame};
}

// A body without inertia needs none.
void configure_own(Motion motion, Context& context, const Visit& visit) {
  const std::string slot = slot_of(motion, "own-wrench");
  algorithm::BlockSpec spec = wrench(slot, visit.node, visit["body"], visit.node);
  if (!context.has("inertia", visit["body"])) {
    spec.role = Role::kConstant;
    spec.value = kZero;
  }
  context.make(spec);
}

void compute_own(Motion motion, Context& context, const Visit& visit) {
  if (!context.has("inertia", visit["body"])) return;
  const BlockIndex inertia = context.block("inertia", visit["body"]);
  const BlockIndex acceleration = context.block(slot_of(motion, "body-acceleration"), visit.node);
  const BlockIndex own = context.block(slot_of(motion, "own-wrench"), visit.node);
  if (motion == Motion::kRest)
    context.closure("acceleration-twist-to-wrench", {inertia, acceleration, own}, visit["body"]);
  else
    context.closure("newton-euler-wrench",
                    {inertia, context.block("body-twist", visit.node), acceleration, own},
                    visit["body"]);
}

// What a body needs so far: its own wrench, and those handed on by the successors seen until now.
BlockIndex sum_so_far(Motion motion, const Context& context, Id frame) {
  const BlockIndex sum = context.board.find(slot_of(motion, "body-wrench"), frame);
  return sum != kNoIndex ? sum : context.block(slot_of(motion, "own-wrench"), frame);
}

void configure_sum(Motion motion, Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto make = [&](std::string_view slot, Id of, Id frame) {
    return context.make(wrench(slot_of(motion, slot), edge.joint, of, frame));
  };
  make("wrench-at-joint", edge.successor, edge.joint_frame);
  make("wrench-at-predecessor", edge.successor, edge.parent);
  context.board.put(slot_of(motion, "wrench-before"), edge.joint,
                    sum_so_far(motion, context, edge.parent));
  context.board.put(slot_of(motion, "body-wrench"), edge.parent,
                    make("wrench-with", edge.predecessor, edge.parent));
}

void compute_sum(Motion motion, Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto block = [&](std::string_view slot) {
    return context.block(slot_of(motion, slot), edge.joint);
  };
  context.closure("transform-wrench-to-proximal",
                  {context.block("pose-across-joint", edge.joint),
                   sum_so_far(motion, context, edge.child), block("wrench-at-joint")},
                  edge.joint);
  context.closure("transform-wrench-to-proximal",
                  {context.block("placement", edge.joint), block("wrench-at-joint"),
                   block("wrench-at-predecessor")},
                  edge.joint);
  context.closure("accumulate-wrench",
                  {block("wrench-before"), block("wrench-at-predecessor"), block("wrench-with")},
                  edge.joint);
}

void configure_force(Motion motion, Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const std::string slot = slot_of(motion, "force");
  context.make(edge.coordinate(slot, "force"));
}

void compute_force(Motion motion, Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  context.closure("force-from-wrench-" + edge.kind,
                  {sum_so_far(motion, context, edge.child),
                   context.block(slot_of(motion, "force"), edge.joint)},
                  edge.joint);
}

}  // namespace

Step inertia_step() {
  return {.name = "inertia",
          .purpose = "each body has the inertia that the model states",
          .direction = Direction::kLocal,
          .expansion = std::string(kAcrossJoints),
          .needs = {},
          .may_use = {},
          .gives = {"inertia"},
          .visitors = {{Where::kNode, {}, std::string(kBodyOfNode), configure_inertia, {}}}};
}

Step own_wrench_step(Motion motion) {
  std::vector<std::string> needs = {"inertia", slot_of(motion, "body-acceleration")};
  if (motion != Motion::kRest) needs.push_back("body-twist");
  return {.name = slot_of(motion, "own-wrench"),
          .purpose = "Newton and Euler: the wrench that moves each body" + phrase_of(motion),
          .direction = Direction::kLocal,
          .expansion = std::string(kAcrossJoints),
          .needs = needs,
          .may_use = {},
          .gives = {slot_of(motion, "own-wrench")},
          .visitors = {{Where::kNode,
                        {std::string(kIsNotRoot)},
                        std::string(kBodyOfNode),
                        std::bind_front(configure_own, motion),
                        std::bind_front(compute_own, motion)}}};
}

Step wrench_step(Motion motion) {
  return {.name = slot_of(motion, "body-wrench"),
          .purpose = "each body hands on to its predecessor what it needs" + phrase_of(motion),
          .direction = Direction::kInward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"placement", "pose-across-joint", slot_of(motion, "own-wrench")},
          .may_use = {},
          .gives = {slot_of(motion, "body-wrench")},
          .visitors = {{Where::kEdge,
                        {std::string(kParentIsNotRoot)},
                        {},
                        std::bind_front(configure_sum, motion),
                        std::bind_front(compute_sum, motion)}}};
}

Step joint_force_step(Motion motion) {
  return {.name = slot_of(motion, "joint-force"),
          .purpose = "the joint carries the part along its axis" + phrase_of(motion),
          .direction = Direction::kInward,
          .expansion = std::string(kAcrossJoints),
          .needs = {slot_of(motion, "body-wrench")},
          .may_use = {},
          .gives = {slot_of(motion, "force")},
          .visitors = {{Where::kEdge,
                        {},
                        {},
                        std::bind_front(configure_force, motion),
                        std::bind_front(compute_force, motion)}}};
}

}  // namespace sinew::synthesis
