// What a robot does as a whole: centre of mass with its velocity and Jacobian, and momentum; all
// seen from the root, and about its origin or the centre of mass.
#include "sinew/synthesis/block_specs.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/step_list.h"
#include "sinew/synthesis/whole_robot.h"

namespace sinew::synthesis {
namespace {

using algorithm::BlockSpec;
using algorithm::kNoIndex;

BlockSpec momentum(std::string_view slot, Id represents, Id of, Id frame) {
  return at_frame(slot, "momentum", represents, of, frame);
}

// ---- momentum ----

void configure_own(Context& context, const Visit& visit) {
  const BlockSpec spec = momentum("own-momentum", visit.node, visit["body"], visit.node);
  context.make(context.has("inertia", visit["body"]) ? spec : zero(spec));
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

constexpr ColumnsOfJoints kCenterJacobian = {
    .column = "center-of-mass-column",
    .matrix = "center-of-mass-jacobian",
    .column_quantity = "linear-jacobian-column",
    .block_quantity = "linear-jacobian-block",
    .matrix_quantity = "linear-jacobian",
    .rows = 3,
    .column_operator = "center-of-mass-column",
    .columns_operator = "center-of-mass-columns",
    .assemble = "linear-jacobian-from-columns",
    .assemble_floating = "floating-linear-jacobian-from-columns"};

void configure_center_jacobian(Context& context, const Visit&) {
  configure_columns(context, kCenterJacobian, whole(context, "", ""));
}

void compute_center_jacobian(Context& context, const Visit&) {
  compute_columns(context, kCenterJacobian, total_inertia(context));
}

// ---- about the centre of mass ----

BlockSpec about_center(Context& context, std::string_view slot, std::string_view quantity) {
  BlockSpec spec = whole(context, slot, quantity);
  spec.wrt = {};
  spec.reference = context.robot.root_body;
  return spec;
}

void configure_centroidal(Context& context, const Visit&) {
  context.make(about_center(context, "centroidal-momentum", "momentum"));
}

void compute_centroidal(Context& context, const Visit& visit) {
  context.closure(
      "momentum-about-center-of-mass",
      {momentum_so_far(context, visit.node), context.block("center-of-mass", visit["body"]),
       context.block("centroidal-momentum", visit["body"])},
      visit["body"]);
}

constexpr ColumnsOfJoints kMomentumMatrix = {
    .column = "centroidal-momentum-column",
    .matrix = "centroidal-momentum-matrix",
    .column_quantity = "momentum-column",
    .block_quantity = "momentum-block",
    .matrix_quantity = "momentum-matrix",
    .rows = 6,
    .column_operator = "centroidal-momentum-column",
    .columns_operator = "centroidal-momentum-columns",
    .assemble = "momentum-matrix-from-columns",
    .assemble_floating = "floating-momentum-matrix-from-columns"};

void configure_momentum_matrix(Context& context, const Visit&) {
  configure_columns(context, kMomentumMatrix, about_center(context, "", ""));
}

void compute_momentum_matrix(Context& context, const Visit& visit) {
  compute_columns(context, kMomentumMatrix, context.block("center-of-mass", visit["body"]));
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

Step centroidal_momentum_step() {
  return at_root("centroidal-momentum", "momentum about the centre of mass",
                 {"momentum", "center-of-mass"}, "centroidal-momentum", configure_centroidal,
                 compute_centroidal);
}

Step centroidal_momentum_matrix_step() {
  return at_root("centroidal-momentum-matrix",
                 "each joint gives momentum to what hangs on it (Orin and Goswami 2008)",
                 {"center-of-mass", "composite-inertia", "pose"}, "centroidal-momentum-matrix",
                 configure_momentum_matrix, compute_momentum_matrix);
}

}  // namespace sinew::synthesis
