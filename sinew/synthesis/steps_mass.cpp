// What a robot does as a whole: centre of mass with its velocity and Jacobian, momentum, energy;
// all seen from the root and about the root's origin.
#include "sinew/synthesis/composite.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/step_list.h"

namespace sinew::synthesis {
namespace {

using algorithm::BlockSpec;
using algorithm::kNoIndex;
using algorithm::Role;

constexpr double kZero[6] = {};

BlockSpec momentum(std::string_view slot, Id represents, Id of, Id frame) {
  return {.slot = slot,
          .represents = represents,
          .quantity = "momentum",
          .of = of,
          .reference = frame,
          .seen_by = frame};
}

// A quantity of the whole robot, seen from the root.
BlockSpec whole(const Context& context, std::string_view slot, std::string_view quantity) {
  const Id body = context.robot.root_body, frame = context.robot.root_frame;
  BlockSpec spec = {.slot = slot,
                    .represents = body,
                    .quantity = quantity,
                    .of = body,
                    .label = algorithm::kWholeRobot};
  spec.wrt = spec.seen_by = spec.reference = frame;
  return spec;
}

BlockIndex total_inertia(Context& context) {
  return composite_so_far(context, context.robot.root_frame, context.robot.root_body);
}

// ---- momentum ----

void configure_own(Context& context, const Visit& visit) {
  BlockSpec spec = momentum("own-momentum", visit.node, visit["body"], visit.node);
  if (!context.has("inertia", visit["body"])) {
    spec.role = Role::kConstant;
    spec.value = kZero;
  }
  context.make(spec);
}

void compute_own(Context& context, const Visit& visit) {
  if (!context.has("inertia", visit["body"])) return;
  context.closure("momentum-from-velocity-twist",
                  {context.block("inertia", visit["body"]), context.block("body-twist", visit.node),
                   context.block("own-momentum", visit.node)},
                  visit["body"]);
}

BlockIndex momentum_so_far(const Context& context, Id frame) {
  const BlockIndex sum = context.board.find("body-momentum", frame);
  return sum != kNoIndex ? sum : context.block("own-momentum", frame);
}

void configure_sum(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto make = [&](std::string_view slot, Id of, Id frame) {
    return context.make(momentum(slot, edge.joint, of, frame));
  };
  make("momentum-at-joint", edge.successor, edge.joint_frame);
  make("momentum-at-predecessor", edge.successor, edge.parent);
  context.board.put("momentum-before", edge.joint, momentum_so_far(context, edge.parent));
  context.board.put("body-momentum", edge.parent,
                    make("momentum-with", edge.predecessor, edge.parent));
}

void compute_sum(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  const auto block = [&](std::string_view slot) { return context.block(slot, edge.joint); };
  context.closure("transform-momentum-to-proximal",
                  {block("pose-across-joint"), momentum_so_far(context, edge.child),
                   block("momentum-at-joint")},
                  edge.joint);
  context.closure(
      "transform-momentum-to-proximal",
      {block("placement"), block("momentum-at-joint"), block("momentum-at-predecessor")},
      edge.joint);
  context.closure(
      "accumulate-momentum",
      {block("momentum-before"), block("momentum-at-predecessor"), block("momentum-with")},
      edge.joint);
}

void hand_out_momentum(Context& context, const Visit& visit) {
  context.board.put("momentum", visit["body"], momentum_so_far(context, visit.node));
}

// ---- centre of mass ----

void configure_center(Context& context, const Visit&) {
  total_inertia(context);
  context.make(whole(context, "center-of-mass", "position-vector"));
}

void compute_center(Context& context, const Visit& visit) {
  context.closure("center-of-mass-from-rigid-body-inertia",
                  {total_inertia(context), context.block("center-of-mass", visit["body"])},
                  visit["body"]);
}

void configure_center_velocity(Context& context, const Visit&) {
  context.make(whole(context, "center-of-mass-velocity", "linear-velocity"));
}

void compute_center_velocity(Context& context, const Visit& visit) {
  context.closure("center-of-mass-velocity-from-momentum",
                  {total_inertia(context), momentum_so_far(context, visit.node),
                   context.block("center-of-mass-velocity", visit["body"])},
                  visit["body"]);
}

void configure_center_jacobian(Context& context, const Visit&) {
  const graph::Terms& terms = context.view.terms();
  std::uint32_t columns = 0;
  for (const RobotJoint& joint : context.robot.joints) {
    const bool floats = joint.kind == "floating";
    columns += floats ? 6 : 1;
    BlockSpec spec = whole(context, "center-of-mass-column",
                           floats ? "linear-jacobian-block" : "linear-jacobian-column");
    spec.represents = joint.joint;
    spec.prismatic = joint.kind == "prismatic";
    spec.label = joint.label.empty() ? algorithm::short_name(terms.text(joint.joint)) : joint.label;
    context.make(spec);
  }
  BlockSpec matrix = whole(context, "center-of-mass-jacobian", "linear-jacobian");
  matrix.size = 3 * columns;
  context.make(matrix);
}

void compute_center_jacobian(Context& context, const Visit& visit) {
  std::vector<BlockIndex> blocks;
  bool floats = false;
  for (const RobotJoint& joint : context.robot.joints) {
    blocks.push_back(context.block("center-of-mass-column", joint.joint));
    floats |= joint.kind == "floating";
    context.closure(joint.kind == "floating" ? "center-of-mass-columns-floating"
                                             : "center-of-mass-column-" + joint.kind,
                    {context.block("pose", joint.frame),
                     composite_so_far(context, joint.frame, joint.successor),
                     total_inertia(context), blocks.back()},
                    joint.joint);
  }
  const auto count = static_cast<std::uint32_t>(blocks.size());
  blocks.push_back(context.block("center-of-mass-jacobian", visit["body"]));
  if (floats)
    context.closure_with_counts("floating-linear-jacobian-from-columns", std::move(blocks),
                                {1, count - 1, 1}, visit["body"]);
  else
    context.closure_with_counts("linear-jacobian-from-columns", std::move(blocks), {count, 1},
                                visit["body"]);
}

// ---- energy ----

void configure_kinetic(Context& context, const Visit& visit) {
  if (!context.has("inertia", visit["body"])) return;
  context.make({.slot = "body-kinetic-energy", .represents = visit["body"], .quantity = "energy"});
  const BlockIndex before = context.board.find("kinetic-energy", context.robot.root_body);
  context.board.put("kinetic-energy-before", visit["body"], before);
  const BlockIndex sum =
      before == kNoIndex
          ? context.block("body-kinetic-energy", visit["body"])
          : context.make(
                {.slot = "kinetic-energy-with", .represents = visit["body"], .quantity = "energy"});
  context.board.put("kinetic-energy", context.robot.root_body, sum);
}

void compute_kinetic(Context& context, const Visit& visit) {
  if (!context.has("inertia", visit["body"])) return;
  const BlockIndex own = context.block("body-kinetic-energy", visit["body"]);
  context.closure(
      "kinetic-energy-from-momentum",
      {context.block("body-twist", visit.node), context.block("own-momentum", visit.node), own},
      visit["body"]);
  const BlockIndex before = context.board.find("kinetic-energy-before", visit["body"]);
  if (before != kNoIndex)
    context.closure("add-energy",
                    {before, own, context.block("kinetic-energy-with", visit["body"])},
                    visit["body"]);
}

void configure_potential(Context& context, const Visit& visit) {
  context.make({.slot = "potential-energy",
                .represents = visit["body"],
                .quantity = "energy",
                .label = algorithm::kWholeRobot});
}

void compute_potential(Context& context, const Visit& visit) {
  context.closure("potential-energy-from-rigid-body-inertia",
                  {total_inertia(context), context.block("base-acceleration", visit.node),
                   context.block("potential-energy", visit["body"])},
                  visit["body"]);
}

// A step that looks at the root alone, when the inward sweep has reached it.
Step at_root(std::string name, std::string purpose, std::vector<std::string> needs,
             std::string gives, Pass configure, Pass compute) {
  return {.name = std::move(name),
          .purpose = std::move(purpose),
          .direction = Direction::kInward,
          .expansion = std::string(kAcrossJoints),
          .needs = std::move(needs),
          .may_use = {},
          .gives = {std::move(gives)},
          .visitors = {{Where::kNode,
                        {std::string(kIsRoot)},
                        std::string(kBodyOfNode),
                        std::move(configure),
                        std::move(compute)}}};
}

}  // namespace

Step own_momentum_step() {
  return {.name = "own-momentum",
          .purpose = "each body's momentum follows from its inertia and its twist",
          .direction = Direction::kLocal,
          .expansion = std::string(kAcrossJoints),
          .needs = {"inertia", "body-twist"},
          .may_use = {},
          .gives = {"own-momentum"},
          .visitors = {{Where::kNode, {}, std::string(kBodyOfNode), configure_own, compute_own}}};
}

Step momentum_step() {
  return {
      .name = "momentum",
      .purpose = "momenta add up to that of the whole robot",
      .direction = Direction::kInward,
      .expansion = std::string(kAcrossJoints),
      .needs = {"own-momentum", "placement", "pose-across-joint"},
      .may_use = {},
      .gives = {"momentum"},
      .visitors = {
          {Where::kEdge, {}, {}, configure_sum, compute_sum},
          {Where::kNode, {std::string(kIsRoot)}, std::string(kBodyOfNode), hand_out_momentum, {}}}};
}

Step center_of_mass_step() {
  return at_root("center-of-mass", "where the first moment of all mass vanishes", {"total-inertia"},
                 "center-of-mass", configure_center, compute_center);
}

Step center_of_mass_velocity_step() {
  return at_root("center-of-mass-velocity", "all linear momentum over all mass",
                 {"total-inertia", "momentum"}, "center-of-mass-velocity",
                 configure_center_velocity, compute_center_velocity);
}

Step center_of_mass_jacobian_step() {
  return at_root("center-of-mass-jacobian", "each joint moves what hangs on it",
                 {"total-inertia", "composite-inertia", "pose"}, "center-of-mass-jacobian",
                 configure_center_jacobian, compute_center_jacobian);
}

Step kinetic_energy_step() {
  return {.name = "kinetic-energy",
          .purpose = "half of each body's twist on its momentum",
          .direction = Direction::kLocal,
          .expansion = std::string(kAcrossJoints),
          .needs = {"own-momentum", "body-twist"},
          .may_use = {},
          .gives = {"kinetic-energy"},
          .visitors = {
              {Where::kNode, {}, std::string(kBodyOfNode), configure_kinetic, compute_kinetic}}};
}

Step potential_energy_step() {
  return at_root("potential-energy", "the first moment of all mass against gravity",
                 {"total-inertia", "base-acceleration"}, "potential-energy", configure_potential,
                 compute_potential);
}

}  // namespace sinew::synthesis
