// Hybrid dynamics where some joints follow others (coupled_drives.h): the effects of drivers and of
// unit constraint forces, and the accelerations.
#include "sinew/synthesis/coordinates.h"
#include "sinew/synthesis/coupled_drives.h"
#include "sinew/synthesis/drivers.h"
#include "sinew/synthesis/effect_wrenches.h"
#include "sinew/synthesis/factors.h"
#include "sinew/synthesis/hybrid_steps.h"
#include "sinew/synthesis/results.h"
#include "sinew/synthesis/whole_robot.h"

namespace sinew::synthesis {

using algorithm::BlockSpec;
using algorithm::kNoIndex;

BlockIndex drive_of(Context& context, Id effect) { return context.block("effect-drive", effect); }

void energy_of_drives(Context& context, Id effect, Id other, BlockIndex energy, Id about) {
  context.closure_with_counts(
      "acceleration-energy-of-drives",
      {context.block("mass-matrix-decomposition", context.robot.root_body),
       drive_of(context, effect), drive_of(context, other), make_width(context), energy},
      {1, 1, 1, 1, 1}, about);
}

namespace {

// ---- inward, joints held: the force that replaces the wrenches of a group of drivers ----

constexpr std::string_view kWrench = "effect-wrench";

std::vector<Effect> of_groups(const Context& context) {
  std::vector<Effect> list = effects(context);
  std::erase_if(list, [](const Effect& effect) { return effect.group == nullptr; });
  return list;
}

void configure_body(Context& context, const Visit& visit) {
  configure_effect_wrenches(context, visit, of_groups(context));
}

void compute_body(Context& context, const Visit& visit) {
  compute_effect_wrenches(context, visit, of_groups(context));
}

void configure_joint(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  for (const Effect& effect : of_groups(context)) {
    if (effect_block(context, kWrench, effect.element, edge.child) == kNoIndex) continue;
    make_joint_effect(context, edge, effect, "held-force", "force");
    if (edge.parent != context.robot.root_frame)
      configure_wrench_past_joint(context, edge, effect, kEffectWrench);
  }
}

void compute_joint(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  for (const Effect& effect : of_groups(context)) {
    const BlockIndex wrench = effect_block(context, kWrench, effect.element, edge.child);
    if (wrench == kNoIndex) continue;
    const BlockIndex force = effect_block(context, "held-force", effect.element, edge.joint);
    context.closure("force-from-wrench-" + edge.kind, {wrench, force}, edge.joint);
    if (edge.parent != context.robot.root_frame)
      compute_wrench_past_joint(context, edge, effect, kEffectWrench, wrench);
  }
}

// ---- at the root: forces of all coordinates, and what drives each of them ----

BlockSpec of_effect(const Context& context, const Effect& effect, std::string_view slot) {
  BlockSpec spec = of_all(context, slot, "joint-forces");
  spec.represents = effect.element;
  spec.label = effect.label;
  return spec;
}

void configure_drives(Context& context, const Visit&) {
  for (const Effect& effect : effects(context))
    for (const std::string_view slot : {"effect-forces", "effect-drive"})
      context.make(of_effect(context, effect, slot));
}

BlockIndex make_for(Context& context, const Effect& effect, std::size_t part,
                    std::string_view slot) {
  const RobotJoint& joint = context.robot.joints[part];
  BlockSpec spec = joint_quantity("force", joint);
  const std::string name =
      std::string(effect.label) + "." +
      std::string(joint.label.empty()
                      ? algorithm::short_name(context.view.terms().text(joint.joint))
                      : std::string_view(joint.label));
  spec.slot = slot;
  spec.represents = context.pair(effect.element, joint.joint);
  spec.label = name;
  return context.make(spec);
}

BlockIndex no_force_of(Context& context, const RobotJoint& joint) {
  constexpr double zero[6] = {};
  BlockSpec spec = joint_quantity("force", joint);
  spec.slot = "no-joint-force";
  spec.role = algorithm::Role::kConstant;
  spec.value = std::span(zero).first(joint.kind == "floating" ? 6 : 1);
  return context.make(spec);
}

// The force of an effect on one coordinate: what is given for it, and what reaches it and all that
// follow it.
BlockIndex force_on(Context& context, const Effect& effect, std::size_t part) {
  const RobotJoint& joint = context.robot.joints[part];
  if (effect.group == nullptr) {
    const BlockIndex lever = coupled_effect(context, "constraint-lever", effect.element, part);
    return lever != kNoIndex ? lever : no_force_of(context, joint);
  }
  const BlockIndex held = coupled_effect(context, "held-force", effect.element, part);
  const BlockIndex given =
      effect.group->has_joint(joint.joint) ? context.board.find("force", joint.joint) : kNoIndex;
  if (held == kNoIndex) return given != kNoIndex ? given : no_force_of(context, joint);
  if (given == kNoIndex) return held;
  const BlockIndex sum = make_for(context, effect, part, "force-on-coordinate");
  context.closure(joint.kind == "floating" ? "add-floating-force" : "add-joint-force",
                  {given, held, sum}, joint.joint);
  return sum;
}

void compute_drives(Context& context, const Visit& visit) {
  const BlockIndex factors = context.block("mass-matrix-decomposition", visit["body"]);
  for (const Effect& effect : effects(context)) {
    const BlockIndex forces = context.block("effect-forces", effect.element);
    join_forces(
        context, [&](std::size_t part) { return force_on(context, effect, part); }, forces);
    context.closure_with_counts(
        "drive-from-decomposition",
        {factors, forces, make_width(context), drive_of(context, effect.element)}, {1, 1, 1, 1},
        visit["body"]);
  }
}

// ---- accelerations ----

struct Sum {
  std::vector<BlockIndex> drives, magnitudes;
  void add(BlockIndex drive, BlockIndex magnitude) {
    drives.push_back(drive);
    magnitudes.push_back(magnitude);
  }
};

// From a sum of drives to the accelerations of all coordinates.
void accelerate(Context& context, Sum sum, BlockIndex drive, BlockIndex accelerations) {
  const Id body = context.robot.root_body;
  const auto count = static_cast<std::uint32_t>(sum.drives.size());
  std::vector<BlockIndex> arguments = std::move(sum.drives);
  arguments.insert(arguments.end(), sum.magnitudes.begin(), sum.magnitudes.end());
  arguments.insert(arguments.end(), {make_width(context), drive});
  context.closure_with_counts("weigh-drives", std::move(arguments), {count, count, 1, 1}, body);
  context.closure_with_counts(
      "acceleration-from-drive",
      {context.block("mass-matrix-decomposition", body), drive, make_width(context), accelerations},
      {1, 1, 1, 1}, body);
}

void configure_all(Context& context, const Visit&) {
  context.make(of_all(context, "constrained-drive", "joint-forces"));
  context.make(of_all(context, "all-acceleration", "joint-accelerations"));
}

void compute_all(Context& context, const Visit& visit) {
  Sum sum;
  for (const DriverGroup& group : context.drivers.groups)
    sum.add(drive_of(context, group.element), driver_weight(context, group));
  for (const ConstraintDirection& direction : context.drivers.directions)
    sum.add(drive_of(context, direction.element),
            context.block("constraint-magnitude", direction.element));
  const BlockIndex all = context.block("all-acceleration", visit["body"]);
  accelerate(context, std::move(sum), context.block("constrained-drive", visit["body"]), all);
  take_all(context, "acceleration", all);
}

void configure_alone(Context& context, const Visit&) {
  for (const Effect& effect : of_groups(context)) {
    context.make(of_effect(context, effect, "driver-drive"));
    BlockSpec spec = of_effect(context, effect, "all-driver-acceleration");
    spec.quantity = "joint-accelerations";
    context.make(spec);
  }
}

void compute_alone(Context& context, const Visit&) {
  for (const Effect& effect : of_groups(context)) {
    Sum sum;
    sum.add(drive_of(context, effect.element), times(context, 1));
    for (const ConstraintDirection& direction : context.drivers.directions)
      sum.add(drive_of(context, direction.element),
              effect_block(context, "driver-magnitude", direction.element, effect.element));
    const BlockIndex all = context.block("all-driver-acceleration", effect.element);
    accelerate(context, std::move(sum), context.block("driver-drive", effect.element), all);
    take_all_of(context, "driver-acceleration", "acceleration", all, effect.element, effect.label);
  }
}

}  // namespace

Step held_forces_step(const MotionDrivers& drivers) {
  return {.name = "held-forces",
          .purpose = "what reaches each joint of each driver while all joints are held",
          .direction = Direction::kInward,
          .expansion = std::string(kAcrossJoints),
          .needs = needs_of_driver_wrenches(drivers),
          .may_use = {"external-wrench", "external-wrench-from-base"},
          .gives = {"held-force"},
          .visitors = {{Where::kNode,
                        {std::string(kIsNotRoot)},
                        std::string(kBodyOfNode),
                        configure_body,
                        compute_body},
                       {Where::kEdge, {}, {}, configure_joint, compute_joint}}};
}

Step coupled_effects_step(const MotionDrivers& drivers) {
  std::vector<std::string> needs = {"held-force", "mass-matrix-decomposition"};
  if (!drivers.constraints.empty()) needs.emplace_back("constraint-lever");
  return at_root("coupled-effects",
                 "what drives each coordinate, with the joints that follow it, because of each "
                 "driver and each unit constraint force",
                 needs, "effect-force", configure_drives, compute_drives);
}

Step coupled_acceleration_step(const MotionDrivers& drivers) {
  return at_root("coupled-acceleration",
                 "accelerations of all coordinates under all drivers, from the base outward",
                 with_weights({"effect-force", "mass-matrix-decomposition"}, drivers),
                 "acceleration", configure_all, compute_all);
}

Step coupled_driver_acceleration_step(const MotionDrivers& drivers) {
  std::vector<std::string> needs = {"effect-force", "mass-matrix-decomposition"};
  if (!drivers.constraints.empty()) needs.emplace_back("driver-magnitude");
  return at_root("coupled-driver-acceleration",
                 "what each driver alone contributes to the accelerations of the coordinates",
                 needs, "driver-acceleration", configure_alone, compute_alone);
}

}  // namespace sinew::synthesis
