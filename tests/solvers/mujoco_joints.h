// A robot with joints of many kinds in MuJoCo, which has hinges, slides and balls, one after the
// other in one body.
#pragma once

#include <memory>

#include "dense_reference.h"

namespace sinew::test {

// What a library says of one state; coordinates and numbers are those of the robot.
struct PeerAnswer {
  Eigen::VectorXd force;         // for the state's accelerations
  Eigen::VectorXd acceleration;  // for `given_force`
  Eigen::MatrixXd mass_matrix;
  std::vector<Eigen::Isometry3d> poses;    // of the links
  std::vector<Eigen::MatrixXd> jacobians;  // 6 x n, angular first, seen from the base
};

// Of revolute, prismatic, cylindrical, planar, universal, spherical and composite joints; none may
// follow another. A quaternion is w x y z there, and a ball's velocity is seen from the child, as
// ours.
class MujocoJoints {
 public:
  MujocoJoints(const TestRobot& robot, const Eigen::Vector3d& gravity);
  ~MujocoJoints();
  PeerAnswer ask(const DenseState& state, const Eigen::VectorXd& given_force);

 private:
  struct Model;
  std::unique_ptr<Model> model_;
};

}  // namespace sinew::test
