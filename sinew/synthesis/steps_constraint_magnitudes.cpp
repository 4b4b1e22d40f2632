// At the root, between the inward and the last outward sweep: the coupling of the constraints,
//   L_ik = sum over joints of e_ij e_kj / D_j,
// is the acceleration energy that unit constraint force k causes along i (Vereshchagin 1989,
// equations d and e; what Khatib's operational-space inertia is the inverse of). The magnitudes x
// of the constraint forces balance the energies: L x = setpoints - energies of all other drivers.
// Each group of drivers is balanced by itself, with the same factors.
#include <cmath>

#include "sinew/synthesis/coupled_drives.h"
#include "sinew/synthesis/hybrid_steps.h"
#include "sinew/synthesis/results.h"

namespace sinew::synthesis {
namespace {

using algorithm::BlockSpec;
using algorithm::kNoIndex;
using algorithm::Role;

struct JointEffects {
  std::vector<BlockIndex> blocks;  // of joints of one degree of freedom: e, then e / D
  BlockIndex force = kNoIndex, acceleration = kNoIndex;  // of a floating base
  bool empty() const { return blocks.empty() && force == kNoIndex; }
};

// The joints that both effects reach.
JointEffects common_joints(Context& context, Id effect, Id other) {
  JointEffects found;
  std::vector<BlockIndex> accelerations;
  for (const RobotJoint& joint : context.robot.joints) {
    const BlockIndex force = effect_block(context, "effect-force", effect, joint.joint);
    const BlockIndex acceleration =
        effect_block(context, "effect-acceleration", other, joint.joint);
    if (force == kNoIndex || acceleration == kNoIndex) continue;
    if (joint.kind == "floating") {
      found.force = force;
      found.acceleration = acceleration;
    } else {
      found.blocks.push_back(force);
      accelerations.push_back(acceleration);
    }
  }
  found.blocks.insert(found.blocks.end(), accelerations.begin(), accelerations.end());
  return found;
}

BlockIndex make_energy(Context& context, std::string_view slot, Id direction, Id effect) {
  return context.make({.slot = slot,
                       .represents = context.pair(direction, effect),
                       .quantity = "acceleration-energy"});
}

void configure_energy(Context& context, Id direction, Id effect) {
  if (context.robot.coupled()) {
    make_energy(context, "effect-energy", direction, effect);
    return;
  }
  const JointEffects joints = common_joints(context, direction, effect);
  if (joints.empty()) {
    context.board.put("effect-energy", context.pair(direction, effect), no_energy(context));
    return;
  }
  if (!joints.blocks.empty() && joints.force != kNoIndex) {
    make_energy(context, "effect-energy-of-joints", direction, effect);
    make_energy(context, "effect-energy-of-base", direction, effect);
  }
  make_energy(context, "effect-energy", direction, effect);
}

// The acceleration that an effect causes along a constraint.
void compute_energy(Context& context, Id direction, Id effect) {
  if (context.robot.coupled()) {
    energy_of_drives(context, direction, effect,
                     effect_block(context, "effect-energy", direction, effect), direction);
    return;
  }
  const JointEffects joints = common_joints(context, direction, effect);
  if (joints.empty()) return;
  const auto block = [&](std::string_view slot) {
    return effect_block(context, slot, direction, effect);
  };
  const bool both = !joints.blocks.empty() && joints.force != kNoIndex;
  if (!joints.blocks.empty()) {
    std::vector<BlockIndex> arguments = joints.blocks;
    const auto count = static_cast<std::uint32_t>(arguments.size() / 2);
    arguments.push_back(block(both ? "effect-energy-of-joints" : "effect-energy"));
    context.closure_with_counts("acceleration-energy-of-joint-forces", std::move(arguments),
                                {count, count, 1}, direction);
  }
  if (joints.force != kNoIndex)
    context.closure("acceleration-energy-of-floating-force",
                    {joints.force, joints.acceleration,
                     block(both ? "effect-energy-of-base" : "effect-energy")},
                    direction);
  if (both)
    context.closure(
        "add-acceleration-energy",
        {block("effect-energy-of-joints"), block("effect-energy-of-base"), block("effect-energy")},
        direction);
}

void configure_magnitudes(Context& context, const Visit& visit) {
  const MotionDrivers& drivers = context.drivers;
  const auto count = static_cast<std::uint32_t>(drivers.directions.size());
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k <= i; ++k)
      configure_energy(context, drivers.directions[i].element, drivers.directions[k].element);
  const double number[] = {context.query.drivers.singular_number};
  context.make({.slot = "singular-tolerance",
                .represents = visit["body"],
                .quantity = "magnitude",
                .role = Role::kConstant,
                .value = number,
                .label = algorithm::kWholeRobot});
  for (const DriverGroup& group : drivers.groups) {
    for (const ConstraintDirection& direction : drivers.directions) {
      configure_energy(context, direction.element, group.element);
      if (group.velocity)
        make_energy(context, "effect-energy-with-bias", direction.element, group.element);
      make_energy(context, "constraint-residual", direction.element, group.element);
      const std::string label = group.label + "." + direction.label;
      context.make({.slot = "driver-magnitude",
                    .represents = context.pair(direction.element, group.element),
                    .quantity = "magnitude",
                    .label = label});
    }
    context.make({.slot = "driver-magnitudes",
                  .represents = group.element,
                  .quantity = "constraint-magnitudes",
                  .size = count,
                  .label = group.label});
  }
}

// What the constraint forces must add along a direction, because of one group of drivers.
void compute_residual(Context& context, const DriverGroup& group,
                      const ConstraintDirection& direction) {
  compute_energy(context, direction.element, group.element);
  const auto block = [&](std::string_view slot) {
    return effect_block(context, slot, direction.element, group.element);
  };
  BlockIndex energy = block("effect-energy");
  if (group.velocity) {
    context.closure("add-acceleration-energy",
                    {energy, context.block("constraint-bias-energy", direction.element),
                     block("effect-energy-with-bias")},
                    direction.element);
    energy = block("effect-energy-with-bias");
  }
  const BlockIndex setpoint = group.has_constraint(direction.constraint)
                                  ? context.block("acceleration-energy", direction.element)
                                  : no_energy(context);
  context.closure("subtract-acceleration-energy", {setpoint, energy, block("constraint-residual")},
                  direction.element);
}

std::string_view solve_operator(Singular singular) {
  switch (singular) {
    case Singular::kDamped:
      return "constraint-magnitudes-damped";
    case Singular::kTruncated:
      return "constraint-magnitudes-truncated";
    default:
      return "constraint-magnitudes-in-order";
  }
}

void compute_magnitudes(Context& context, const Visit& visit) {
  const std::vector<ConstraintDirection>& directions = context.drivers.directions;
  const auto count = static_cast<std::uint32_t>(directions.size());
  std::vector<BlockIndex> entries;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k <= i; ++k) {
      compute_energy(context, directions[i].element, directions[k].element);
      entries.push_back(
          effect_block(context, "effect-energy", directions[i].element, directions[k].element));
    }
  }
  for (const DriverGroup& group : context.drivers.groups) {
    std::vector<BlockIndex> arguments = entries;
    for (const ConstraintDirection& direction : directions) {
      compute_residual(context, group, direction);
      arguments.push_back(
          effect_block(context, "constraint-residual", direction.element, group.element));
    }
    arguments.push_back(context.block("singular-tolerance", visit["body"]));
    const BlockIndex all = context.block("driver-magnitudes", group.element);
    arguments.push_back(all);
    context.closure_with_counts(
        solve_operator(context.query.drivers.singular), std::move(arguments),
        {static_cast<std::uint32_t>(entries.size()), count, 1, 1}, group.origin);
    for (const ConstraintDirection& direction : directions) {
      std::vector<BlockIndex> selection = {all};
      for (const ConstraintDirection& one : directions)
        selection.push_back(times(context, &one == &direction ? 1 : 0));
      selection.push_back(
          effect_block(context, "driver-magnitude", direction.element, group.element));
      context.closure_with_counts("constraint-magnitude", std::move(selection), {1, count, 1},
                                  direction.element);
    }
  }
}

