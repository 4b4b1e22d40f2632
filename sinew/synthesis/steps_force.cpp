// Forces: the wrench that moves each body as it moves, their sums from the leaves inward, and the
// share of each sum that acts along the joint.
#include "sinew/synthesis/block_specs.h"
#include "sinew/synthesis/free_joint.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/motion.h"
#include "sinew/synthesis/needed_wrench.h"
#include "sinew/synthesis/rotor.h"
#include "sinew/synthesis/step_list.h"

namespace sinew::synthesis {
namespace {

using algorithm::kNoIndex;
using algorithm::Role;

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
  return at_frame(slot, "wrench", represents, of, frame);
}

// Whether wrenches from outside already help to move the body here.
bool helped(Motion motion, const Context& context, Id frame) {
  if (at_rest(motion) || !context.has("external-wrench", frame)) return false;
  return motion != Motion::kFull || context.query.forces == Forces::kTogether;
}

// The revolute joint before a body on which nothing hangs, if its wrench is best computed in the
// joint's frame: see newton_euler_across_revolute in math/inertia.h. What joint accelerations alone
// take is computed beside what velocities take, which has turned the inertia already.
const RobotJoint* joint_before_last(Motion motion, const Context& context, const Visit& visit) {
  if (motion == Motion::kRest || !context.has("inertia", visit["body"])) return nullptr;
  if (helped(motion, context, visit.node)) return nullptr;
  const RobotJoint* before = nullptr;
  for (const RobotJoint& joint : context.robot.joints) {
    if (joint.parent_frame == visit.node) return nullptr;
    if (joint.frame == visit.node) before = &joint;
  }
  const bool turns = before != nullptr && before->kind == "revolute" &&
                     free_part(context, before->joint).whole == nullptr;
  return turns && before->parent_frame != context.robot.root_frame ? before : nullptr;
}

// A body without inertia needs none.
void configure_own(Motion motion, Context& context, const Visit& visit) {
  if (const RobotJoint* joint = joint_before_last(motion, context, visit)) {
    context.make(wrench(slot_of(motion, "own-wrench-at-joint"), joint->joint, visit["body"],
                        joint->joint_frame));
    context.make({.slot = slot_of(motion, "inverse-pose-across-joint"),
                  .represents = joint->joint,
                  .quantity = "pose",
                  .of = joint->joint_frame,
                  .wrt = visit.node});
  }
  const bool with_help = helped(motion, context, visit.node);
  if (with_help)
    context.make(wrench(slot_of(motion, "own-wrench"), visit.node, visit["body"], visit.node));
  const std::string slot = slot_of(motion, with_help ? "inertial-wrench" : "own-wrench");
  const algorithm::BlockSpec spec = wrench(slot, visit.node, visit["body"], visit.node);
  context.make(context.has("inertia", visit["body"]) ? spec : zero(spec));
}

void compute_inertial(Motion motion, Context& context, const Visit& visit, BlockIndex wrench) {
  if (!context.has("inertia", visit["body"])) return;
  const BlockIndex inertia = context.block("inertia", visit["body"]);
  const BlockIndex acceleration = context.block(slot_of(motion, "body-acceleration"), visit.node);
  if (at_rest(motion))
    context.closure("acceleration-twist-to-wrench", {inertia, acceleration, wrench}, visit["body"]);
  else
    context.closure("newton-euler-wrench",
                    {inertia, context.block("body-twist", visit.node), acceleration, wrench},
                    visit["body"]);
}

// At the joint, and what whoever asks for it sees from the body.
void compute_at_joint(Motion motion, Context& context, const Visit& visit, const RobotJoint& joint,
                      BlockIndex own) {
  const BlockIndex at_joint = context.block(slot_of(motion, "own-wrench-at-joint"), joint.joint);
  const BlockIndex pose = context.block("pose-across-joint", joint.joint);
  const BlockIndex inertia = context.block("inertia", visit["body"]);
  const BlockIndex acceleration =
      context.block(slot_of(motion, "acceleration-at-joint"), joint.joint);
  const BlockIndex relative =
      context.block(is_driven(motion) ? slot_of(motion, "relative-acceleration")
                                      : std::string("no-relative-acceleration"),
                    joint.joint);
  if (at_rest(motion))
    context.closure("acceleration-twist-to-wrench-across-revolute",
                    {pose, inertia, acceleration, relative, at_joint}, visit["body"]);
  else
    context.closure(
        "newton-euler-wrench-across-revolute",
        {pose, inertia, context.block("twist-at-joint", joint.joint),
         context.block("relative-twist", joint.joint), acceleration, relative, at_joint},
        visit["body"]);
  const BlockIndex inverse =
      context.block(slot_of(motion, "inverse-pose-across-joint"), joint.joint);
  context.closure("invert-pose", {pose, inverse}, visit["body"]);
  context.closure("transform-wrench-to-proximal", {inverse, at_joint, own}, visit["body"]);
}

void compute_own(Motion motion, Context& context, const Visit& visit) {
  const BlockIndex own = context.block(slot_of(motion, "own-wrench"), visit.node);
  if (const RobotJoint* joint = joint_before_last(motion, context, visit)) {
    compute_at_joint(motion, context, visit, *joint, own);
    return;
  }
  if (!helped(motion, context, visit.node)) {
    compute_inertial(motion, context, visit, own);
    return;
  }
  const BlockIndex inertial = context.block(slot_of(motion, "inertial-wrench"), visit.node);
  compute_inertial(motion, context, visit, inertial);
  context.closure("subtract-wrench", {inertial, context.block("external-wrench", visit.node), own},
                  visit["body"]);
}

}  // namespace

