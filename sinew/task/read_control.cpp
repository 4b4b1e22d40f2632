#include <fmt/format.h>

#include <algorithm>

#include "sinew/task/reader.h"
#include "sinew/vocab/vocab.h"

namespace sinew::task {
namespace {

namespace cstr = vocab::cstr;
namespace hdl = vocab::cstr_hdl;
namespace st = vocab::st;

void read_constraint(Reader& reader, Id node) {
  Constraint constraint;
  constraint.id = node;
  constraint.quantity = reader.number(node, cstr::quantity, "the constrained quantity");
  const auto is = [&](std::string_view type) { return reader.is_a(node, type); };
  if (is(cstr::EqualityConstraint)) {
    constraint.kind = ConstraintKind::kEqual;
    constraint.reference = reader.number(node, cstr::reference_value, "the reference value");
  } else if (is(cstr::BilateralConstraint)) {
    constraint.kind = ConstraintKind::kBetween;
    constraint.lower = reader.number(node, cstr::lower_threshold, "the lower threshold");
    constraint.upper = reader.number(node, cstr::upper_threshold, "the upper threshold");
  } else if (is(cstr::GreaterThanConstraint) || is(cstr::LessThanConstraint)) {
    constraint.kind =
        is(cstr::GreaterThanConstraint) ? ConstraintKind::kGreaterThan : ConstraintKind::kLessThan;
    constraint.reference = reader.number(node, cstr::threshold, "the threshold");
  } else {
    reader.error(
        node, "", "the constraint does not say what it asks for",
        "give it the type EqualityConstraint, BilateralConstraint, or UnilateralConstraint "
        "with GreaterThanConstraint or LessThanConstraint");
    return;
  }
  reader.task.constraints.emplace(node, constraint);
}

void read_evaluator(Reader& reader, Id node) {
  Evaluator evaluator;
  evaluator.id = node;
  evaluator.constraint = reader.required(node, hdl::constraint, "the constraint to evaluate");
  if (!evaluator.constraint || !reader.task.constraints.contains(evaluator.constraint)) {
    if (evaluator.constraint && !reader.is_a(evaluator.constraint, cstr::Constraint))
      reader.error(node, hdl::constraint, "what it evaluates is no constraint",
                   "name a node of the type Constraint");
    return;
  }
  const bool assigns = reader.is_a(node, hdl::AssignmentEvaluator);
  if (assigns == reader.is_a(node, hdl::ErrorEvaluator)) {
    reader.error(node, "", "it is not said whether it evaluates an error or assigns",
                 "give it the type ErrorEvaluator or AssignmentEvaluator");
    return;
  }
  if (assigns) {
    if (reader.task.constraints.at(evaluator.constraint).kind != ConstraintKind::kEqual)
      reader.error(node, hdl::constraint, "only an equality can be assigned",
                   "evaluate the error of other constraints");
  } else {
    evaluator.error = reader.number(node, hdl::error, "the error that it computes");
    if (!evaluator.error) return;
  }
  reader.task.evaluators.push_back(evaluator);
}

void read_edge(Reader& reader, Monitor& monitor) {
  const Id edge = reader.required(monitor.id, st::edge, "which edge triggers the event");
  if (!edge) return;
  if (edge == reader.iri(st::rising)) {
    monitor.edge = Edge::kRising;
  } else if (edge == reader.iri(st::falling)) {
    monitor.edge = Edge::kFalling;
  } else if (edge == reader.iri(st::any)) {
    monitor.edge = Edge::kAny;
  } else {
    reader.error(monitor.id, st::edge, "this is no edge", "rising, falling or any");
  }
}

void read_monitor(Reader& reader, Id node) {
  Monitor monitor;
  monitor.id = node;
  monitor.error = reader.number(node, hdl::error, "the error that it watches");
  const bool level = reader.is_a(node, hdl::LevelTriggeredMonitor);
  const bool edge = reader.is_a(node, hdl::EdgeTriggeredMonitor);
  if (!level && !edge)
    reader.error(node, "", "it is not said what triggers the monitor",
                 "give it the type LevelTriggeredMonitor or EdgeTriggeredMonitor, or both");
  if (level) monitor.flag = reader.required(node, hdl::flag, "the flag that it raises");
  if (edge) {
    monitor.event = reader.required(node, hdl::event, "the event that it sends");
    read_edge(reader, monitor);
  }
  monitor.tolerance = reader.optional_number(node, st::tolerance, "the tolerance");
  monitor.release_tolerance =
      reader.optional_number(node, st::release_tolerance, "the release tolerance");
  if (monitor.release_tolerance && !monitor.tolerance)
    reader.error(node, st::release_tolerance, "a release tolerance without a tolerance",
                 "state both");
  reader.task.monitors.push_back(monitor);
}

void read_damping(Reader& reader, Controller& controller) {
  const Id node = controller.id;
  controller.kind = ControllerKind::kDamping;
  controller.velocity = reader.number(node, hdl::measured_velocity, "the measured velocity");
  controller.maximum_velocity = reader.number(node, hdl::maximum_velocity, "the maximum velocity");
  controller.maximum_force = reader.number(node, hdl::maximum_force, "the maximum force");
}

void read_pid(Reader& reader, Controller& controller) {
  const Id node = controller.id;
  controller.kind = ControllerKind::kPid;
  controller.error = reader.number(node, hdl::error_signal, "the error signal");
  controller.proportional = reader.number(node, hdl::proportional_gain, "the proportional gain");
  controller.integral = reader.number(node, hdl::integral_gain, "the integral gain");
  controller.derivative = reader.number(node, hdl::derivative_gain, "the derivative gain");
  if (reader.is_a(node, hdl::DecayingIntegralTerm))
    controller.decay_rate = reader.number(node, hdl::decay_rate, "the decay rate");
  controller.limit = reader.optional_number(node, st::output_limit, "the output limit");
}

void read_spring_damper(Reader& reader, Controller& controller) {
  const Id node = controller.id;
  controller.kind = ControllerKind::kSpringDamper;
  controller.error = reader.number(node, hdl::error_signal, "the error signal");
  controller.velocity = reader.number(node, hdl::measured_velocity, "the measured velocity");
  controller.stiffness = reader.number(node, hdl::stiffness, "the stiffness");
  controller.damping = reader.number(node, hdl::damping, "the damping");
  controller.desired_velocity =
      reader.optional_number(node, st::desired_velocity, "the desired velocity");
  controller.inertia = reader.optional_number(node, hdl::inertia, "the inertia");
  controller.desired_acceleration =
      reader.optional_number(node, st::desired_acceleration, "the desired acceleration");
  controller.measured_acceleration =
      reader.optional_number(node, st::measured_acceleration, "the measured acceleration");
  const bool accelerates = controller.desired_acceleration || controller.measured_acceleration;
  if (controller.inertia && !accelerates)
    reader.error(node, hdl::inertia, "an inertia that no acceleration meets",
                 "name the desired-acceleration, the measured-acceleration, or both");
  if (!controller.inertia && accelerates)
    reader.error(node, hdl::inertia, "an acceleration without an inertia", "state the inertia");
}

SpatialGain read_gain(Reader& reader, Id node, std::string_view property, std::string_view what,
                      const data::Dimension& angular, const data::Dimension& linear) {
  SpatialGain gain;
  gain.id = reader.required(node, property, what);
  if (!gain.id) return gain;
  const auto about = reader.graph.list_of_three(gain.id, reader.iri(st::angular));
  const auto along = reader.graph.list_of_three(gain.id, reader.iri(st::linear));
  const auto about_scale =
      reader.graph.scale(gain.id, angular, fmt::format("{} about the axes", what));
  const auto along_scale =
      reader.graph.scale(gain.id, linear, fmt::format("{} along the axes", what));
  if (about && along && about_scale && along_scale)
    gain.value = {about->x * *about_scale, about->y * *about_scale, about->z * *about_scale,
                  along->x * *along_scale, along->y * *along_scale, along->z * *along_scale};
  if (!std::ranges::all_of(gain.value, has_good_size))
    reader.error(gain.id, "",
                 fmt::format("{} has a number that is neither zero nor from {:g} to {:g}", what,
                             kSmallestQuantity, kLargestQuantity),
                 "check the numbers and their units");
  return gain;
}

void read_pose_impedance(Reader& reader, Controller& controller) {
  using namespace model::dimension;
  const Id node = controller.id;
  const data::Dimension time = {{0, 0, 1}};
  controller.kind = ControllerKind::kPoseImpedance;
  controller.measured_pose = reader.required(node, st::measured_pose, "the measured pose");
  controller.desired_pose = reader.required(node, st::desired_pose, "the desired pose");
  controller.measured_twist = reader.required(node, st::measured_twist, "the measured twist");
  controller.desired_twist = reader.optional(node, st::desired_twist);
  for (const Id spatial : {controller.measured_pose, controller.desired_pose,
                           controller.measured_twist, controller.desired_twist})
    if (spatial) read_spatial(reader, spatial);
  if (controller.desired_twist && reader.task.spatials.contains(controller.desired_twist)) {
    const Spatial& twist = reader.task.spatials.at(controller.desired_twist);
    if (twist.kind != SpatialKind::kVelocityTwist || !twist.setpoint)
      reader.error(controller.desired_twist, "", "a desired twist comes from outside",
                   "VelocityTwistCoordinate with the type Setpoint");
  }
  controller.spatial_stiffness =
      read_gain(reader, node, hdl::stiffness, "the stiffness", kTorque / kAngle, kForce / kLength);
  controller.spatial_damping = read_gain(reader, node, hdl::damping, "the damping",
                                         kTorque / kAngle * time, kForce / kLength * time);
}

void read_controller(Reader& reader, Id node) {
  Controller controller;
  controller.id = node;
  const auto is = [&](std::string_view type) { return reader.is_a(node, type); };
  const bool spatial = is(st::PoseImpedanceController);
  const int kinds = is(hdl::DampingController) + is(hdl::ProportionalIntegralDerivative) +
                    (spatial || is(hdl::ImpedanceController));
  if (kinds > 1) {
    reader.error(node, "", "one controller of several kinds", "make a controller of each");
    return;
  }
  if (is(hdl::DampingController)) {
    read_damping(reader, controller);
  } else if (is(hdl::ProportionalIntegralDerivative)) {
    read_pid(reader, controller);
  } else if (spatial) {
    read_pose_impedance(reader, controller);
  } else if (is(hdl::ImpedanceController)) {
    read_spring_damper(reader, controller);
  } else {
    reader.error(node, "", "it is not said what kind of controller this is",
                 "give it the type DampingController, ProportionalIntegralDerivative, "
                 "ImpedanceController or PoseImpedanceController");
    return;
  }
  if (spatial && reader.graph.has(node, reader.iri(hdl::inertia)))
    reader.error(node, hdl::inertia, "the impedance of a frame has no inertia of its own",
                 "impose its acceleration by hybrid dynamics (docs/tasks.md), or leave it out");
  const bool damping_alone = !reader.graph.has(node, reader.iri(hdl::control_signal)) &&
                             controller.kind == ControllerKind::kDamping;
  const std::string_view property = damping_alone ? hdl::commanded_force : hdl::control_signal;
  controller.control = spatial ? reader.required(node, property, "the control signal")
                               : reader.number(node, property, "the control signal");
  if (spatial && controller.control) read_spatial(reader, controller.control);
  reader.task.controllers.push_back(controller);
}

std::vector<Id> parts(Reader& reader, Id handler, std::string_view property,
                      std::string_view class_name, std::string_view what) {
  std::vector<Id> found = reader.objects(handler, property);
  for (const Id one : found)
    if (!reader.is_a(one, class_name))
      reader.error(one, "", fmt::format("it stands among the {}, but is none", what),
                   fmt::format("give it the type <{}>", class_name));
  return found;
}

}  // namespace

void read_constraints(Reader& reader) {
  for (const Id node : reader.graph.all(reader.iri(cstr::Constraint)))
    read_constraint(reader, node);
}

void read_monitors(Reader& reader) {
  for (const Id node : reader.graph.all(reader.iri(hdl::ConstraintEvaluator)))
    read_evaluator(reader, node);
  for (const Id node : reader.graph.all(reader.iri(hdl::Monitor))) read_monitor(reader, node);
}

void read_controllers(Reader& reader) {
  for (const Id node : reader.graph.all(reader.iri(hdl::Controller))) read_controller(reader, node);
}

void read_handlers(Reader& reader) {
  for (const Id node : reader.graph.all(reader.iri(hdl::ConstraintHandler))) {
    Handler handler;
    handler.id = node;
    handler.evaluators =
        parts(reader, node, hdl::evaluators, hdl::ConstraintEvaluator, "evaluators");
    handler.monitors = parts(reader, node, hdl::monitors, hdl::Monitor, "monitors");
    handler.controllers = parts(reader, node, hdl::controllers, hdl::Controller, "controllers");
    if (const Id motion = reader.optional(node, hdl::motion)) {
      handler.motion = GuardedMotion{motion, reader.objects(motion, vocab::mot::when),
                                     reader.objects(motion, vocab::mot::while_),
                                     reader.objects(motion, vocab::mot::until)};
    }
    if (const Id period = reader.optional_number(node, st::period, "the period")) {
      const Quantity& quantity = reader.task.quantities.at(period);
      if (quantity.dimension != data::Dimension{{0, 0, 1}} || !quantity.value ||
          *quantity.value <= 0)
        reader.error(period, "", "this is no period", "state a constant time above zero");
      else
        handler.period_s = quantity.value;
    }
    reader.task.handlers.push_back(std::move(handler));
  }
}

}  // namespace sinew::task
