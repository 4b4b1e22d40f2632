// What a robot does, by dense matrices: every body's Jacobian from where its joints' axes are, and
// Newton's and Euler's laws for each body in the world's directions. Slow, and nothing of Sinew.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "random_joints.h"

namespace sinew::test {

struct DenseState {
  Eigen::VectorXd position;                // numbers of all joints, in their order
  Eigen::VectorXd velocity, acceleration;  // of coordinates
};

class DenseReference {
 public:
  DenseReference(const TestRobot& robot, const Eigen::Vector3d& gravity)
      : robot_(robot), gravity_(gravity) {}

  // Of a link, in the base.
  Eigen::Isometry3d pose(const Eigen::VectorXd& position, int link) const;
  // 6 x n, angular first, of the origin of a link's frame, seen from the base.
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& position, int link) const;
  Eigen::MatrixXd mass_matrix(const Eigen::VectorXd& position) const;
  Eigen::VectorXd inverse_dynamics(const DenseState& state) const;
  // The rate of a Jacobian as the robot moves, times the velocities; by differences of fourth
  // order.
  Eigen::VectorXd jacobian_rate(const DenseState& state, int link) const;
  // Positions after moving for a time with these velocities.
  Eigen::VectorXd moved(const Eigen::VectorXd& position, const Eigen::VectorXd& velocity,
                        double time) const;

 private:
  struct Body {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    Eigen::MatrixXd jacobian;
  };
  std::vector<Body> bodies(const Eigen::VectorXd& position) const;
  void move(const TestJoint& joint, const Eigen::VectorXd& position, Body& body) const;

  const TestRobot& robot_;
  Eigen::Vector3d gravity_;
};

DenseState random_state(const TestRobot& robot, unsigned seed);

}  // namespace sinew::test
