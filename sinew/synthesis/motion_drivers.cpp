#include "sinew/synthesis/motion_drivers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sinew/algorithm/names.h"
#include "sinew/math/constraint_solve.h"
#include "sinew/synthesis/query_faults.h"

namespace sinew::synthesis {
namespace {

using algorithm::short_name;

constexpr std::string_view kAxes[] = {"angular-x", "angular-y", "angular-z",
                                      "linear-x",  "linear-y",  "linear-z"};
constexpr std::string_view kEveryJointForce = "joint-force";
// The normal equations square it, and its square must stay above round-off.
constexpr double kSmallestDamping = 1e-7;
// The coupling of constraints has the squares of these, times what the robot makes of them.
constexpr double kShortestUnitForce = 1e-6, kLongestUnitForce = 1e6;

class Resolver {
 public:
  Resolver(graph::Store& store, const graph::View& view, const Robot& robot, const Query& query,
           std::span<const ExternalWrench> wrenches, Report& report)
      : store_(store),
        view_(view),
        robot_(robot),
        query_(query),
        wrenches_(wrenches),
        report_(report) {}

  MotionDrivers resolve() {
    for (const Given& given : query_.given) {
      if (given.quantity == "acceleration-constraint") add_constraint(given);
    }
    check_singular();
    drivers_.apart = query_.drivers.list != DriverList::kTogether;
    drivers_.weighed = query_.drivers.list == DriverList::kWeighed;
    drivers_.any =
        !drivers_.constraints.empty() || drivers_.apart || !query_.drivers.limited.empty();
    if (drivers_.any) {
      read_limits();
      group();
      find_limited();
    }
    return std::move(drivers_);
  }

 private:
  bool gives(std::string_view quantity) const {
    return std::any_of(query_.given.begin(), query_.given.end(),
                       [&](const Given& given) { return given.quantity == quantity; });
  }

  Id derived(std::string_view what, std::initializer_list<Id> parts) {
    graph::Terms& terms = store_.terms();
    return terms.derived(terms.iri(std::string(kQueryNamespace) + std::string(what)), parts);
  }

  // How messages name a driver.
  static std::string name_of(const Given& given) {
    return given.iri.empty() ? given.quantity + " of " + given.of : given.iri;
  }

  void refuse(const Given& given, std::string what, std::string remedy) {
    report_.add(fault_in(query_, given.origin, name_of(given), std::move(what), std::move(remedy)));
  }

  void refuse(const Origin& origin, std::string about, std::string what, std::string remedy) {
    report_.add(fault_in(query_, origin, std::move(about), std::move(what), std::move(remedy)));
  }

  std::optional<DrivenFrame> find(const Given& given) {
    if (given.of.empty()) {
      refuse(given, "it does not say which frame it acts on", "name a frame or link");
      return std::nullopt;
    }
    DrivenFrame at;
    try {
      at.frame = find_frame(store_, view_, given.of);
    } catch (const Error& error) {
      for (const Problem& problem : error.problems())
        refuse(given, problem.iri + ": " + problem.what, problem.remedy);
      return std::nullopt;
    }
    at.body_frame = body_frame(view_, at.frame);
    if (at.body_frame == robot_.root_frame) {
      refuse(given, fmt::format("{} is fixed to the base: nothing moves it", given.of),
             "choose a frame behind a joint");
      return std::nullopt;
    }
    for (const RobotJoint& joint : robot_.joints)
      if (joint.frame == at.body_frame) at.body = joint.successor;
    if (!at.body) {
      refuse(given, fmt::format("no joint leads from the base to {}", given.of),
             "choose a frame of the tree that the query's base and tips span");
      return std::nullopt;
    }
    return at;
  }

  // ---- acceleration constraints ----

