// The equations of motion with constraints, solved as one dense system; all that is known of the
// robot comes from a peer.
//   M qdd = tau - h + sum of J_w' w + J' x,   a J qdd = energies - a Jdot qd
#pragma once

#include <Eigen/Dense>
#include <array>
#include <string>
#include <vector>

#include "peer.h"

namespace sinew::test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A unit constraint force on a link, moment first.
struct DenseConstraint {
  std::string link;
  std::array<double, 6> direction;
  bool seen_by_itself = false;
  double energy = 0;  // the acceleration that is imposed along it
};

struct DenseWrench {  // seen from the link
  std::string link;
  peers::Vector wrench;
};

struct Problem {
  peers::State state;
  peers::Vector force;
  std::vector<DenseConstraint> constraints;
  std::vector<DenseWrench> wrenches;
};

struct DenseSolution {
  VectorXd acceleration, magnitude, constraint_force;
  MatrixXd jacobian;  // a row for each constraint
  VectorXd bias;      // of each constraint: a Jdot qd
  MatrixXd coupling;  // J M^-1 J'
  VectorXd residual;  // what the magnitudes must add
  double condition =
      0;  // of the coupling, each constraint scaled to 1; infinite if one cannot move
};

// The magnitudes solve the system exactly; where it is singular they are not to be used.
DenseSolution solve_densely(peers::Peer& peer, const Problem& problem);

// The accelerations under given magnitudes.
VectorXd acceleration_under(peers::Peer& peer, const Problem& problem, const VectorXd& magnitude);

}  // namespace sinew::test
