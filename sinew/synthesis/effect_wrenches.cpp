#include "sinew/synthesis/effect_wrenches.h"

namespace sinew::synthesis {
namespace {

using algorithm::kNoIndex;

// The wrench that moves the body as it moves, without what acts on it from outside.
BlockIndex inertial_wrench(const Context& context, Id frame) {
  const BlockIndex found = context.board.find("bias-inertial-wrench", frame);
  return found != kNoIndex ? found : context.block("bias-own-wrench", frame);
}

// The part of gravity, of velocity, or of both in it. Where nothing is kept apart, what acts from
// outside has been taken off already.
BlockIndex own_wrench(const Context& context, const DriverGroup& group, const Visit& visit) {
  const bool falls = context.reference != context.robot.root_body;
  if (group.velocity && !context.drivers.apart) return context.block("bias-own-wrench", visit.node);
  if (!context.has("inertia", visit["body"])) return kNoIndex;
  if (group.velocity && !falls) return inertial_wrench(context, visit.node);
  if (group.gravity && falls) return context.block("gravity-own-wrench", visit.node);
  if (group.velocity) return context.block("velocity-own-wrench", visit.node);
  return kNoIndex;
}

bool needs_velocity_alone(const Context& context) {
  return context.drivers.apart && context.reference != context.robot.root_body;
}

std::vector<BlockIndex> outer_wrenches(const Context& context, const DriverGroup& group, Id frame) {
  std::vector<BlockIndex> found;
  if (!context.drivers.apart) return found;
  for (const std::size_t index : group.wrenches) {
    const ExternalWrench& wrench = context.wrenches[index];
    if (wrench.body_frame == frame)
      found.push_back(context.block("external-wrench-alone", wrench.frame));
  }
  return found;
}

void compute_driver_wrench(Context& context, const Effect& effect, const Visit& visit) {
  const BlockIndex result = effect_block(context, "driver-wrench", effect.element, visit.node);
  if (result == kNoIndex) return;
  std::vector<BlockIndex> outer = outer_wrenches(context, *effect.group, visit.node);
  const BlockIndex own = own_wrench(context, *effect.group, visit);
  // Whatever comes last writes the result.
  BlockIndex sum = outer.empty() ? no_wrench(context, visit.node, visit["body"]) : outer.front();
  for (std::size_t i = 1; i < outer.size(); ++i) {
    const bool last = i + 1 == outer.size() && own == kNoIndex;
    const std::string slot = "driver-wrench-" + std::to_string(i);
    const BlockIndex next =
        last ? result
             : make_effect_wrench(context, effect, slot, visit.node, visit["body"], visit.node);
    context.closure("accumulate-wrench", {sum, outer[i], next}, visit["body"]);
    sum = next;
  }
  if (own != kNoIndex) context.closure("subtract-wrench", {sum, own, result}, visit["body"]);
}

}  // namespace

void configure_effect_wrenches(Context& context, const Visit& visit, std::span<const Effect> list) {
  if (context.has("inertia", visit["body"]) && needs_velocity_alone(context))
    context.make({.slot = "velocity-own-wrench",
                  .represents = visit.node,
                  .quantity = "wrench",
                  .of = visit["body"],
                  .reference = visit.node,
                  .seen_by = visit.node});
  for (const Effect& effect : list) {
    const Id key = context.pair(effect.element, visit.node);
    BlockIndex wrench = kNoIndex;
    if (effect.group != nullptr) {
      const std::vector<BlockIndex> outer = outer_wrenches(context, *effect.group, visit.node);
      const BlockIndex own = own_wrench(context, *effect.group, visit);
      if (outer.size() == 1 && own == kNoIndex) {
        wrench = outer.front();
      } else if (!outer.empty() || own != kNoIndex) {
        wrench = make_effect_wrench(context, effect, "driver-wrench", visit.node, visit["body"],
                                    visit.node);
      }
    } else {
      for (const ConstraintDirection& direction : context.drivers.directions)
        if (direction.element == effect.element &&
            context.drivers.constraints[direction.constraint].at.body_frame == visit.node)
          wrench = context.block("constraint-wrench", direction.element);
    }
    if (wrench == kNoIndex) continue;
    // What successors have handed on already comes on top.
    const BlockIndex before = context.board.find(kEffectWrench, key);
    if (before == kNoIndex) {
      context.board.put(kEffectWrench, key, wrench);
      continue;
    }
    context.board.put("effect-wrench-of-successors", key, before);
    context.board.put("effect-wrench-own", key, wrench);
    context.board.put(kEffectWrench, key,
                      make_effect_wrench(context, effect, "effect-wrench-on-body", visit.node,
                                         visit["body"], visit.node));
  }
}

void compute_effect_wrenches(Context& context, const Visit& visit, std::span<const Effect> list) {
  if (context.has("velocity-own-wrench", visit.node))
    context.closure(
        "subtract-wrench",
        {inertial_wrench(context, visit.node), context.block("gravity-own-wrench", visit.node),
         context.block("velocity-own-wrench", visit.node)},
        visit["body"]);
  for (const Effect& effect : list) {
    if (effect.group != nullptr) compute_driver_wrench(context, effect, visit);
    const BlockIndex sum =
        effect_block(context, "effect-wrench-on-body", effect.element, visit.node);
    if (sum == kNoIndex) continue;
    context.closure(
        "accumulate-wrench",
        {effect_block(context, "effect-wrench-of-successors", effect.element, visit.node),
         effect_block(context, "effect-wrench-own", effect.element, visit.node), sum},
        visit["body"]);
  }
}

void configure_wrench_past_joint(Context& context, const JointEdge& edge, const Effect& effect,
                                 std::string_view slot) {
  const std::string name(slot);
  const auto make = [&](std::string_view where, Id of, Id frame) {
    return make_effect_wrench(context, effect, name + std::string(where), edge.joint, of, frame);
  };
  make("-at-joint", edge.successor, edge.joint_frame);
  make("-at-predecessor", edge.successor, edge.parent);
  BlockIndex before = effect_block(context, slot, effect.element, edge.parent);
  if (before == kNoIndex) before = no_wrench(context, edge.parent, edge.predecessor);
  context.board.put(name + "-before", context.pair(effect.element, edge.joint), before);
  context.board.put(slot, context.pair(effect.element, edge.parent),
                    make("-with", edge.predecessor, edge.parent));
}

void compute_wrench_past_joint(Context& context, const JointEdge& edge, const Effect& effect,
                               std::string_view slot, BlockIndex wrench) {
  const auto block = [&](std::string_view where) {
    return effect_block(context, std::string(slot) + std::string(where), effect.element,
                        edge.joint);
  };
  context.closure("transform-wrench-to-proximal",
                  {context.block("pose-across-joint", edge.joint), wrench, block("-at-joint")},
                  edge.joint);
  context.closure(
      "transform-wrench-to-proximal",
      {context.block("placement", edge.joint), block("-at-joint"), block("-at-predecessor")},
      edge.joint);
  context.closure("accumulate-wrench", {block("-before"), block("-at-predecessor"), block("-with")},
                  edge.joint);
}

std::vector<std::string> needs_of_driver_wrenches(const MotionDrivers& drivers) {
  std::vector<std::string> needs = {"placement", "pose-across-joint", "inertia", "bias-own-wrench"};
  for (const DriverGroup& group : drivers.groups) {
    if (group.gravity && !group.velocity) needs.emplace_back("gravity-own-wrench");
    if (!group.joints.empty() && needs.back() != "force") needs.emplace_back("force");
  }
  return needs;
}

}  // namespace sinew::synthesis
