// What a robot does as a whole, and what its joints carry, from the dense matrices of its bodies.
#pragma once

#include "dense_reference.h"

namespace sinew::test {

struct DenseWhole {
  double mass = 0;
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();
  Eigen::MatrixXd center_jacobian;             // 3 x n
  Eigen::MatrixXd momentum_matrix;             // 6 x n, angular about the base's origin
  Eigen::MatrixXd centroidal_momentum_matrix;  // 6 x n, angular about the centre of mass
  double potential_energy = 0;                 // zero for a mass at the base's origin
};
DenseWhole whole(const TestRobot& robot, const DenseReference& reference,
                 const Eigen::Vector3d& gravity, const Eigen::VectorXd& position);

// Of each body: what moves it (moment about the base's origin, force), seen from the base.
std::vector<Eigen::VectorXd> body_wrenches(const TestRobot& robot, const DenseReference& reference,
                                           const Eigen::Vector3d& gravity, const DenseState& state);

// All that a joint transmits to what is behind it: about the origin of the link behind it, and seen
// from there. `wrenches`: of the bodies.
Eigen::VectorXd joint_wrench(const TestRobot& robot, const DenseReference& reference,
                             const std::vector<Eigen::VectorXd>& wrenches,
                             const Eigen::VectorXd& position, std::size_t joint);

// Position and quaternion x y z w, w >= 0, of a link; and their derivative by each velocity, 7 x n,
// by differences of fourth order.
Eigen::VectorXd position_and_quaternion(const DenseReference& reference,
                                        const Eigen::VectorXd& position, int link);
Eigen::MatrixXd analytic_jacobian(const DenseReference& reference, const Eigen::VectorXd& position,
                                  int velocities, int link);

}  // namespace sinew::test