  void add_constraint(const Given& given) {
    if (given.directions.empty() && given.unit_forces.empty() && given.direction_inputs == 0)
      return refuse(given, "a constraint with no direction",
                    "state directions (linear-x ... angular-z), unit-forces, or direction-inputs");
    if (!given.seen_by.empty() && given.seen_by != kBase && given.seen_by != kItself)
      return refuse(given, fmt::format("its directions are seen by {}", given.seen_by),
                    "base or itself");
    const std::optional<DrivenFrame> at = find(given);
    if (!at) return;
    AccelerationConstraint constraint;
    graph::Terms& terms = store_.terms();
    constraint.at = *at;
    constraint.seen_by_itself = given.seen_by == kItself;
    constraint.label = short_name(given.of);
    constraint.element =
        given.iri.empty() || given.iri.starts_with("_:")
            ? derived("AccelerationConstraint",
                      {at->frame, terms.literal(constraint.seen_by_itself ? "itself" : "base"),
                       terms.integer(static_cast<int>(drivers_.constraints.size()))})
            : terms.iri(given.iri);
    const std::size_t index = drivers_.constraints.size();
    drivers_.constraints.push_back(constraint);

    for (const std::string& word : given.directions) add_axis(given, index, word);
    unsigned number = 0;
    for (const std::array<double, 6>& force : given.unit_forces) {
      add_unit_force(given, index, force, fmt::format("{}.{}", constraint.label, ++number));
    }
    for (unsigned i = 0; i < std::min<unsigned>(given.direction_inputs, kMostDirections + 1); ++i)
      add_direction(index, fmt::format("{}.{}", constraint.label, ++number), std::nullopt);
    const auto count = std::count_if(drivers_.directions.begin(), drivers_.directions.end(),
                                     [&](const auto& one) { return one.constraint == index; });
    if (static_cast<std::size_t>(count) > kMostDirections)
      refuse(given, "it has more than six directions: they depend on each other",
             "state six at most");
  }

  void add_direction(std::size_t constraint, std::string label,
                     std::optional<std::array<double, 6>> force) {
    const Id element = derived("ConstraintDirection", {drivers_.constraints[constraint].element,
                                                       store_.terms().literal(label)});
    // Two constraints on one frame: the second one's names say which it is.
    const auto same = std::count_if(drivers_.directions.begin(), drivers_.directions.end(),
                                    [&](const auto& one) { return one.label == label; });
    if (same > 0) label += fmt::format("-{}", drivers_.constraints.size());
    drivers_.directions.push_back({element, std::move(label), constraint, force});
  }

  void add_axis(const Given& given, std::size_t constraint, const std::string& word) {
    const auto axis = std::find(std::begin(kAxes), std::end(kAxes), word);
    if (axis == std::end(kAxes))
      return refuse(given, fmt::format("{} is no direction", word),
                    fmt::format("one of {}", fmt::join(kAxes, ", ")));
    std::array<double, 6> force = {};
    force[static_cast<std::size_t>(axis - std::begin(kAxes))] = 1;
    if (contradicts(given, constraint, force)) return;
    add_direction(constraint, drivers_.constraints[constraint].label + "." + word, force);
  }

  void add_unit_force(const Given& given, std::size_t constraint,
                      const std::array<double, 6>& force, std::string label) {
    double square = 0;
    for (const double number : force) square += number * number;
    if (!(square >= kShortestUnitForce * kShortestUnitForce &&
          square <= kLongestUnitForce * kLongestUnitForce))
      return refuse(given, "a unit force without a direction",
                    fmt::format("six numbers, moment first, whose length is about 1 (from {:g} to "
                                "{:g})",
                                kShortestUnitForce, kLongestUnitForce));
    if (contradicts(given, constraint, force)) return;
    add_direction(constraint, std::move(label), force);
  }

