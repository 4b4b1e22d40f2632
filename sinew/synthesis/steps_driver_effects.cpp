// The inward sweep of hybrid dynamics. Each driver, and each unit constraint force, is a wrench on
// bodies and a force at joints. At a joint that gives way, what reaches it is
//   e = tau + S' F,
// the joint accelerates by e / D, and F - U e / D goes on to the predecessor (Vereshchagin 1989,
// equations b and c; for one driver alone it is the articulated-body algorithm's bias force,
// Featherstone 2008, equation 7.28). Since all is linear in e, each effect travels by itself and
// keeps its origin.
#include "sinew/synthesis/effect_wrenches.h"
#include "sinew/synthesis/hybrid_steps.h"

namespace sinew::synthesis {
namespace {

using algorithm::kNoIndex;

constexpr std::string_view kWrench = "effect-wrench";

void configure_body(Context& context, const Visit& visit) {
  configure_effect_wrenches(context, visit, effects(context));
}

void compute_body(Context& context, const Visit& visit) {
  compute_effect_wrenches(context, visit, effects(context));
}

BlockIndex given_force(const Context& context, const Effect& effect, const JointEdge& edge) {
  if (effect.group == nullptr || !effect.group->has_joint(edge.joint)) return kNoIndex;
  return context.board.find("force", edge.joint);
}

void configure_joint(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  for (const Effect& effect : effects(context)) {
    const BlockIndex wrench = effect_block(context, kWrench, effect.element, edge.child);
    const BlockIndex force = given_force(context, effect, edge);
    if (wrench == kNoIndex && force == kNoIndex) continue;
    if (wrench == kNoIndex)
      context.board.put("effect-force", context.pair(effect.element, edge.joint), force);
    else
      make_joint_effect(context, edge, effect, "effect-force", "force");
    if (wrench != kNoIndex && force != kNoIndex)
      make_joint_effect(context, edge, effect, "effect-force-of-wrench", "force");
    make_joint_effect(context, edge, effect, "effect-acceleration", "acceleration");
    if (edge.parent == context.robot.root_frame) continue;
    make_effect_wrench(context, effect, "effect-wrench-released", edge.joint, edge.successor,
                       edge.child);
    configure_wrench_past_joint(context, edge, effect, kEffectWrench);
  }
}

void compute_force(Context& context, const JointEdge& edge, const Effect& effect) {
  const auto block = [&](std::string_view slot) {
    return effect_block(context, slot, effect.element, edge.joint);
  };
  const BlockIndex wrench = effect_block(context, kWrench, effect.element, edge.child);
  const BlockIndex force = given_force(context, effect, edge);
  if (wrench != kNoIndex) {
    const BlockIndex of_wrench =
        force == kNoIndex ? block("effect-force") : block("effect-force-of-wrench");
    context.closure("force-from-wrench-" + edge.kind, {wrench, of_wrench}, edge.joint);
    if (force != kNoIndex)
      context.closure(edge.floats() ? "add-floating-force" : "add-joint-force",
                      {force, of_wrench, block("effect-force")}, edge.joint);
  }
  if (!edge.floats()) {
    context.closure("joint-acceleration-from-drive",
                    {block("effect-force"), context.block("unit-force", edge.joint),
                     block("effect-acceleration")},
                    edge.joint);
    return;
  }
  // A floating base: the world behind it does not move.
  BlockIndex inertia = context.board.find("articulated-inertia", edge.child);
  if (inertia == kNoIndex) inertia = context.block("own-articulated-inertia", edge.child);
  context.closure("floating-acceleration-from-force",
                  {inertia, block("effect-force"), block("effect-acceleration")}, edge.joint);
}

void compute_joint(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  for (const Effect& effect : effects(context)) {
    const auto block = [&](std::string_view slot) {
      return effect_block(context, slot, effect.element, edge.joint);
    };
    if (block("effect-force") == kNoIndex) continue;
    compute_force(context, edge, effect);
    if (edge.parent == context.robot.root_frame) continue;
    BlockIndex wrench = effect_block(context, kWrench, effect.element, edge.child);
    if (wrench == kNoIndex) wrench = no_wrench(context, edge.child, edge.successor);
    context.closure("release-wrench",
                    {wrench, context.block("unit-wrench", edge.joint), block("effect-acceleration"),
                     block("effect-wrench-released")},
                    edge.joint);
    compute_wrench_past_joint(context, edge, effect, kEffectWrench,
                              block("effect-wrench-released"));
  }
}

}  // namespace

Step driver_effects_step(const MotionDrivers& drivers) {
  std::vector<std::string> needs = needs_of_driver_wrenches(drivers);
  needs.insert(needs.end(), {"unit-wrench", "unit-force"});
  if (!drivers.constraints.empty()) needs.emplace_back("constraint-wrench");
  return {.name = "driver-effects",
          .purpose = "what reaches each joint of each driver and each unit constraint force",
          .direction = Direction::kInward,
          .expansion = std::string(kAcrossJoints),
          .needs = needs,
          .may_use = {"external-wrench", "external-wrench-from-base"},
          .gives = {"effect-force"},
          .visitors = {{Where::kNode,
                        {std::string(kIsNotRoot)},
                        std::string(kBodyOfNode),
                        configure_body,
                        compute_body},
                       {Where::kEdge, {}, {}, configure_joint, compute_joint}}};
}

}  // namespace sinew::synthesis
