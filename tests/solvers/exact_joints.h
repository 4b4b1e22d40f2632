// A robot of random_joints.h for dynamics in any precision.
#pragma once

#include "exact_dynamics.h"
#include "random_joints.h"

namespace sinew::test {

template <typename S>
ExactRobot<S> exact_robot(const TestRobot& robot) {
  ExactRobot<S> exact;
  exact.velocities = robot.velocities;
  for (const TestLink& link : robot.links)
    exact.links.push_back({"", S(link.mass), link.com.cast<S>(), link.inertia.cast<S>()});
  for (const TestJoint& joint : robot.joints) {
    ExactJoint<S> one;
    one.parent = joint.parent;
    one.rotation = joint.placement.linear().cast<S>();
    one.translation = joint.placement.translation().cast<S>();
    one.velocity = joint.velocity;
    one.position = joint.position;
    if (joint.motions.empty())
      one.kind = joint.kind == "floating" ? ExactKind::kFloating : ExactKind::kSpherical;
    const TestJoint& owner =
        joint.leader < 0 ? joint : robot.joints[static_cast<std::size_t>(joint.leader)];
    for (const TestMotion& motion : joint.motions)
      one.motions.push_back({motion.turns, motion.axis.cast<S>(), motion.coordinate,
                             owner.position + motion.coordinate - owner.velocity, S(motion.ratio),
                             S(motion.offset)});
    if (joint.rotor > 0) {
      const S turns = S(joint.gear) * S(joint.motions.front().ratio);
      one.reflected = turns * turns * S(joint.rotor);
    }
    exact.joints.push_back(std::move(one));
  }
  return exact;
}

}  // namespace sinew::test
