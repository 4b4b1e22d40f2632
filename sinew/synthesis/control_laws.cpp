// Controllers.
#include <fmt/format.h>

#include "sinew/base/error.h"
#include "sinew/data/units.h"
#include "sinew/synthesis/control_signals.h"

namespace sinew::synthesis {

using algorithm::Role;
using task::Controller;
using task::ControllerKind;

namespace {

// What a controller computes is its control signal unless something comes after it.
constexpr std::string_view kControl = "signal";

constexpr data::Dimension kTime = {{0, 0, 1}};

}  // namespace

std::string_view ControlSignals::computed_slot(const Controller& controller,
                                               std::string_view last) const {
  const task::Handler* handler = task_.handler_of(controller.id);
  return (handler && handler->motion) || is_slow(handler) ? "computed" : last;
}

BlockIndex ControlSignals::controller(const Controller& controller) {
  const auto block = [&] {
    const std::string_view slot = computed_slot(controller, kControl);
    return signal(slot, controller.control, unit_of(controller.control));
  };
  switch (controller.kind) {
    case ControllerKind::kDamping: {
      const BlockIndex velocity = number(controller.velocity),
                       maximum_velocity = number(controller.maximum_velocity),
                       maximum_force = number(controller.maximum_force), force = block();
      close("damping", {velocity, maximum_velocity, maximum_force, force}, controller.id);
      return hand_on(controller, force);
    }
    case ControllerKind::kSpringDamper:
      return hand_on(controller, impedance(controller, computed_slot(controller, kControl)));
    case ControllerKind::kPid:
      return hand_on(controller, pid(controller, computed_slot(controller, kControl)));
    case ControllerKind::kPoseImpedance:
      break;
  }
  throw Error(Problem{{},
                      std::string(context_.view.terms().text(controller.id)),
                      "a wrench stands where a number is needed",
                      "name the wrench among the solver's cartesian forces",
                      {},
                      {}});
}

// f = k e - d (v - v_d) - m (a - a_d), with what is stated of it.
BlockIndex ControlSignals::impedance(const Controller& controller, std::string_view slot) {
  const Id id = controller.id;
  const BlockIndex error = number(controller.error), stiffness = number(controller.stiffness),
                   damping = number(controller.damping);
  BlockIndex velocity = number(controller.velocity);
  if (controller.desired_velocity) {
    const BlockIndex relative = signal("relative-velocity", id, unit_of(controller.velocity));
    close("error-of-equality", {number(controller.desired_velocity), velocity, relative}, id);
    velocity = relative;
  }
  const std::string& unit = unit_of(controller.control);
  const BlockIndex force =
      signal(controller.inertia ? "without-inertia" : slot, controller.control, unit);
  close("spring-damper", {error, velocity, stiffness, damping, force}, id);
  if (!controller.inertia) return force;
  const Id measured = controller.measured_acceleration, desired = controller.desired_acceleration;
  BlockIndex acceleration;
  if (measured) {
    acceleration = signal("missing-acceleration", id, unit_of(measured));
    close("error-of-equality",
          {number(measured), desired ? number(desired) : zero_like(measured), acceleration}, id);
  } else {
    acceleration = number(desired);
  }
  const BlockIndex total = signal(slot, controller.control, unit);
  close("inertia-force", {force, number(controller.inertia), acceleration, total}, id);
  return total;
}

// The integral and the rate are left out where their gains are known to be zero.
BlockIndex ControlSignals::pid(const Controller& controller, std::string_view slot) {
  const task::Handler* handler = task_.handler_of(controller.id);
  const auto dimension = [&](Id id) { return task_.quantities.at(id).dimension; };
  const std::string integral_unit = data::coherent_unit(dimension(controller.error) * kTime);
  const std::string rate_unit = data::coherent_unit(dimension(controller.error) / kTime);
  const auto is_zero = [&](Id id) { return task_.quantities.at(id).value == 0.0; };
  const BlockIndex error = number(controller.error), proportional = number(controller.proportional),
                   integral_gain = number(controller.integral),
                   derivative = number(controller.derivative);
  const BlockIndex step = constant("time-step", handler->id, "SEC", *handler->period_s);
  const Id id = controller.id;

  BlockIndex integral = constant("no-integral", id, integral_unit, 0), next = integral;
  const bool integrates = !is_zero(controller.integral);
  const BlockIndex no_integral = integral;
  if (integrates) {
    integral = state("integral", id, integral_unit, 0);
    next = signal("integral-next", id, integral_unit);
    const BlockIndex decay = controller.decay_rate ? number(controller.decay_rate)
                                                   : constant("no-decay", id, "PER-SEC", 0);
    close("decaying-integral", {integral, error, decay, step, next}, id);
  }
  BlockIndex rate = constant("no-rate", id, rate_unit, 0);
  if (!is_zero(controller.derivative)) {
    const BlockIndex before = state("error-before", id, unit_of(controller.error), 0);
    const BlockIndex has_before = flag_state("has-error-before", id);
    rate = signal("error-rate", id, rate_unit);
    close("rate", {error, before, has_before, step, rate}, id);
    keep(handler, before, error, zero_like(controller.error));
    keep(handler, has_before, constant_flag(true), constant_flag(false));
  }
  const std::string& unit = unit_of(controller.control);
  const BlockIndex control =
      signal(controller.limit ? "unlimited" : slot, controller.control, unit);
  close("proportional-integral-derivative",
        {error, next, rate, proportional, integral_gain, derivative, control}, id);
  if (!controller.limit) {
    if (integrates) keep(handler, integral, next, no_integral);
    return control;
  }
  const BlockIndex limit = number(controller.limit),
                   limited = signal(slot, controller.control, unit);
  close("limit", {control, limit, limited}, id);
  if (integrates) {
    const BlockIndex kept = signal("integral-kept", id, integral_unit);
    close("anti-windup", {integral, next, error, integral_gain, control, limit, kept}, id);
    keep(handler, integral, kept, no_integral);
  }
  return limited;
}

BlockIndex ControlSignals::hand_on(const Controller& controller, BlockIndex computed) {
  const task::Handler* handler = task_.handler_of(controller.id);
  const std::string& unit = unit_of(controller.control);
  const bool gated = handler && handler->motion, slow = is_slow(handler);
  BlockIndex last = computed;
  if (gated) {
    last = signal(slow ? "gated" : kControl, controller.control, unit);
    close("choose-signal", {computed, zero_like(controller.control), active(*handler), last},
          controller.id);
  }
  if (slow) {
    const BlockIndex held = state("held", controller.control, unit, 0);
    const BlockIndex out = signal(kControl, controller.control, unit);
    close("choose-signal", {last, held, tick(*handler), out}, controller.id);
    kept_.push_back({"keep-signal", out, held, controller.id});
    last = out;
  }
  return last;
}

// The set point of a twist, seen from the frame whose origin it is about.
BlockIndex ControlSignals::desired_twist(const Controller& controller, Id frame, Id wrt) {
  const Id coordinates = controller.desired_twist;
  const SpatialPlace& place = control_.places.at(coordinates);
  const auto refuse = [&](std::string what, std::string remedy) {
    throw Error(Problem{{},
                        std::string(context_.view.terms().text(coordinates)),
                        std::move(what),
                        std::move(remedy),
                        {},
                        {}});
  };
  if (place.frame != frame)
    refuse("it is about another point than the measured twist", "about the same");
  if (place.axes[0][0] != 1 || place.axes[1][1] != 1 || place.axes[2][2] != 1)
    refuse("it is seen by a frame whose axes are neither the base's nor its own",
           "let it be seen by one of them");
  const auto twist = [&](std::string_view slot, Id seen_by, Role role) {
    return context_.builder.block({.slot = slot,
                                   .represents = coordinates,
                                   .quantity = "velocity-twist",
                                   .of = coordinates,
                                   .wrt = wrt,
                                   .reference = frame,
                                   .seen_by = seen_by,
                                   .role = role});
  };
  if (!place.seen_from_root) return twist("setpoint", frame, Role::kInput);
  const BlockIndex given = twist("setpoint", context_.robot.root_frame, Role::kInput);
  const BlockIndex own = twist("setpoint-seen-from-itself", frame, Role::kInternal);
  close("rotate-velocity-twist-to-distal", {context_.block("pose", frame), given, own},
        controller.id);
  return own;
}

void ControlSignals::pose_impedance(const Controller& controller) {
  const SpatialPlace& measured = control_.places.at(controller.measured_pose);
  const SpatialPlace& twist = control_.places.at(controller.measured_twist);
  const SpatialPlace& desired = control_.places.at(controller.desired_pose);
  const SpatialPlace& place = control_.places.at(controller.control);
  const auto text = [&](Id id) { return std::string(context_.view.terms().text(id)); };
  const auto refuse = [&](Id id, std::string what, std::string remedy) {
    throw Error(Problem{{}, text(id), std::move(what), std::move(remedy), {}, {}});
  };
  const Id frame = measured.frame;
  if (!frame) refuse(controller.measured_pose, "a measured pose with a value", "leave it out");
  if (desired.wrt != measured.wrt)
    refuse(controller.desired_pose, "it is with respect to another frame than the measured pose",
           "with respect to the same");
  if (twist.frame != frame || place.frame != frame)
    refuse(controller.id,
           fmt::format("it measures the pose of {}, but its twist or its wrench is about another "
                       "point",
                       text(frame)),
           "all at the origin of that frame");
  if (place.seen_from_root || place.axes[0][0] != 1 || place.axes[1][1] != 1)
    refuse(controller.control, "an impedance acts along the axes of its own frame",
           fmt::format("let the wrench be seen by {}", text(frame)));

  const Id id = controller.id;
  const auto spatial = [&](std::string_view slot, std::string_view quantity, Id of, Id wrt) {
    return context_.builder.block({.slot = slot,
                                   .represents = id,
                                   .quantity = quantity,
                                   .of = of,
                                   .wrt = wrt,
                                   .reference = frame,
                                   .seen_by = frame});
  };
  const auto gain = [&](std::string_view slot, std::string_view quantity,
                        const task::SpatialGain& value) {
    return context_.builder.block({.slot = slot,
                                   .represents = value.id,
                                   .quantity = quantity,
                                   .seen_by = frame,
                                   .role = Role::kConstant,
                                   .value = value.value});
  };
  const BlockIndex error =
      spatial("pose-error", "pose-error", task_.spatials.at(controller.desired_pose).of, frame);
  close("pose-error", {pose(controller.measured_pose), pose(controller.desired_pose), error}, id);
  const BlockIndex seen_from_root = context_.block("twist", frame);
  const algorithm::Block from = context_.builder.at(seen_from_root);
  const BlockIndex velocity =
      spatial("twist-seen-from-itself", "velocity-twist", from.symbols[0], from.symbols[1]);
  close("rotate-velocity-twist-to-distal",
        {context_.block("pose", frame), seen_from_root, velocity}, id);

  BlockIndex relative = velocity;
  if (controller.desired_twist) {
    relative =
        spatial("relative-twist", "velocity-twist", from.symbols[0], controller.desired_twist);
    close("subtract-velocity-twist",
          {velocity, desired_twist(controller, frame, from.symbols[1]), relative}, id);
  }

  const task::Handler* handler = task_.handler_of(id);
  const bool gated = handler && handler->motion, slow = is_slow(handler);
  const auto wrench = [&](std::string_view slot, Role role) {
    constexpr double kZero[6] = {};
    algorithm::BlockSpec spec = {.slot = slot,
                                 .represents = controller.control,
                                 .quantity = "wrench",
                                 .of = from.symbols[0],
                                 .reference = frame,
                                 .seen_by = frame,
                                 .role = role};
    if (role != Role::kInternal) spec.value = kZero;
    return context_.builder.block(spec);
  };
  BlockIndex last = wrench(gated || slow ? "computed" : "wrench", Role::kInternal);
  close("impedance",
        {error, relative, gain("stiffness", "spatial-stiffness", controller.spatial_stiffness),
         gain("damping", "spatial-damping", controller.spatial_damping), last},
        id);
  if (gated) {
    const BlockIndex out = wrench(slow ? "gated" : "wrench", Role::kInternal);
    close("choose-wrench", {last, wrench("zero", Role::kConstant), active(*handler), out}, id);
    last = out;
  }
  if (slow) {
    const BlockIndex held = wrench("held", Role::kState);
    const BlockIndex out = wrench("wrench", Role::kInternal);
    close("choose-wrench", {last, held, tick(*handler), out}, id);
    kept_.push_back({"keep-wrench", out, held, id});
    last = out;
  }
  wrenches_[controller.control] = last;
}

}  // namespace sinew::synthesis