BlockIndex needed_wrench_so_far(Motion motion, const Context& context, Id frame) {
  const BlockIndex sum = context.board.find(slot_of(motion, "body-wrench"), frame);
  return sum != kNoIndex ? sum : context.block(slot_of(motion, "own-wrench"), frame);
}

namespace {

// What the body behind a joint needs for itself alone, where that has been computed at the joint.
BlockIndex own_wrench_at_joint(Motion motion, const Context& context, const JointEdge& edge) {
  if (context.board.find(slot_of(motion, "body-wrench"), edge.child) != kNoIndex) return kNoIndex;
  return context.board.find(slot_of(motion, "own-wrench-at-joint"), edge.joint);
}

void configure_sum(Motion motion, Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto make = [&](std::string_view slot, Id of, Id frame) {
    return context.make(wrench(slot_of(motion, slot), edge.joint, of, frame));
  };
  const BlockIndex own = own_wrench_at_joint(motion, context, edge);
  if (own != kNoIndex)
    context.board.put(slot_of(motion, "wrench-at-joint"), edge.joint, own);
  else
    make("wrench-at-joint", edge.successor, edge.joint_frame);
  make("wrench-at-predecessor", edge.successor, edge.parent);
  context.board.put(slot_of(motion, "wrench-before"), edge.joint,
                    needed_wrench_so_far(motion, context, edge.parent));
  context.board.put(slot_of(motion, "body-wrench"), edge.parent,
                    make("wrench-with", edge.predecessor, edge.parent));
}

void compute_sum(Motion motion, Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto block = [&](std::string_view slot) {
    return context.block(slot_of(motion, slot), edge.joint);
  };
  if (own_wrench_at_joint(motion, context, edge) == kNoIndex)
    context.closure("transform-wrench-to-proximal",
                    {context.block("pose-across-joint", edge.joint),
                     needed_wrench_so_far(motion, context, edge.child), block("wrench-at-joint")},
                    edge.joint);
  context.closure("transform-wrench-to-proximal",
                  {context.block("placement", edge.joint), block("wrench-at-joint"),
                   block("wrench-at-predecessor")},
                  edge.joint);
  context.closure("accumulate-wrench",
                  {block("wrench-before"), block("wrench-at-predecessor"), block("wrench-with")},
                  edge.joint);
}

// Where forces are kept apart: the wrenches that act behind this joint.
std::vector<Id> shares(Motion motion, Context& context, const JointEdge& edge) {
  std::vector<Id> pairs;
  if (motion != Motion::kFull || context.query.forces == Forces::kTogether) return pairs;
  for (const ExternalWrench& one : context.wrenches) {
    const Id pair = context.pair(edge.joint, one.frame);
    if (context.has("force-share", pair)) pairs.push_back(pair);
  }
  return pairs;
}

// Without the shares of wrenches, then with one more each time; the last sum is the joint's force.
void configure_force(Motion motion, Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const std::vector<Id> pairs = shares(motion, context, edge);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    algorithm::BlockSpec spec = edge.coordinate("force-so-far", "force");
    if (i > 0) spec.represents = pairs[i];
    context.make(spec);
  }
  const std::string slot = slot_of(motion, "force");
  context.make(edge.coordinate(slot, "force"));
  if (is_driven(motion)) make_rotor(context, edge, pairs.empty() ? slot : "force-so-far");
}

void compute_force(Motion motion, Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const std::vector<Id> pairs = shares(motion, context, edge);
  const BlockIndex force = context.block(slot_of(motion, "force"), edge.joint);
  BlockIndex sum = pairs.empty() ? force : context.block("force-so-far", edge.joint);
  const BlockIndex wrench = needed_wrench_so_far(motion, context, edge.child);
  if (is_driven(motion) && has_rotor(context, edge.joint))
    compute_with_rotor(context, edge, "force-with-rotor", wrench,
                       {context.block("acceleration", edge.joint)}, sum);
  else
    context.closure("force-from-wrench-" + edge.kind, {wrench, sum}, edge.joint);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const BlockIndex next =
        i + 1 < pairs.size() ? context.block("force-so-far", pairs[i + 1]) : force;
    context.closure(edge.floats() ? "add-floating-force" : "add-joint-force",
                    {sum, context.block("force-share", pairs[i]), next}, edge.joint);
    sum = next;
  }
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
  if (!at_rest(motion))
    needs.insert(needs.end(), {"body-twist", "pose-across-joint", "relative-twist"});
  if (motion == Motion::kDriven)
    needs.insert(needs.end(), {"pose-across-joint", slot_of(motion, "relative-acceleration")});
  return {.name = slot_of(motion, "own-wrench"),
          .purpose = "Newton and Euler: the wrench that moves each body" + phrase_of(motion),
          .direction = Direction::kLocal,
          .expansion = std::string(kAcrossJoints),
          .needs = needs,
          .may_use = {"external-wrench", "external-wrench-from-base"},
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
          .may_use = {slot_of(motion, "control-wrench")},
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
          .may_use = {"force-share"},
          .gives = {slot_of(motion, "force")},
          .visitors = {{Where::kEdge,
                        {},
                        {},
                        std::bind_front(configure_force, motion),
                        std::bind_front(compute_force, motion)}}};
}

}  // namespace sinew::synthesis