// ---- the share of the driver that is scaled down ----

// A joint's actuator force because of one group: what is given for it, and what replaces the
// constraint forces.
void actuator_force(Context& context, const DriverGroup& group, std::size_t part,
                    std::vector<BlockIndex>& forces, std::vector<BlockIndex>& magnitudes) {
  const Id joint = context.robot.joints[part].joint;
  if (group.has_joint(joint)) {
    forces.push_back(context.block("force", joint));
    magnitudes.push_back(times(context, 1));
  }
  for (const ConstraintDirection& direction : context.drivers.directions) {
    const BlockIndex lever = coupled_effect(context, "constraint-lever", direction.element, part);
    if (lever == kNoIndex) continue;
    forces.push_back(lever);
    magnitudes.push_back(
        effect_block(context, "driver-magnitude", direction.element, group.element));
  }
}

// A joint that follows another has no actuator of its own.
bool is_limited(const Context& context, std::size_t joint) {
  return context.robot.joints[joint].follows < 0 &&
         !std::isnan(context.drivers.force_limits[joint]) &&
         context.robot.joints[joint].kind != "floating";
}

BlockSpec actuator(const Context& context, std::string_view slot, const RobotJoint& joint) {
  return {.slot = slot,
          .represents = joint.joint,
          .quantity = "joint-force",
          .of = joint.successor,
          .wrt = joint.predecessor,
          .seen_by = joint.frame,
          .prismatic = joint.kind == "prismatic",
          .label = context.label(joint.joint)};
}

void configure_scale(Context& context, const Visit&) {
  for (std::size_t i = 0; i < context.robot.joints.size(); ++i) {
    const RobotJoint& joint = context.robot.joints[i];
    if (!is_limited(context, i)) continue;
    const double limit[] = {context.drivers.force_limits[i]};
    BlockSpec spec = actuator(context, "force-limit", joint);
    spec.role = Role::kConstant;
    spec.value = limit;
    context.make(spec);
    context.make(actuator(context, "actuator-force-of-rest", joint));
    context.make(actuator(context, "actuator-force-of-scaled", joint));
  }
  const DriverGroup& group = context.drivers.groups[context.drivers.limited];
  context.make({.slot = "driver-scale",
                .represents = group.element,
                .quantity = "magnitude",
                .label = group.label});
}

