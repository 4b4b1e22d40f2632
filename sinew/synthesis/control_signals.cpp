#include "sinew/synthesis/control_signals.h"

#include <fmt/format.h>

#include "sinew/base/error.h"
#include "sinew/synthesis/drivers.h"

namespace sinew::synthesis {

using algorithm::BlockSpec;
using algorithm::kNoIndex;
using algorithm::Role;
using task::ConstraintKind;
using task::SpatialKind;
using task::Subspace;

namespace {

Error fault(std::string iri, std::string what, std::string remedy) {
  return Error(Problem{{}, std::move(iri), std::move(what), std::move(remedy), {}, {}});
}

}  // namespace

ControlSignals::ControlSignals(Context& context, const Control& control)
    : context_(context), control_(control), task_(*control.task) {
  for (const task::View& view : task_.views)
    if (task_.spatials.at(view.spatial).kind != SpatialKind::kWrench)
      origins_.emplace(view.number, &view);
  for (const task::Evaluator& evaluator : task_.evaluators)
    origins_.emplace(
        evaluator.error ? evaluator.error : task_.constraints.at(evaluator.constraint).quantity,
        &evaluator);
  for (const task::Controller& controller : task_.controllers)
    origins_.emplace(controller.control, &controller);
  // A commanded joint's number has its origin already.
  for (const task::JointView& view : task_.joint_views) origins_.emplace(view.number, &view);
}

BlockIndex ControlSignals::number(Id quantity) {
  if (const auto found = numbers_.find(quantity); found != numbers_.end()) return found->second;
  if (!open_.insert(quantity).second)
    throw fault(std::string(context_.view.terms().text(quantity)),
                "the quantity depends on itself within one cycle",
                "cut the loop: what a controller commands is measured in the next cycle");
  const BlockIndex block = make_number(task_.quantities.at(quantity));
  open_.erase(quantity);
  numbers_[quantity] = block;
  return block;
}

BlockIndex ControlSignals::make_number(const task::Quantity& quantity) {
  if (quantity.value) return constant("parameter", quantity.id, quantity.unit, *quantity.value);
  if (quantity.setpoint)
    return context_.builder.block({.slot = "setpoint",
                                   .represents = quantity.id,
                                   .quantity = "signal",
                                   .role = Role::kInput,
                                   .unit = quantity.unit});
  const auto origin = origins_.find(quantity.id);
  if (origin == origins_.end())
    throw fault(std::string(context_.view.terms().text(quantity.id)),
                "nothing gives this quantity its value",
                "state its value, make it a Setpoint, or let a view, an evaluator or a controller "
                "compute it");
  return std::visit(
      [&](const auto* element) -> BlockIndex {
        using Element = std::remove_cvref_t<decltype(*element)>;
        if constexpr (std::is_same_v<Element, task::View>)
          return view(*element);
        else if constexpr (std::is_same_v<Element, task::JointView>)
          return joint_view(*element);
        else if constexpr (std::is_same_v<Element, task::Evaluator>)
          return evaluator(*element);
        else
          return controller(*element);
      },
      origin->second);
}

BlockIndex ControlSignals::view(const task::View& view) {
  const task::Spatial& spatial = task_.spatials.at(view.spatial);
  const SpatialPlace& place = control_.places.at(view.spatial);
  const BlockIndex out = signal("signal", view.number, unit_of(view.number));
  const auto axis = [&](Id seen_by) {
    return context_.builder.block({.slot = "axis",
                                   .represents = view.id,
                                   .quantity = "direction",
                                   .seen_by = seen_by,
                                   .role = Role::kConstant,
                                   .value = place.axes[view.axis]});
  };
  const Id root = context_.robot.root_frame;
  if (spatial.kind == SpatialKind::kPose) {
    close("position-along", {axis(place.wrt ? place.wrt : root), pose(view.spatial), out}, view.id);
    return out;
  }
  const bool velocity = spatial.kind == SpatialKind::kVelocityTwist;
  const std::string_view slot = velocity ? "twist" : "acceleration-twist";
  BlockIndex motion = context_.block(slot, place.frame);
  if (!place.seen_from_root) {
    const algorithm::Block from = context_.builder.at(motion);
    const BlockIndex own = context_.builder.block(
        {.slot = velocity ? "twist-seen-from-itself" : "acceleration-seen-from-itself",
         .represents = place.frame,
         .quantity = from.quantity->name,
         .of = from.symbols[0],
         .wrt = from.symbols[1],
         .reference = place.frame,
         .seen_by = place.frame});
    close(velocity ? "rotate-velocity-twist-to-distal" : "rotate-acceleration-twist-to-distal",
          {context_.block("pose", place.frame), motion, own}, place.frame);
    motion = own;
  }
  const bool angular = view.subspace == Subspace::kAngular;
  const std::string_view operation =
      velocity  ? angular ? "angular-velocity-about" : "linear-velocity-along"
      : angular ? "angular-acceleration-about"
                : "linear-acceleration-along";
  close(operation, {axis(place.seen_from_root ? root : place.frame), motion, out}, view.id);
  return out;
}

BlockIndex ControlSignals::joint_view(const task::JointView& view) {
  constexpr std::string_view kSlots[] = {"position", "velocity", "acceleration", "force"};
  constexpr std::string_view kOperations[] = {
      "signal-of-joint-position", "signal-of-joint-velocity", "signal-of-joint-acceleration", ""};
  const auto kind = static_cast<std::size_t>(view.kind);
  const std::string joint(context_.view.terms().text(view.joint));
  if (kOperations[kind].empty() || !context_.has(kSlots[kind], view.joint))
    throw fault(std::string(context_.view.terms().text(view.id)),
                fmt::format("the {} of {} is neither given nor computed before the task",
                            kSlots[kind], joint),
                "view positions and velocities");
  const BlockIndex from = context_.block(kSlots[kind], view.joint);
  const algorithm::Block& measured = context_.builder.at(from);
  const task::Quantity& quantity = task_.quantities.at(view.number);
  if (measured.unit != quantity.unit)
    throw fault(std::string(context_.view.terms().text(view.number)),
                fmt::format("it is in {}, but the {} of {} is in {}", quantity.unit, kSlots[kind],
                            joint, measured.unit),
                "state a unit of the same dimension");
  const BlockIndex out = signal("signal", view.number, quantity.unit);
  close(kOperations[kind], {from, out}, view.id);
  return out;
}

BlockIndex ControlSignals::evaluator(const task::Evaluator& evaluator) {
  const task::Constraint& constraint = task_.constraints.at(evaluator.constraint);
  if (!evaluator.error) return number(constraint.reference);
  const BlockIndex quantity = number(constraint.quantity);
  const BlockIndex error = signal("signal", evaluator.error, unit_of(evaluator.error));
  switch (constraint.kind) {
    case ConstraintKind::kEqual:
      close("error-of-equality", {quantity, number(constraint.reference), error}, evaluator.id);
      break;
    case ConstraintKind::kGreaterThan:
      close("error-of-lower-bound", {quantity, number(constraint.reference), error}, evaluator.id);
      break;
    case ConstraintKind::kLessThan:
      close("error-of-upper-bound", {quantity, number(constraint.reference), error}, evaluator.id);
      break;
    case ConstraintKind::kBetween:
      close("error-of-interval",
            {quantity, number(constraint.lower), number(constraint.upper), error}, evaluator.id);
      break;
  }
  return error;
}

BlockIndex ControlSignals::measured_pose(const task::Spatial& spatial, const SpatialPlace& place) {
  const BlockIndex from_root = context_.block("pose", place.frame);
  if (!place.wrt) return from_root;
  const BlockIndex base = context_.builder.block({.slot = "root-pose",
                                                  .represents = place.wrt,
                                                  .quantity = "pose",
                                                  .of = context_.robot.root_frame,
                                                  .wrt = place.wrt,
                                                  .role = Role::kConstant,
                                                  .value = place.root_in_wrt});
  const BlockIndex pose = context_.builder.block({.slot = "measured-pose",
                                                  .represents = spatial.id,
                                                  .quantity = "pose",
                                                  .of = place.frame,
                                                  .wrt = place.wrt});
  close("compose-pose", {base, from_root, pose}, spatial.id);
  return pose;
}

BlockIndex ControlSignals::pose(Id coordinates) {
  const task::Spatial& spatial = task_.spatials.at(coordinates);
  const SpatialPlace& place = control_.places.at(coordinates);
  if (!spatial.value && !spatial.setpoint) return measured_pose(spatial, place);
  BlockSpec spec = {.slot = spatial.setpoint ? "setpoint" : "desired-pose",
                    .represents = coordinates,
                    .quantity = "pose",
                    .of = spatial.of,
                    .wrt = place.wrt ? place.wrt : context_.robot.root_frame,
                    .role = spatial.setpoint ? Role::kInput : Role::kConstant};
  if (!spatial.setpoint) spec.value = *spatial.value;
  return context_.builder.block(spec);
}

// The sum of what views put into a wrench, seen from where the wrench's frame says; then seen from
// the frame at its reference point.
BlockIndex ControlSignals::commanded_wrench(Id coordinates) {
  const SpatialPlace& place = control_.places.at(coordinates);
  const Id seen_by = place.seen_from_root ? context_.robot.root_frame : place.frame;
  const auto block = [&](std::string_view slot, Id element, Id seen) {
    return context_.builder.block({.slot = slot,
                                   .represents = element,
                                   .quantity = "wrench",
                                   .of = place.body,
                                   .reference = place.frame,
                                   .seen_by = seen});
  };
  BlockIndex sum = kNoIndex;
  for (const task::View& view : task_.views) {
    if (view.spatial != coordinates) continue;
    const BlockIndex line = context_.builder.block({.slot = "line",
                                                    .represents = view.id,
                                                    .quantity = "line",
                                                    .of = place.body,
                                                    .reference = place.frame,
                                                    .seen_by = seen_by,
                                                    .role = Role::kConstant,
                                                    .value = place.axes[view.axis]});
    const BlockIndex part = block("wrench-part", view.id, seen_by);
    close(view.subspace == Subspace::kAngular ? "wrench-of-torque" : "wrench-of-force",
          {line, number(view.number), part}, view.id);
    if (sum == kNoIndex) {
      sum = part;
      continue;
    }
    const BlockIndex next = block("wrench-with", view.id, seen_by);
    close("accumulate-wrench", {sum, part, next}, view.id);
    sum = next;
  }
  if (sum == kNoIndex)
    throw fault(std::string(context_.view.terms().text(coordinates)),
                "nothing gives this wrench a value",
                "add a WrenchCoordinateView of a controller's control signal");
  if (!place.seen_from_root) return sum;
  context_.board.put("frame-wrench-from-root", coordinates, sum);
  const BlockIndex own = block("wrench-seen-from-itself", coordinates, place.frame);
  close("rotate-wrench-to-distal", {context_.block("pose", place.frame), sum, own}, coordinates);
  return own;
}

BlockIndex ControlSignals::wrench(Id coordinates) {
  if (const auto found = wrenches_.find(coordinates); found != wrenches_.end())
    return found->second;
  for (const task::Controller& one : task_.controllers)
    if (one.kind == task::ControllerKind::kPoseImpedance && one.control == coordinates)
      pose_impedance(one);
  if (const auto found = wrenches_.find(coordinates); found != wrenches_.end())
    return found->second;
  return wrenches_[coordinates] = commanded_wrench(coordinates);
}

void ControlSignals::hand_out() {
  std::vector<BlockIndex>& outputs = context_.task_outputs;
  for (const task::Monitor& monitor : task_.monitors) {
    const Watch result = watch(monitor);
    if (monitor.flag) outputs.push_back(result.flag);
    if (monitor.event) outputs.push_back(result.event);
  }
  for (const task::Controller& one : task_.controllers)
    outputs.push_back(one.kind == task::ControllerKind::kPoseImpedance ? wrench(one.control)
                                                                       : number(one.control));
}

void ControlSignals::make_all() {
  for (const task::Evaluator& evaluator : task_.evaluators)
    if (evaluator.error) number(evaluator.error);
  for (const task::Monitor& monitor : task_.monitors) watch(monitor);
  for (const task::Controller& one : task_.controllers)
    if (one.kind == task::ControllerKind::kPoseImpedance)
      wrench(one.control);
    else
      number(one.control);
  if (task_.solver)
    for (const task::Driver& driver : task_.solver->cartesian_forces) wrench(driver.quantity);
  hand_out();
  for (const Kept& one : kept_) close(one.operation, {one.value, one.state}, one.about);
  kept_.clear();
}

// --- Parts of the algorithm.

BlockIndex ControlSignals::signal(std::string_view slot, Id element, std::string_view unit) {
  return context_.builder.block(
      {.slot = slot, .represents = element, .quantity = "signal", .unit = unit});
}

BlockIndex ControlSignals::constant(std::string_view slot, Id element, std::string_view unit,
                                    double value) {
  const double values[] = {value};
  return context_.builder.block({.slot = slot,
                                 .represents = element,
                                 .quantity = "signal",
                                 .role = Role::kConstant,
                                 .unit = unit,
                                 .value = values});
}

BlockIndex ControlSignals::state(std::string_view slot, Id element, std::string_view unit,
                                 double first) {
  const double values[] = {first};
  return context_.builder.block({.slot = slot,
                                 .represents = element,
                                 .quantity = "signal",
                                 .role = Role::kState,
                                 .unit = unit,
                                 .value = values});
}

BlockIndex ControlSignals::zero_like(Id number) {
  return constant("zero", number, unit_of(number), 0);
}

}  // namespace sinew::synthesis
