// The last sweep of hybrid dynamics: with the magnitudes x of the constraint forces, each joint is
// driven by e + sum of x_i e_i, weighed over the drivers, and accelerations follow from the root
// outward (Vereshchagin 1989, equation g); for all drivers together, and for each alone.
#include "sinew/synthesis/block_specs.h"
#include "sinew/synthesis/effects.h"
#include "sinew/synthesis/hybrid_steps.h"

namespace sinew::synthesis {
namespace {

using algorithm::BlockSpec;
using algorithm::kNoIndex;

// Pairs of a unit effect and how many times it counts.
struct Sum {
  std::vector<BlockIndex> forces, magnitudes;
  void add(BlockIndex force, BlockIndex magnitude) {
    if (force == kNoIndex || magnitude == kNoIndex) return;
    forces.push_back(force);
    magnitudes.push_back(magnitude);
  }
};

void weigh(Context& context, const JointEdge& edge, Sum sum, BlockIndex result) {
  if (sum.forces.empty()) sum.add(no_force(context, edge), times(context, 1));
  const auto count = static_cast<std::uint32_t>(sum.forces.size());
  std::vector<BlockIndex> arguments = std::move(sum.forces);
  arguments.insert(arguments.end(), sum.magnitudes.begin(), sum.magnitudes.end());
  arguments.push_back(result);
  context.closure_with_counts(edge.floats() ? "weigh-floating-forces" : "weigh-joint-forces",
                              std::move(arguments), {count, count, 1}, edge.joint);
}

// ---- what drives a joint ----

void configure_drive(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  context.make(edge.coordinate("constrained-drive", "force"));
}

void compute_drive(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  Sum sum;
  for (const DriverGroup& group : context.drivers.groups)
    sum.add(effect_block(context, "effect-force", group.element, edge.joint),
            driver_weight(context, group));
  for (const ConstraintDirection& direction : context.drivers.directions)
    sum.add(effect_block(context, "effect-force", direction.element, edge.joint),
            context.block("constraint-magnitude", direction.element));
  weigh(context, edge, std::move(sum), context.block("constrained-drive", edge.joint));
}

// ---- accelerations from the root outward ----

// Of all drivers, or of one group: named for it, and kept in slots of its own.
struct Response {
  Id element;         // of the group; null for all
  std::string label;  // likewise
};

Id key(Context& context, const Response& response, Id at) {
  return response.element ? context.pair(response.element, at) : at;
}

std::string name(const Context& context, const Response& response, std::string_view label, Id at) {
  std::string place(label.empty() ? algorithm::short_name(context.view.terms().text(at)) : label);
  return response.element ? response.label + "." + place : place;
}

void make_acceleration(Context& context, const Response& response, std::string_view slot, Id at,
                       Id of, Id wrt, Id frame, bool at_rest = false) {
  const std::string label = name(context, response, "", at);
  BlockSpec spec = at_frame(slot, "acceleration-twist", key(context, response, at), of, frame, wrt);
  spec.label = label;
  context.make(at_rest ? zero(spec) : spec);
}

void make_joint(Context& context, const Response& response, const JointEdge& edge,
                std::string_view slot, std::string_view what) {
  const std::string label = name(context, response, edge.label, edge.joint);
  BlockSpec spec = edge.coordinate(slot, what);
  spec.represents = key(context, response, edge.joint);
  spec.label = label;
  context.make(spec);
}

void configure_response(Context& context, const Response& response, const JointEdge& edge,
                        std::string_view result) {
  const Id reference = context.reference;
  const auto make = [&](std::string_view slot, Id at, Id of, Id wrt, Id frame) {
    make_acceleration(context, response, slot, at, of, wrt, frame);
  };
  make("response-at-joint", edge.joint, edge.predecessor, reference, edge.joint_frame);
  make("response-across-joint", edge.joint, edge.predecessor, reference, edge.child);
  make("response-relative", edge.joint, edge.successor, edge.predecessor, edge.child);
  make("response", edge.child, edge.successor, reference, edge.child);
  make_joint(context, response, edge, result, "acceleration");
  if (edge.floats())
    context.make(zero(at_frame("no-relative-twist", "velocity-twist", edge.joint, edge.successor,
                               edge.child, edge.predecessor)));
}

void compute_response(Context& context, const Response& response, const JointEdge& edge,
                      BlockIndex drive, BlockIndex result) {
  const auto block = [&](std::string_view slot) {
    return context.block(slot, key(context, response, edge.joint));
  };
  const std::string_view transform = "transform-acceleration-twist-to-distal-at-rest";
  context.closure(
      transform,
      {context.block("placement", edge.joint),
       context.block("response", key(context, response, edge.parent)), block("response-at-joint")},
      edge.joint);
  context.closure(transform,
                  {context.block("pose-across-joint", edge.joint), block("response-at-joint"),
                   block("response-across-joint")},
                  edge.joint);
  if (edge.floats()) {
    BlockIndex inertia = context.board.find("articulated-inertia", edge.child);
    if (inertia == kNoIndex) inertia = context.block("own-articulated-inertia", edge.child);
    context.closure("floating-acceleration-from-force", {inertia, drive, result}, edge.joint);
    context.closure(
        "acceleration-to-twist-floating",
        {result, context.block("no-relative-twist", edge.joint), block("response-relative")},
        edge.joint);
  } else {
    context.closure(
        "joint-acceleration-from-force",
        {drive, context.block("unit-wrench", edge.joint), context.block("unit-force", edge.joint),
         block("response-across-joint"), result},
        edge.joint);
    context.closure("acceleration-to-twist-" + edge.kind, {result, block("response-relative")},
                    edge.joint);
  }
  context.closure("add-acceleration-twist",
                  {block("response-across-joint"), block("response-relative"),
                   context.block("response", key(context, response, edge.child))},
                  edge.child);
}

void configure_root(Context& context, const Visit& visit) {
  make_acceleration(context, {}, "response", visit.node, visit["body"], context.reference,
                    visit.node, true);
}

void configure_acceleration(Context& context, const Visit& visit) {
  configure_response(context, {}, JointEdge(context, visit), "acceleration");
}

void compute_acceleration(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  compute_response(context, {}, edge, context.block("constrained-drive", edge.joint),
                   context.block("acceleration", edge.joint));
}

// ---- each driver alone, with the constraint forces that balance it ----

void configure_driver_root(Context& context, const Visit& visit) {
  for (const DriverGroup& group : context.drivers.groups)
    make_acceleration(context, {group.element, group.label}, "response", visit.node, visit["body"],
                      context.reference, visit.node, true);
}

void configure_driver(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  for (const DriverGroup& group : context.drivers.groups) {
    const Response response = {group.element, group.label};
    make_joint(context, response, edge, "driver-drive", "force");
    configure_response(context, response, edge, "driver-acceleration");
  }
}

void compute_driver(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  for (const DriverGroup& group : context.drivers.groups) {
    const Response response = {group.element, group.label};
    const Id joint = key(context, response, edge.joint);
    Sum sum;
    sum.add(effect_block(context, "effect-force", group.element, edge.joint), times(context, 1));
    for (const ConstraintDirection& direction : context.drivers.directions)
      sum.add(effect_block(context, "effect-force", direction.element, edge.joint),
              effect_block(context, "driver-magnitude", direction.element, group.element));
    const BlockIndex drive = context.block("driver-drive", joint);
    weigh(context, edge, std::move(sum), drive);
    compute_response(context, response, edge, drive, context.block("driver-acceleration", joint));
  }
}

// ---- joint forces ----

void configure_constraint_force(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  context.make(edge.coordinate("constraint-force", "force"));
}

void compute_constraint_force(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  Sum sum;
  for (const ConstraintDirection& direction : context.drivers.directions)
    sum.add(effect_block(context, "constraint-lever", direction.element, edge.joint),
            context.block("constraint-magnitude", direction.element));
  weigh(context, edge, std::move(sum), context.block("constraint-force", edge.joint));
}

void configure_control_force(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  context.make(edge.coordinate("control-force", "force"));
}

void compute_control_force(Context& context, const Visit& visit) {
  const JointEdge edge(context, visit);
  Sum sum;
  for (const DriverGroup& group : context.drivers.groups)
    if (group.has_joint(edge.joint))
      sum.add(context.block("force", edge.joint), driver_weight(context, group));
  for (const ConstraintDirection& direction : context.drivers.directions)
    sum.add(effect_block(context, "constraint-lever", direction.element, edge.joint),
            context.block("constraint-magnitude", direction.element));
  weigh(context, edge, std::move(sum), context.block("control-force", edge.joint));
}

std::vector<Visitor> across_joints(Pass configure, Pass compute) {
  return {{Where::kEdge, {}, {}, std::move(configure), std::move(compute)}};
}

bool gives_forces(const MotionDrivers& drivers) {
  for (const DriverGroup& group : drivers.groups)
    if (!group.joints.empty()) return true;
  return false;
}

// What weights, magnitudes and levers a step looks at, beside its own needs.
}  // namespace

std::vector<std::string> with_weights(std::vector<std::string> needs,
                                      const MotionDrivers& drivers) {
  if (!drivers.constraints.empty()) needs.emplace_back("constraint-magnitude");
  if (drivers.limited != kNoDriver) needs.emplace_back("driver-scale");
  return needs;
}

Step constrained_drive_step(const MotionDrivers& drivers) {
  return {.name = "constrained-drive",
          .purpose = "drivers and constraint forces together drive each joint",
          .direction = Direction::kOutward,
          .expansion = std::string(kAcrossJoints),
          .needs = with_weights({"effect-force"}, drivers),
          .may_use = {},
          .gives = {"constrained-drive"},
          .visitors = across_joints(configure_drive, compute_drive)};
}

Step constrained_acceleration_step() {
  std::vector<Visitor> visitors = across_joints(configure_acceleration, compute_acceleration);
  visitors.push_back(
      {Where::kNode, {std::string(kIsRoot)}, std::string(kBodyOfNode), configure_root, {}});
  return {
      .name = "constrained-acceleration",
      .purpose = "accelerations under all drivers follow from the root outward",
      .direction = Direction::kOutward,
      .expansion = std::string(kAcrossJoints),
      .needs = {"constrained-drive", "unit-wrench", "unit-force", "placement", "pose-across-joint"},
      .may_use = {},
      .gives = {"acceleration"},
      .visitors = visitors};
}

Step driver_acceleration_step(const MotionDrivers& drivers) {
  std::vector<std::string> needs = {"effect-force", "unit-wrench", "unit-force", "placement",
                                    "pose-across-joint"};
  if (!drivers.constraints.empty()) needs.emplace_back("driver-magnitude");
  std::vector<Visitor> visitors = across_joints(configure_driver, compute_driver);
  visitors.push_back(
      {Where::kNode, {std::string(kIsRoot)}, std::string(kBodyOfNode), configure_driver_root, {}});
  return {.name = "driver-acceleration",
          .purpose = "what each driver alone contributes to the accelerations",
          .direction = Direction::kOutward,
          .expansion = std::string(kAcrossJoints),
          .needs = needs,
          .may_use = {},
          .gives = {"driver-acceleration"},
          .visitors = visitors};
}

Step constraint_force_step() {
  return {.name = "constraint-force",
          .purpose = "joint forces that do what the constraint forces do",
          .direction = Direction::kOutward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"constraint-magnitude", "constraint-lever"},
          .may_use = {},
          .gives = {"constraint-force"},
          .visitors = across_joints(configure_constraint_force, compute_constraint_force)};
}

Step control_force_step(const MotionDrivers& drivers) {
  std::vector<std::string> needs = with_weights({}, drivers);
  if (!drivers.constraints.empty()) needs.emplace_back("constraint-lever");
  if (gives_forces(drivers)) needs.emplace_back("force");
  return {.name = "control-force",
          .purpose = "what actuators must do: the given forces, and those in place of constraints",
          .direction = Direction::kOutward,
          .expansion = std::string(kAcrossJoints),
          .needs = needs,
          .may_use = {},
          .gives = {"control-force"},
          .visitors = across_joints(configure_control_force, compute_control_force)};
}

}  // namespace sinew::synthesis
