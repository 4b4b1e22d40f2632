// A robot with joints of many kinds in DART, which has joints of the same kinds.
#pragma once

#include "mujoco_joints.h"

namespace sinew::test {

// Of revolute, prismatic, helical, universal, planar, spherical and floating joints; none may
// follow another or carry a rotor. Coordinates and numbers are those of the robot.
PeerAnswer ask_dart(const TestRobot& robot, const Eigen::Vector3d& gravity, const DenseState& state,
                    const Eigen::VectorXd& given_force);

}  // namespace sinew::test
