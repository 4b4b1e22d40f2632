// Kinetic energy, added up over the bodies, and potential energy in the field of gravity.
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/step_list.h"
#include "sinew/synthesis/whole_robot.h"

namespace sinew::synthesis {
namespace {

using algorithm::kNoIndex;

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

}  // namespace

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
