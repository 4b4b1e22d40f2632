#include "dense.h"

#include <limits>
#include <stdexcept>

namespace sinew::test {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

VectorXd vector(const peers::Vector& numbers) {
  return Eigen::Map<const VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

peers::Vector wanted(std::optional<peers::Vector> numbers) {
  if (!numbers) throw std::runtime_error("the peer does not know this quantity");
  return *numbers;
}

MatrixXd jacobian(peers::Peer& peer, const peers::State& state, const std::string& link) {
  const peers::Vector numbers = wanted(peer.quantity(state, "jacobian", link));
  return Eigen::Map<const RowMajor>(numbers.data(), 6,
                                    static_cast<Eigen::Index>(numbers.size() / 6));
}

Eigen::Matrix3d rotation(peers::Peer& peer, const peers::State& state, const std::string& link) {
  const peers::Vector X = peer.link_pose(state, link);
  Eigen::Matrix3d R;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) R(r, c) = X[static_cast<std::size_t>(4 * r + c)];
  return R;
}

Eigen::Matrix<double, 6, 1> turned(const Eigen::Matrix3d& R, const double* six) {
  Eigen::Matrix<double, 6, 1> result;
  result << R * Eigen::Map<const Eigen::Vector3d>(six),
      R * Eigen::Map<const Eigen::Vector3d>(six + 3);
  return result;
}

struct Equations {
  MatrixXd M;
  VectorXd force;  // all but constraint forces
};

Equations equations(peers::Peer& peer, const Problem& problem) {
  peers::State still = problem.state;
  still.acceleration.assign(still.acceleration.size(), 0);
  Equations result;
  const peers::Vector mass = peer.mass_matrix(still);
  const auto n = static_cast<Eigen::Index>(still.velocity.size());
  result.M = Eigen::Map<const RowMajor>(mass.data(), n, n);
  result.force = vector(problem.force) - vector(peer.inverse_dynamics(still));
  for (const DenseWrench& one : problem.wrenches)
    result.force += jacobian(peer, still, one.link).transpose() *
                    turned(rotation(peer, still, one.link), one.wrench.data());
  return result;
}

}  // namespace

DenseSolution solve_densely(peers::Peer& peer, const Problem& problem) {
  const auto m = static_cast<Eigen::Index>(problem.constraints.size());
  const auto n = static_cast<Eigen::Index>(problem.state.velocity.size());
  peers::State still = problem.state;
  still.acceleration.assign(still.acceleration.size(), 0);
  const Equations motion = equations(peer, problem);
  DenseSolution solution;
  solution.jacobian = MatrixXd(m, n);
  solution.bias = VectorXd(m);
  VectorXd energy(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const DenseConstraint& one = problem.constraints[static_cast<std::size_t>(i)];
    const Eigen::Matrix3d R =
        one.seen_by_itself ? rotation(peer, still, one.link) : Eigen::Matrix3d::Identity();
    const Eigen::Matrix<double, 6, 1> a = turned(R, one.direction.data());
    solution.jacobian.row(i) = a.transpose() * jacobian(peer, still, one.link);
    solution.bias(i) = a.dot(vector(wanted(peer.quantity(still, "acceleration-twist", one.link))));
    energy(i) = one.energy;
  }
  MatrixXd kkt = MatrixXd::Zero(n + m, n + m);
  kkt << motion.M, -solution.jacobian.transpose(), solution.jacobian, MatrixXd::Zero(m, m);
  VectorXd right(n + m);
  right << motion.force, energy - solution.bias;
  const VectorXd all = kkt.fullPivLu().solve(right);
  solution.acceleration = all.head(n);
  solution.magnitude = all.tail(m);
  solution.constraint_force = solution.jacobian.transpose() * solution.magnitude;

  const Eigen::LDLT<MatrixXd> factors(motion.M);
  solution.coupling = solution.jacobian * factors.solve(solution.jacobian.transpose());
  solution.residual = energy - solution.bias - solution.jacobian * factors.solve(motion.force);
  const VectorXd scale = solution.coupling.diagonal().cwiseSqrt().cwiseInverse();
  solution.condition = m > 0 ? std::numeric_limits<double>::infinity() : 1;
  // A direction in which the link cannot move, but for round-off, is as singular as can be.
  const bool movable = m > 0 && solution.jacobian.rowwise().norm().minCoeff() > 1e-9;
  if (movable && scale.allFinite()) {
    const MatrixXd scaled = scale.asDiagonal() * solution.coupling * scale.asDiagonal();
    const VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(scaled).eigenvalues();
    solution.condition = values(m - 1) / std::max(values(0), 1e-300);
  }
  return solution;
}

VectorXd acceleration_under(peers::Peer& peer, const Problem& problem, const VectorXd& magnitude) {
  const Equations motion = equations(peer, problem);
  const DenseSolution solution = solve_densely(peer, problem);
  return motion.M.ldlt().solve(motion.force + solution.jacobian.transpose() * magnitude);
}

}  // namespace sinew::test