  // The same acceleration imposed twice: of one point, or of the rotation of one body.
  bool contradicts(const Given& given, std::size_t index, const std::array<double, 6>& force) {
    const AccelerationConstraint& constraint = drivers_.constraints[index];
    for (const ConstraintDirection& other : drivers_.directions) {
      const AccelerationConstraint& there = drivers_.constraints[other.constraint];
      if (other.unit_force != force || there.seen_by_itself != constraint.seen_by_itself) continue;
      const bool turns = force[3] == 0 && force[4] == 0 && force[5] == 0;
      const bool same =
          there.at.frame == constraint.at.frame ||
          (turns && !constraint.seen_by_itself && there.at.body == constraint.at.body);
      if (!same) continue;
      refuse(given,
             fmt::format("contradictory drivers: {} imposes the same acceleration already",
                         other.label),
             "impose it once");
      return true;
    }
    return false;
  }

  // ---- policies ----

  void check_singular() {
    const std::size_t count = drivers_.directions.size();
    if (count == 0) return;
    const DriverPolicy& policy = query_.drivers;
    if (gives("joint-acceleration"))
      refuse(policy.singular_origin, query_.name,
             "the accelerations of all joints and of a frame are given: they contradict "
             "each other",
             "give joint forces, or leave the acceleration constraints out");
    if (policy.singular == Singular::kUnstated)
      refuse(policy.singular_origin, query_.name,
             "it has acceleration constraints and does not say what happens where they "
             "depend on each other",
             "state singular: in-order, truncated (each with its tolerance), or damped");
    const double number = policy.singular_number;
    const bool damped = policy.singular == Singular::kDamped;
    if (policy.singular != Singular::kUnstated &&
        !(number >= (damped ? kSmallestDamping : 1e-15) && number < 1))
      refuse(policy.singular_origin, query_.name,
             fmt::format("{} is no {}", number, damped ? "damping" : "tolerance"),
             damped ? "a number from 1e-7 to below 1: 1 is the size of each constraint's "
                      "own effect"
                    : "a number from 1e-15 to below 1, for example 1e-9");
    const std::size_t most = policy.singular == Singular::kTruncated
                                 ? math::kMostTruncatedConstraints
                                 : math::kMostConstraints;
    if (count > most)
      refuse(policy.singular_origin, query_.name,
             fmt::format("{} constrained directions, more than {}", count, most),
             policy.singular == Singular::kTruncated
                 ? fmt::format("up to {} with singular: in-order", math::kMostConstraints)
                 : "constrain fewer");
  }

