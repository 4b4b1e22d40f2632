#include "sinew/model/sizes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sinew::model {
namespace {

constexpr const char* kCheckUnits = "check the number and its unit";

struct Checker {
  const graph::Terms& terms;
  const graph::Places& places;
  Report& report;

  void fault(Id node, std::string what, std::string remedy = kCheckUnits) {
    report.error(places.find(node), std::string(terms.text(node)), std::move(what),
                 std::move(remedy));
  }

  void length(Id node, const Vector3& numbers, std::string_view what) {
    if (!within(numbers, kLargestLength))
      fault(node, fmt::format("{} is longer than {:g} m", what, kLargestLength));
  }

  void limits(Id node, const JointLimits& l) {
    for (const double limit : {l.lower, l.upper, l.maximum_velocity, l.maximum_force})
      if (std::isinf(limit)) return fault(node, "a limit of the joint overflows in SI units");
  }

  void joint(const Structure::Joint& joint) {
    limits(joint.iri, joint.limits);
    for (const Structure::Motion& motion : joint.motions) {
      limits(motion.iri ? motion.iri : joint.iri, motion.limits);
      if (motion.follows && !within(motion.ratio, kLargestRatio))
        fault(joint.iri, fmt::format("its pitch is beyond {:g} m/rad", kLargestRatio));
    }
    if (!joint.mimicry) return;
    if (!within(joint.mimicry->multiplier, kLargestRatio))
      fault(joint.mimicry->node,
            fmt::format("the joint follows another more than {:g} times as far", kLargestRatio));
    if (!within(joint.mimicry->offset, kLargestLength))
      fault(joint.mimicry->node,
            fmt::format("the offset to the joint that it follows is beyond {:g}", kLargestLength));
  }
};

}  // namespace

bool within(double number, double largest) { return std::abs(number) <= largest; }

bool within(const Vector3& numbers, double largest) {
  return within(numbers.x, largest) && within(numbers.y, largest) && within(numbers.z, largest);
}

std::string fault_of_size(const RigidBodyInertia& I) {
  if (!within(I.mass, kLargestMass))
    return fmt::format("the mass is {:g} kg, more than {:g} kg", I.mass, kLargestMass);
  if (I.mass > 0 && I.mass < kSmallestMass)
    return fmt::format("the mass is {:g} kg: not zero, but less than {:g} kg", I.mass,
                       kSmallestMass);
  if (!within(I.first_moment, kLargestFirstMoment))
    return fmt::format("the first moment of mass is beyond {:g} kg m", kLargestFirstMoment);
  double largest = 0;
  const auto& S = I.rotational;
  for (const double entry : {S.xx, S.xy, S.xz, S.yy, S.yz, S.zz}) {
    if (!within(entry, kLargestMoment))
      return fmt::format("a moment of inertia is beyond {:g} kg m^2", kLargestMoment);
    largest = std::max(largest, std::abs(entry));
  }
  if (largest > 0 && largest < kSmallestMoment)
    return fmt::format("the moments of inertia are not zero, but less than {:g} kg m^2",
                       kSmallestMoment);
  return {};
}

void check_sizes(const Structure& structure, const graph::Terms& terms, const graph::Places& places,
                 Report& report) {
  Checker checker{terms, places, report};
  for (const Structure::Inertia& inertia : structure.inertias)
    if (std::string what = fault_of_size(inertia.value); !what.empty())
      checker.fault(inertia.coordinate, std::move(what));
  for (const Structure::ConstantPose& pose : structure.poses)
    checker.length(pose.coordinate, pose.pose.p, "the position");
  for (const Structure::Position& position : structure.positions)
    checker.length(position.coordinate, position.position, "the position");
  for (const Structure::Joint& joint : structure.joints) checker.joint(joint);
  for (const Structure::BaseAcceleration& stated : structure.base_accelerations)
    if (!within(stated.value.linear, kLargestAcceleration) ||
        !within(stated.value.angular, kLargestAcceleration))
      checker.fault(stated.coordinate, fmt::format("the base accelerates by more than {:g} m/s^2",
                                                   kLargestAcceleration));
}

}  // namespace sinew::model
