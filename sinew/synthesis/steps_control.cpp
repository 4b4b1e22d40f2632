// The steps of a task: its signals at once; its wrenches into what each body needs; its forces at
// the joints.
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "sinew/synthesis/block_specs.h"
#include "sinew/synthesis/control.h"
#include "sinew/synthesis/control_signals.h"
#include "sinew/synthesis/drivers.h"
#include "sinew/synthesis/joint_edge.h"
#include "sinew/synthesis/motion.h"

namespace sinew::synthesis {
namespace {

using algorithm::BlockSpec;
using algorithm::kNoIndex;

const task::Task& task_of(const Context& context) { return *context.control->task; }

// The same wrench at the frame of its body.
BlockIndex at_body(Context& context, Id coordinates, BlockIndex own) {
  const SpatialPlace& place = context.control->places.at(coordinates);
  const Id body_frame = synthesis::body_frame(context.view, place.frame);
  if (body_frame == place.frame) return own;
  const BlockIndex result = context.builder.block({.slot = "wrench-at-body",
                                                   .represents = coordinates,
                                                   .quantity = "wrench",
                                                   .of = place.body,
                                                   .reference = body_frame,
                                                   .seen_by = body_frame});
  context.closure("transform-wrench-to-proximal",
                  {context.block("frame-placement", place.frame), own, result}, coordinates);
  return result;
}

// The sum of what drivers put on a joint; kNoIndex where there is none.
BlockIndex joint_signal(Context& context, ControlSignals& signals, const RobotJoint& joint) {
  BlockIndex sum = kNoIndex;
  for (const task::Driver& driver : task_of(context).solver->joint_forces) {
    if (driver.attached_to != joint.joint) continue;
    for (const task::JointView& view : task_of(context).joint_views) {
      if (view.coordinates != driver.quantity) continue;
      BlockSpec spec = joint_quantity("joint-signal", joint);
      spec.represents = view.id;
      spec.label = {};
      const BlockIndex one = context.builder.block(spec);
      context.closure("joint-force-of-signal", {signals.number(view.number), one}, view.id);
      if (sum == kNoIndex) {
        sum = one;
        continue;
      }
      spec.slot = "joint-signals-with";
      const BlockIndex next = context.builder.block(spec);
      context.closure("add-joint-force", {sum, one, next}, view.id);
      sum = next;
    }
  }
  return sum;
}

void make_joint_signals(Context& context, ControlSignals& signals) {
  for (const RobotJoint& joint : context.robot.joints) {
    if (joint.kind == "floating") continue;
    BlockIndex sum = joint_signal(context, signals, joint);
    if (sum == kNoIndex) {
      sum = context.builder.block(zero(joint_quantity("no-signal", joint)));
    }
    context.board.put("joint-signal", joint.joint, sum);
  }
}

// Joint accelerations that no driver states are zero.
void make_accelerations(Context& context, ControlSignals& signals) {
  const task::Task& task = task_of(context);
  for (const RobotJoint& joint : context.robot.joints) {
    BlockSpec spec = joint_quantity("acceleration", joint);
    const task::JointView* source = nullptr;
    for (const task::Driver& driver : task.solver->joint_accelerations)
      for (const task::JointView& view : task.joint_views)
        if (driver.attached_to == joint.joint && view.coordinates == driver.quantity)
          source = &view;
    if (source == nullptr) {
      context.make(zero(spec));
      continue;
    }
    const BlockIndex number = signals.number(source->number);
    context.closure("joint-acceleration-of-signal", {number, context.make(spec)}, source->id);
  }
}

// The accelerations that hybrid dynamics imposes.
void make_energies(Context& context, ControlSignals& signals) {
  for (const ConstraintDirection& direction : context.drivers.directions) {
    const Id number = energy_of(context.control, context.drivers, direction);
    if (!number) continue;
    const std::string& unit = task_of(context).quantities.at(number).unit;
    const std::string_view operation =
        unit == "M-PER-SEC2"     ? "acceleration-energy-of-linear-acceleration"
        : unit == "RAD-PER-SEC2" ? "acceleration-energy-of-angular-acceleration"
                                 : "acceleration-energy-of-signal";
    context.closure(
        operation,
        {signals.number(number), context.block("acceleration-energy", direction.element)},
        direction.element);
  }
}

void compute_control(Context& context, const Visit&) {
  ControlSignals signals(context, *context.control);
  signals.make_all();
  const task::Task& task = task_of(context);
  if (!task.solver) return;
  for (const task::Driver& driver : task.solver->cartesian_forces) {
    const BlockIndex own = signals.wrench(driver.quantity);
    context.board.put("frame-wrench", driver.quantity, own);
    if (context.control->drives == Drives::kMotion)
      context.board.put("control-wrench-at-body", driver.quantity,
                        at_body(context, driver.quantity, own));
  }
  make_joint_signals(context, signals);
  if (context.control->constraints) make_energies(context, signals);
  if (context.control->accelerations) make_accelerations(context, signals);
}

// --- What a body needs to move as it does, and the wrench that the task wants it to exert.

std::vector<Id> wrenches_on(const Context& context, Id body_frame) {
  std::vector<Id> found;
  for (const task::Driver& driver : task_of(context).solver->cartesian_forces) {
    const Id frame = context.control->places.at(driver.quantity).frame;
    if (synthesis::body_frame(context.view, frame) == body_frame &&
        std::find(found.begin(), found.end(), driver.quantity) == found.end())
      found.push_back(driver.quantity);
  }
  return found;
}

void configure_wrench(Motion motion, Context& context, const Visit& visit) {
  for (const Id coordinates : wrenches_on(context, visit.node)) {
    BlockIndex before = context.board.find(slot_of(motion, "body-wrench"), visit.node);
    if (before == kNoIndex) before = context.block(slot_of(motion, "own-wrench"), visit.node);
    context.board.put(slot_of(motion, "wrench-without-control"), coordinates, before);
    const BlockIndex with = context.make({.slot = slot_of(motion, "wrench-with-control"),
                                          .represents = coordinates,
                                          .quantity = "wrench",
                                          .of = context.builder.at(before).symbols[0],
                                          .reference = visit.node,
                                          .seen_by = visit.node});
    context.board.put(slot_of(motion, "body-wrench"), visit.node, with);
  }
}

void compute_wrench(Motion motion, Context& context, const Visit& visit) {
  for (const Id coordinates : wrenches_on(context, visit.node))
    context.closure("accumulate-wrench",
                    {context.block(slot_of(motion, "wrench-without-control"), coordinates),
                     context.block("control-wrench-at-body", coordinates),
                     context.block(slot_of(motion, "wrench-with-control"), coordinates)},
                    coordinates);
}

// --- Joint forces.

void compute_command(Context& context, const Visit&) {
  for (const RobotJoint& joint : context.robot.joints) {
    if (joint.kind == "floating") continue;
    const BlockIndex force = context.block("force", joint.joint);
    const BlockIndex command = context.builder.block(joint_quantity("command", joint));
    context.closure("add-joint-force", {force, context.block("joint-signal", joint.joint), command},
                    joint.joint);
    context.board.put("force", joint.joint, command);
  }
}

// A wrench with the root's directions, as the Jacobian's columns are.
BlockIndex from_root(Context& context, Id coordinates) {
  const BlockIndex found = context.board.find("frame-wrench-from-root", coordinates);
  if (found != kNoIndex) return found;
  const SpatialPlace& place = context.control->places.at(coordinates);
  const Id root = context.robot.root_frame;
  const BlockIndex result = context.make({.slot = "frame-wrench-from-root",
                                          .represents = coordinates,
                                          .quantity = "wrench",
                                          .of = place.body,
                                          .reference = place.frame,
                                          .seen_by = root});
  context.closure(
      "rotate-wrench-to-proximal",
      {context.block("pose", place.frame), context.block("frame-wrench", coordinates), result},
      coordinates);
  return result;
}

// Hybrid dynamics imposes what is constrained; what is not would fall. As with inverse dynamics, a
// task's robot carries its own weight.
bool carries_weight(const Control& control) {
  return control.forces && control.task->solver->algorithm == task::Algorithm::kHybrid;
}

void compute_distribution(Context& context, const Visit&) {
  const std::string_view slot = context.control->forces ? "force" : "control-force";
  for (const RobotJoint& joint : context.robot.joints) {
    if (joint.kind == "floating") continue;
    std::vector<BlockIndex> parts = {context.block("joint-signal", joint.joint)};
    if (carries_weight(*context.control))
      parts.push_back(context.block("gravity-force", joint.joint));
    for (const task::Driver& driver : task_of(context).solver->cartesian_forces) {
      const Id frame = context.control->places.at(driver.quantity).frame;
      const Id pair = context.pair(frame, joint.joint);
      BlockSpec spec = joint_quantity("force-from-wrench", joint);
      spec.represents = context.pair(driver.id, joint.joint);
      const BlockIndex part = context.builder.block(spec);
      context.closure(
          "joint-force-from-column",
          {context.block("jacobian-column", pair), from_root(context, driver.quantity), part},
          joint.joint);
      parts.push_back(part);
    }
    BlockIndex sum = parts.front();
    for (std::size_t i = 1; i < parts.size(); ++i) {
      BlockSpec spec = joint_quantity(i + 1 == parts.size() ? slot : "force-so-far", joint);
      if (i + 1 < parts.size()) spec.represents = context.builder.at(parts[i]).represents;
      const BlockIndex next = context.builder.block(spec);
      context.closure("add-joint-force", {sum, parts[i], next}, joint.joint);
      sum = next;
    }
    context.board.put(slot, joint.joint, sum);
  }
}

Step once(std::string name, std::string purpose, std::vector<std::string> needs,
          std::vector<std::string> gives, Pass compute) {
  return {.name = std::move(name),
          .purpose = std::move(purpose),
          .direction = Direction::kOnce,
          .expansion = std::string(kAcrossJoints),
          .needs = std::move(needs),
          .may_use = {},
          .gives = std::move(gives),
          .visitors = {{Where::kNode, {}, {}, {}, std::move(compute)}}};
}

Step control_step(const Control& control) {
  std::vector<std::string> gives = {"control"};
  if (control.accelerations) gives.emplace_back("acceleration");
  if (control.constraints) gives.emplace_back("acceleration-energy");
  return once("control", "the task's monitors and controllers work on what is measured",
              control.needs, std::move(gives), compute_control);
}

Step control_wrench_step(Motion motion) {
  return {.name = slot_of(motion, "control-wrench"),
          .purpose = "the wrench that the task commands adds to what its body needs",
          .direction = Direction::kInward,
          .expansion = std::string(kAcrossJoints),
          .needs = {"control", slot_of(motion, "own-wrench")},
          .may_use = {},
          .gives = {slot_of(motion, "control-wrench")},
          .visitors = {{Where::kNode,
                        {std::string(kIsNotRoot)},
                        {},
                        std::bind_front(configure_wrench, motion),
                        std::bind_front(compute_wrench, motion)}}};
}

Step command_step() {
  return once("command", "the task's joint forces add to those of the motion", {"control", "force"},
              {"command"}, compute_command);
}

Step distribution_step(const Control& control) {
  std::vector<std::string> needs = {"control"};
  if (control.has_wrenches()) needs.emplace_back("jacobian");
  if (carries_weight(control)) needs.emplace_back("gravity-force");
  return once("distribution", "the Jacobian's transpose turns the task's wrenches to joint forces",
              std::move(needs), {control.forces ? "force" : "control-force"}, compute_distribution);
}

}  // namespace

Id energy_of(const Control* control, const MotionDrivers& drivers,
             const ConstraintDirection& direction) {
  if (control == nullptr || !control->constraints || !direction.unit_force) return {};
  const Id element = drivers.constraints[direction.constraint].element;
  for (const task::AccelerationConstraint& constraint : control->task->solver->constraints) {
    if (constraint.id != element) continue;
    for (const task::AxisConstraint& axis : constraint.axes)
      if ((*direction
                .unit_force)[(axis.subspace == task::Subspace::kAngular ? 0 : 3) + axis.axis] == 1)
        return axis.energy;
  }
  return {};
}

void decide(Control& control, const AskedForces& asked, std::span<const std::string> given,
            Report& report, const graph::View& view) {
  const task::Task& task = *control.task;
  if (!task.solver) return;
  const auto gives = [&](std::string_view slot) {
    return std::find(given.begin(), given.end(), slot) != given.end();
  };
  using task::Algorithm;
  control.accelerations = task.solver->algorithm == Algorithm::kRecursiveNewtonEuler &&
                          asked.full && !gives("acceleration");
  const bool hybrid = task.solver->algorithm == Algorithm::kHybrid;
  control.forces =
      (hybrid || task.solver->algorithm == Algorithm::kArticulatedBody) && !gives("force");
  control.constraints = hybrid && gives("acceleration-energy");
  if (control.forces || asked.control)
    control.drives = Drives::kDistribution;
  else if (asked.full || asked.bias || asked.rest)
    control.drives = Drives::kMotion;
  const std::string solver(view.terms().text(task.solver->id));
  if (control.drives == Drives::kNothing && (control.has_wrenches() || control.has_joint_forces()))
    report.error({}, solver, "the query asks for nothing on which the task's forces could act",
                 "ask for joint-force, bias-force, gravity-force or control-force");
  if (control.drives == Drives::kMotion && control.has_joint_forces() && !asked.full)
    report.error({}, solver, "the task's joint forces add to joint-force, which is not asked",
                 "ask for joint-force");
  if (!task.solver->joint_accelerations.empty() && !control.accelerations)
    report.error({}, solver, "the task states joint accelerations, and the query gives them",
                 "let one of them state the accelerations");
  if (control.drives != Drives::kDistribution) return;
  for (const task::Driver& driver : task.solver->cartesian_forces) {
    const auto place = control.places.find(driver.quantity);
    if (place != control.places.end()) control.frames.emplace_back("jacobian", place->second.frame);
  }
}

std::vector<Step> steps_with(const Control& control, std::span<const Step> steps) {
  std::vector<Step> list;
  const auto needs_accelerations =
      std::find(control.needs.begin(), control.needs.end(), "acceleration-twist");
  const std::string_view before =
      needs_accelerations == control.needs.end() ? "joint-acceleration" : "inertia";
  for (const Step& step : steps) {
    const bool distributes = control.drives == Drives::kDistribution;
    if (step.name == "jacobian" && distributes) continue;  // it comes earlier
    if (step.name == before) {
      list.push_back(control_step(control));
      if (distributes) {
        list.push_back(*find_step("jacobian"));
        list.push_back(distribution_step(control));
      }
    }
    if (control.has_wrenches())
      for (const Motion motion : {Motion::kFull, Motion::kBias, Motion::kRest})
        if (step.name == slot_of(motion, "body-wrench"))
          list.push_back(control_wrench_step(motion));
    list.push_back(step);
  }
  list.push_back(command_step());
  return list;
}

std::vector<Wish> wishes_of(const Control& control, const AskedForces& asked) {
  std::vector<Wish> wishes = {{"control", "the task"}};
  if (control.drives == Drives::kMotion && control.has_wrenches()) {
    if (asked.full) wishes.push_back({"control-wrench", "the task's wrenches"});
    if (asked.bias) wishes.push_back({"bias-control-wrench", "the task's wrenches"});
    if (asked.rest) wishes.push_back({"gravity-control-wrench", "the task's wrenches"});
  }
  if (control.drives == Drives::kMotion && control.has_joint_forces())
    wishes.push_back({"command", "the task's joint forces"});
  return wishes;
}

}  // namespace sinew::synthesis