  void read_limits() {
    const Id property =
        view_.terms().find_iri(std::string(algorithm::kTreeNamespace) + "maximum-force");
    for (const RobotJoint& joint : robot_.joints) {
      const Id limit = property ? view_.object(joint.joint, property) : Id{};
      const auto number = limit ? view_.terms().number(limit) : std::nullopt;
      drivers_.force_limits.push_back(number.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
  }

  DriverGroup& new_group(std::string label, Id origin) {
    DriverGroup group;
    group.element = derived("DriverEffect", {origin, store_.terms().literal(label)});
    group.origin = origin;
    group.label = std::move(label);
    drivers_.groups.push_back(std::move(group));
    return drivers_.groups.back();
  }

  // Everything in one group; or each driver in one of its own; or the one that is scaled apart from
  // the rest.
  void group() {
    const Id root = robot_.root_frame;
    const bool apart = drivers_.apart;
    const bool all_joints = query_.drivers.limited == kEveryJointForce;
    DriverGroup* rest = apart ? nullptr : &new_group("drivers", root);
    if (gives("gravity")) (apart ? new_group("gravity", root) : *rest).gravity = true;
    (apart ? new_group("velocity", root) : *rest).velocity = true;
    for (std::size_t i = 0; i < wrenches_.size(); ++i) {
      const ExternalWrench& wrench = wrenches_[i];
      (apart ? new_group("wrench-" + wrench.label, wrench.frame) : drivers_.groups.front())
          .wrenches.push_back(i);
    }
    const bool of_task = query_.task && query_.task->solver &&
                         query_.task->solver->algorithm == task::Algorithm::kHybrid;
    if (gives("joint-force") || of_task) {
      DriverGroup* every = all_joints ? &new_group("joint-force", root) : nullptr;
      for (const RobotJoint& joint : robot_.joints) {
        if (joint.follows >= 0) continue;
        const std::string name(joint.label.empty() ? short_name(view_.terms().text(joint.joint))
                                                   : std::string_view(joint.label));
        const bool own = apart || names(joint.joint, name);
        DriverGroup& group = every != nullptr ? drivers_.groups.back()
                             : own            ? new_group("force-" + name, joint.joint)
                                              : drivers_.groups.front();
        group.joints.push_back(joint.joint);
      }
    }
    for (std::size_t i = 0; i < drivers_.constraints.size(); ++i) {
      const AccelerationConstraint& constraint = drivers_.constraints[i];
      const bool own = apart || names(constraint.element, constraint.label);
      std::string label = "constraint-" + constraint.label;
      const auto same = std::count_if(drivers_.groups.begin(), drivers_.groups.end(),
                                      [&](const auto& one) { return one.label == label; });
      if (same > 0) label += fmt::format("-{}", i + 1);
      (own ? new_group(std::move(label), constraint.element) : drivers_.groups.front())
          .constraints.push_back(i);
    }
  }

  bool names(Id element, std::string_view label) const {
    const std::string& limited = query_.drivers.limited;
    return !limited.empty() &&
           (limited == view_.terms().text(element) || short_name(limited) == label);
  }

  void find_limited() {
    const std::string& limited = query_.drivers.limited;
    if (limited.empty()) return;
    std::string known;
    for (std::size_t i = 0; i < drivers_.groups.size(); ++i) {
      const DriverGroup& group = drivers_.groups[i];
      if (group.gravity || group.velocity || !group.wrenches.empty()) continue;
      drivers_.limited = i;  // with another policy there is no other such group
      if (!drivers_.apart) return check_limits();
      if (limited == group.label || limited == view_.terms().text(group.origin) ||
          group.label == "constraint-" + limited || group.label == "force-" + limited)
        return check_limits();
      known += (known.empty() ? "" : ", ") + group.label;
      drivers_.limited = kNoDriver;
    }
    for (const AccelerationConstraint& one : drivers_.constraints)
      if (!drivers_.apart) known += (known.empty() ? "" : ", ") + one.label;
    refuse(query_.drivers.limited_origin, limited,
           "there is no driver of this name that actuators make, so none to scale down",
           known.empty() ? "give an acceleration constraint or joint forces"
                         : "one of " + known + ", or joint-force for all joint forces");
  }

  void check_limits() {
    bool any = false;  // of a joint that has an actuator
    for (std::size_t i = 0; i < robot_.joints.size(); ++i)
      any |= robot_.joints[i].follows < 0 && !std::isnan(drivers_.force_limits[i]);
    if (!any)
      refuse(query_.drivers.limited_origin, query_.drivers.limited,
             "it is to be scaled down until no actuator saturates, but no joint has a limit",
             "state the joints' maximum forces in the model");
  }

  graph::Store& store_;
  const graph::View& view_;
  const Robot& robot_;
  const Query& query_;
  std::span<const ExternalWrench> wrenches_;
  Report& report_;
  MotionDrivers drivers_;
};

}  // namespace

bool DriverGroup::has_joint(Id joint) const {
  return std::find(joints.begin(), joints.end(), joint) != joints.end();
}

bool DriverGroup::has_constraint(std::size_t constraint) const {
  return std::find(constraints.begin(), constraints.end(), constraint) != constraints.end();
}

MotionDrivers resolve_motion_drivers(graph::Store& store, const graph::View& view,
                                     const Robot& robot, const Query& query,
                                     std::span<const ExternalWrench> wrenches, Report& report) {
  return Resolver(store, view, robot, query, wrenches, report).resolve();
}

}  // namespace sinew::synthesis
