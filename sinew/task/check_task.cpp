#include <fmt/format.h>

#include "sinew/data/units.h"
#include "sinew/task/reader.h"
#include "sinew/vocab/vocab.h"

namespace sinew::task {
namespace {

using data::Dimension;

constexpr Dimension kTime = {{0, 0, 1}};

class Checker {
 public:
  explicit Checker(Reader& reader) : reader_(reader), task_(reader.task) {}

  void check() {
    origins();
    for (const View& view : task_.views) {
      const Spatial& spatial = task_.spatials.at(view.spatial);
      expect(view.number, dimension_of(spatial.kind, view.subspace),
             fmt::format("the number of the view <{}>", text(view.id)));
    }
    for (const auto& [id, constraint] : task_.constraints) {
      for (const Id bound : {constraint.reference, constraint.lower, constraint.upper})
        if (bound) same(bound, constraint.quantity, id);
    }
    for (const Evaluator& evaluator : task_.evaluators)
      if (evaluator.error)
        same(evaluator.error, task_.constraints.at(evaluator.constraint).quantity, evaluator.id);
    for (const Monitor& monitor : task_.monitors) check(monitor);
    for (const Controller& controller : task_.controllers) check(controller);
    for (const Handler& handler : task_.handlers) check(handler);
    if (task_.solver)
      for (const AccelerationConstraint& constraint : task_.solver->constraints)
        for (const AxisConstraint& axis : constraint.axes) check(axis);
    one_handler();
  }

 private:
  std::string text(Id id) const { return std::string(reader_.graph.text(id)); }
  const Dimension& dimension(Id number) const { return task_.quantities.at(number).dimension; }

  void expect(Id number, const Dimension& wanted, const std::string& what) {
    if (dimension(number) == wanted) return;
    reader_.error(number, vocab::qudt::unit,
                  fmt::format("{} is in {}", what, task_.quantities.at(number).unit),
                  fmt::format("a unit of dimension '{}', such as {}", data::to_string(wanted),
                              data::coherent_unit(wanted)));
  }
  void same(Id number, Id other, Id because) {
    expect(number, dimension(other),
           fmt::format("this quantity of <{}>, which must fit <{}>,", text(because), text(other)));
  }
  // left = factor * right
  void gain(Id number, Id left, Id right, const Dimension& other, const std::string& what) {
    expect(number, dimension(left) / dimension(right) / other, what);
  }

  static Dimension dimension_of(SpatialKind kind, Subspace subspace) {
    using namespace model::dimension;
    const bool angular = subspace == Subspace::kAngular;
    switch (kind) {
      case SpatialKind::kPose:
        return kLength;
      case SpatialKind::kVelocityTwist:
        return angular ? kAngularVelocity : kVelocity;
      case SpatialKind::kAccelerationTwist:
        return angular ? kAngularAcceleration : kAcceleration;
      case SpatialKind::kWrench:
        return angular ? kTorque : kForce;
    }
    return {};
  }

  void check(const Monitor& monitor) {
    if (monitor.tolerance) same(monitor.tolerance, monitor.error, monitor.id);
    if (monitor.release_tolerance) {
      same(monitor.release_tolerance, monitor.error, monitor.id);
      const auto &inner = task_.quantities.at(monitor.tolerance).value,
                 &outer = task_.quantities.at(monitor.release_tolerance).value;
      if (inner && outer && *outer < *inner)
        reader_.error(monitor.id, vocab::st::release_tolerance,
                      "the release tolerance is below the tolerance", "it is wider");
    }
    if (monitor.tolerance) return;
    for (const Evaluator& evaluator : task_.evaluators)
      if (evaluator.error == monitor.error &&
          task_.constraints.at(evaluator.constraint).kind == ConstraintKind::kEqual)
        reader_.error(monitor.id, vocab::st::tolerance,
                      "an equality is watched without a tolerance: it would hardly ever hold",
                      "state the \"tolerance\"");
  }

  // An energy, or the acceleration at which a unit force has it.
  void check(const AxisConstraint& axis) {
    const bool angular = axis.subspace == Subspace::kAngular;
    const Dimension energy = model::dimension::kForce * model::dimension::kAcceleration;
    if (dimension(axis.energy) == energy) return;
    expect(axis.energy, dimension_of(SpatialKind::kAccelerationTwist, axis.subspace),
           fmt::format("the acceleration energy of <{}>, which may be in N-M-PER-SEC2 or in {},",
                       text(axis.id), angular ? "RAD-PER-SEC2" : "M-PER-SEC2"));
  }

  void check(const Controller& controller) {
    const std::string of = fmt::format(" of <{}>", text(controller.id));
    const Dimension none;
    switch (controller.kind) {
      case ControllerKind::kDamping:
        same(controller.maximum_velocity, controller.velocity, controller.id);
        same(controller.control, controller.maximum_force, controller.id);
        if (task_.quantities.at(controller.maximum_velocity).value == 0.0)
          reader_.error(controller.id, vocab::cstr_hdl::maximum_velocity,
                        "the maximum velocity is zero", "the formula divides by it");
        break;
      case ControllerKind::kPid:
        gain(controller.proportional, controller.control, controller.error, none,
             "the proportional gain" + of);
        gain(controller.integral, controller.control, controller.error, kTime,
             "the integral gain" + of);
        gain(controller.derivative, controller.control, controller.error, none / kTime,
             "the derivative gain" + of);
        if (controller.decay_rate)
          expect(controller.decay_rate, none / kTime, "the decay rate" + of);
        if (controller.limit) same(controller.limit, controller.control, controller.id);
        break;
      case ControllerKind::kSpringDamper:
        gain(controller.stiffness, controller.control, controller.error, none,
             "the stiffness" + of);
        gain(controller.damping, controller.control, controller.velocity, none, "the damping" + of);
        if (controller.desired_velocity)
          same(controller.desired_velocity, controller.velocity, controller.id);
        for (const Id acceleration :
             {controller.desired_acceleration, controller.measured_acceleration})
          if (acceleration && controller.inertia)
            gain(controller.inertia, controller.control, acceleration, none, "the inertia" + of);
        break;
      case ControllerKind::kPoseImpedance:
        break;  // its units are checked where they are read
    }
    const Handler* handler = task_.handler_of(controller.id);
    if (controller.kind == ControllerKind::kPid && (handler == nullptr || !handler->period_s))
      reader_.error(controller.id, "", "it integrates over time, but nothing says in which steps",
                    "put it among the controllers of a ConstraintHandler with a \"period\"");
  }

