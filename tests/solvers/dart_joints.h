// A robot with joints of many kinds in DART, which has joints of the same kinds.
#pragma once

#include "dense_reference.h"

namespace sinew::test {

// Of revolute, prismatic, helical, universal, planar, spherical and floating joints; none may
// follow another or carry a rotor. Coordinates and numbers are those of the robot.
struct DartAnswer {
  Eigen::VectorXd force;         // for the state's accelerations
  Eigen::VectorXd acceleration;  // for `given_force`
  Eigen::MatrixXd mass_matrix;
};
DartAnswer ask_dart(const TestRobot& robot, const Eigen::Vector3d& gravity, const DenseState& state,
                    const Eigen::VectorXd& given_force);

}  // namespace sinew::test