void compute_scale(Context& context, const Visit&) {
  const std::vector<DriverGroup>& groups = context.drivers.groups;
  std::vector<BlockIndex> rest, scaled, limits;
  for (std::size_t i = 0; i < context.robot.joints.size(); ++i) {
    const RobotJoint& joint = context.robot.joints[i];
    if (!is_limited(context, i)) continue;
    limits.push_back(context.block("force-limit", joint.joint));
    for (const bool of_scaled : {false, true}) {
      std::vector<BlockIndex> forces, magnitudes;
      for (std::size_t k = 0; k < groups.size(); ++k)
        if ((k == context.drivers.limited) == of_scaled)
          actuator_force(context, groups[k], i, forces, magnitudes);
      const BlockIndex sum = context.block(
          of_scaled ? "actuator-force-of-scaled" : "actuator-force-of-rest", joint.joint);
      if (forces.empty()) {
        BlockSpec none = actuator(context, "no-actuator-force", joint);
        const double zero[] = {0};
        none.role = Role::kConstant;
        none.value = zero;
        forces.push_back(context.make(none));
        magnitudes.push_back(times(context, 1));
      }
      const auto count = static_cast<std::uint32_t>(forces.size());
      forces.insert(forces.end(), magnitudes.begin(), magnitudes.end());
      forces.push_back(sum);
      context.closure_with_counts("weigh-joint-forces", std::move(forces), {count, count, 1},
                                  joint.joint);
      (of_scaled ? scaled : rest).push_back(sum);
    }
  }
  const auto count = static_cast<std::uint32_t>(limits.size());
  std::vector<BlockIndex> arguments = rest;
  arguments.insert(arguments.end(), scaled.begin(), scaled.end());
  arguments.insert(arguments.end(), limits.begin(), limits.end());
  const DriverGroup& group = groups[context.drivers.limited];
  arguments.push_back(context.block("driver-scale", group.element));
  context.closure_with_counts("scale-within-limits", std::move(arguments), {count, count, count, 1},
                              group.origin);
}

// ---- all drivers together ----

void configure_total(Context& context, const Visit&) {
  for (const ConstraintDirection& direction : context.drivers.directions)
    context.make({.slot = "constraint-magnitude",
                  .represents = direction.element,
                  .quantity = "magnitude",
                  .label = direction.label});
}

void compute_total(Context& context, const Visit&) {
  for (const ConstraintDirection& direction : context.drivers.directions) {
    std::vector<BlockIndex> arguments;
    for (const DriverGroup& group : context.drivers.groups)
      arguments.push_back(
          effect_block(context, "driver-magnitude", direction.element, group.element));
    for (const DriverGroup& group : context.drivers.groups)
      arguments.push_back(driver_weight(context, group));
    const auto count = static_cast<std::uint32_t>(context.drivers.groups.size());
    arguments.push_back(context.block("constraint-magnitude", direction.element));
    context.closure_with_counts("weigh-magnitudes", std::move(arguments), {count, count, 1},
                                direction.element);
  }
}

std::vector<Visitor> at_root(Pass configure, Pass compute) {
  return {{Where::kNode,
           {std::string(kIsRoot)},
           std::string(kBodyOfNode),
           std::move(configure),
           std::move(compute)}};
}

}  // namespace

Step constraint_magnitudes_step() {
  return {.name = "constraint-magnitudes",
          .purpose = "constraint forces balance the acceleration energies of the other drivers",
          .direction = Direction::kInward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"effect-force", "constraint-bias-energy", "acceleration-energy"},
          .may_use = {},
          .gives = {"driver-magnitude"},
          .visitors = at_root(configure_magnitudes, compute_magnitudes)};
}

Step driver_scale_step(const MotionDrivers& drivers) {
  std::vector<std::string> needs;
  if (!drivers.constraints.empty()) needs = {"driver-magnitude", "constraint-lever"};
  for (const DriverGroup& group : drivers.groups)
    if (!group.joints.empty()) needs.emplace_back("force");
  return {.name = "driver-scale",
          .purpose = "one driver is scaled down until no actuator saturates",
          .direction = Direction::kInward,
          .expansion = std::string(kAcrossJoints),
          .needs = needs,
          .may_use = {},
          .gives = {"driver-scale"},
          .visitors = at_root(configure_scale, compute_scale)};
}

Step total_magnitudes_step(const MotionDrivers& drivers) {
  std::vector<std::string> needs = {"driver-magnitude"};
  if (drivers.limited != kNoDriver) needs.emplace_back("driver-scale");
  return {.name = "total-magnitudes",
          .purpose = "the constraint forces because of all drivers together",
          .direction = Direction::kInward,
          .expansion = std::string(kAcrossJoints),
          .needs = needs,
          .may_use = {},
          .gives = {"constraint-magnitude"},
          .visitors = at_root(configure_total, compute_total)};
}

}  // namespace sinew::synthesis