  // An element runs at one rate and with one motion.
  void one_handler() {
    std::unordered_map<Id, Id> of;
    for (const Handler& handler : task_.handlers)
      for (const auto* list : {&handler.evaluators, &handler.monitors, &handler.controllers})
        for (const Id element : *list) {
          const auto [found, fresh] = of.try_emplace(element, handler.id);
          if (!fresh && found->second != handler.id)
            reader_.error(element, "",
                          fmt::format("it belongs to <{}> and to <{}>", text(found->second),
                                      text(handler.id)),
                          "one handler for each element");
        }
  }

  bool is_watched(Id constraint) const {
    for (const Evaluator& evaluator : task_.evaluators)
      for (const Monitor& monitor : task_.monitors)
        if (evaluator.constraint == constraint && evaluator.error &&
            evaluator.error == monitor.error)
          return true;
    return false;
  }

  void check(const Handler& handler) {
    if (!handler.motion) return;
    for (const auto* list :
         {&handler.motion->when, &handler.motion->while_, &handler.motion->until})
      for (const Id constraint : *list) {
        if (!task_.constraints.contains(constraint))
          reader_.error(handler.motion->id, "",
                        fmt::format("<{}> is no constraint", text(constraint)),
                        "name nodes of the type Constraint");
        else if (list != &handler.motion->while_ && !is_watched(constraint))
          reader_.error(constraint, "",
                        "a motion begins or ends by it, but no monitor watches its error",
                        "add an ErrorEvaluator and a Monitor of its error");
      }
  }

  // Every number has one origin, and every number that is used has one.
  void origins() {
    std::unordered_map<Id, Id> origin;
    note_origins(origin);
    for_each_used([&](Id number, Id user) {
      if (number && !origin.contains(number))
        reader_.error(number, "",
                      fmt::format("<{}> needs it, but nothing gives it a value", text(user)),
                      "state its value, make it a Setpoint, or let a view, an evaluator or a "
                      "controller compute it");
    });
  }

  template <typename Visit>
  void for_each_used(Visit&& visit) const {
    for (const View& view : task_.views)
      if (is_commanded(view)) visit(view.number, view.id);
    for (const JointView& view : task_.joint_views)
      if (is_commanded(view)) visit(view.number, view.id);
    for (const Evaluator& evaluator : task_.evaluators) {
      const Constraint& constraint = task_.constraints.at(evaluator.constraint);
      if (evaluator.error) visit(constraint.quantity, evaluator.id);
      for (const Id bound : {constraint.reference, constraint.lower, constraint.upper})
        visit(bound, evaluator.id);
    }
    for (const Monitor& monitor : task_.monitors)
      for (const Id number : {monitor.error, monitor.tolerance, monitor.release_tolerance})
        visit(number, monitor.id);
    for (const Controller& one : task_.controllers)
      for (const Id number :
           {one.error, one.velocity, one.maximum_velocity, one.maximum_force, one.proportional,
            one.integral, one.derivative, one.decay_rate, one.limit, one.stiffness, one.damping,
            one.desired_velocity, one.inertia, one.desired_acceleration, one.measured_acceleration})
        visit(number, one.id);
    if (!task_.solver) return;
    for (const AccelerationConstraint& constraint : task_.solver->constraints)
      for (const AxisConstraint& axis : constraint.axes) visit(axis.energy, axis.id);
  }

  void note_origins(std::unordered_map<Id, Id>& origin) {
    const auto note = [&](Id number, Id element) {
      const auto [found, fresh] = origin.try_emplace(number, element);
      if (!fresh)
        reader_.error(number, "",
                      fmt::format("it gets its value from <{}> and from <{}>", text(found->second),
                                  text(element)),
                      "a quantity has one origin");
    };
    for (const auto& [id, quantity] : task_.quantities) {
      if (quantity.value) note(id, id);
      if (quantity.setpoint) note(id, id);
    }
    for (const View& view : task_.views)
      if (!is_commanded(view)) note(view.number, view.id);
    for (const JointView& view : task_.joint_views)
      if (!is_commanded(view)) note(view.number, view.id);
    for (const Evaluator& evaluator : task_.evaluators)
      note(evaluator.error ? evaluator.error : task_.constraints.at(evaluator.constraint).quantity,
           evaluator.id);
    for (const Controller& controller : task_.controllers) note(controller.control, controller.id);
  }

  // A view of what drives the motion hands its number on instead of reading it.
  bool is_commanded(const View& view) const {
    return task_.spatials.at(view.spatial).kind == SpatialKind::kWrench;
  }
  bool is_commanded(const JointView& view) const {
    if (!task_.solver) return false;
    for (const auto* drivers : {&task_.solver->joint_forces, &task_.solver->joint_accelerations})
      for (const Driver& driver : *drivers)
        if (driver.quantity == view.coordinates) return true;
    return false;
  }

  Reader& reader_;
  const Task& task_;
};

}  // namespace

void check_task(Reader& reader) { Checker(reader).check(); }

}  // namespace sinew::task
