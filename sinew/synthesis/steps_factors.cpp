// Factors of the mass matrix, whose zeros are where joints are on different branches (Featherstone
// 2008, chapter 6), and forward dynamics by them: for robots in which some joints follow others,
// and to compare with.
#include "sinew/synthesis/coordinates.h"
#include "sinew/synthesis/factors.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/results.h"
#include "sinew/synthesis/step_list.h"
#include "sinew/synthesis/weightless.h"
#include "sinew/synthesis/whole_robot.h"

namespace sinew::synthesis {
namespace {

using algorithm::BlockSpec;
using algorithm::Role;

BlockIndex make_factor(Context& context, std::string_view slot, std::string_view quantity,
                       Id body) {
  const std::uint32_t n = width(context);
  return context.make({.slot = slot,
                       .represents = body,
                       .quantity = quantity,
                       .size = n * n,
                       .label = algorithm::kWholeRobot});
}

BlockIndex mass_matrix(Context& context, Id body) {
  return coupled_matrix(context, context.block("mass-matrix", body));
}

void factorise(Context& context, Id body, std::string_view operation, BlockIndex factor) {
  context.closure_with_counts(operation, {mass_matrix(context, body), make_width(context), factor},
                              {1, 1, 1}, body);
}

void configure_cholesky(Context& context, const Visit& visit) {
  make_factor(context, "cholesky-factor", "cholesky-factor", visit["body"]);
}

void compute_cholesky(Context& context, const Visit& visit) {
  factorise(context, visit["body"], "factorise-mass-matrix",
            context.block("cholesky-factor", visit["body"]));
}

void configure_decomposition(Context& context, const Visit& visit) {
  make_factor(context, "mass-matrix-decomposition", "mass-matrix-decomposition", visit["body"]);
}

void compute_decomposition(Context& context, const Visit& visit) {
  factorise(context, visit["body"], "decompose-mass-matrix",
            context.block("mass-matrix-decomposition", visit["body"]));
}

// A force of every coordinate, one after the other; of those that are driven, as they are driven.
BlockIndex all_forces(Context& context, std::string_view slot) {
  const std::string own_slot = "all-" + std::string(slot);
  const BlockIndex all = context.make(of_all(context, own_slot, "joint-forces"));
  join_forces(
      context,
      [&](std::size_t part) {
        return slot == "force" ? context.block(slot, context.robot.joints[part].joint)
                               : coupled_force(context, slot, part);
      },
      all);
  return all;
}

void configure_result(Context& context, const Visit&) {
  context.make(of_all(context, "all-acceleration", "joint-accelerations"));
}

void compute_result(Context& context, const Visit& visit) {
  const Id body = visit["body"];
  const BlockIndex all = context.block("all-acceleration", body);
  context.closure_with_counts(
      "acceleration-from-decomposition",
      {context.block("mass-matrix-decomposition", body), all_forces(context, "force"),
       all_forces(context, "bias-force"), make_width(context), all},
      {1, 1, 1, 1, 1}, body);
  take_all(context, "acceleration", all);
}

}  // namespace

Step cholesky_step() {
  return at_root("cholesky-factor", "the lower triangular L of M = L^T L, sparse as the tree is",
                 {"mass-matrix"}, "cholesky-factor", configure_cholesky, compute_cholesky);
}

Step mass_matrix_decomposition_step() {
  Step step = at_root("mass-matrix-decomposition", "L and D of M = L^T D L, sparse as the tree is",
                      {"mass-matrix"}, "mass-matrix-decomposition", configure_decomposition,
                      compute_decomposition);
  step.visitors.push_back(refuse_weightless());
  return step;
}

Step forward_dynamics_by_decomposition_step() {
  return at_root("forward-dynamics-by-decomposition",
                 "accelerations are what the mass matrix makes of forces beyond the bias",
                 {"mass-matrix-decomposition", "force", "bias-force"}, "acceleration",
                 configure_result, compute_result);
}

}  // namespace sinew::synthesis
