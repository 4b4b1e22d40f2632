#include "dense_whole.h"

namespace sinew::test {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

Matrix3d cross(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

DenseWhole whole(const TestRobot& robot, const DenseReference& reference, const Vector3d& gravity,
                 const VectorXd& position) {
  const Eigen::Index n = robot.velocities;
  DenseWhole all;
  all.center_jacobian = MatrixXd::Zero(3, n);
  all.momentum_matrix = MatrixXd::Zero(6, n);
  for (std::size_t k = 0; k < robot.links.size(); ++k) {
    const TestLink& link = robot.links[k];
    const Eigen::Isometry3d pose = reference.pose(position, static_cast<int>(k));
    const MatrixXd J = reference.jacobian(position, static_cast<int>(k));
    const Vector3d com = pose * link.com;
    const MatrixXd w = J.topRows(3);
    const MatrixXd v = J.bottomRows(3) - cross(pose.linear() * link.com) * w;
    all.mass += link.mass;
    all.center_of_mass += link.mass * com;
    all.center_jacobian += link.mass * v;
    all.momentum_matrix.bottomRows(3) += link.mass * v;
    all.momentum_matrix.topRows(3) +=
        pose.linear() * link.inertia * pose.linear().transpose() * w + cross(com) * link.mass * v;
    all.potential_energy -= link.mass * gravity.dot(com);
  }
  all.center_of_mass /= all.mass;
  all.center_jacobian /= all.mass;
  all.centroidal_momentum_matrix = all.momentum_matrix;
  all.centroidal_momentum_matrix.topRows(3) -=
      cross(all.center_of_mass) * all.momentum_matrix.bottomRows(3);
  return all;
}

std::vector<VectorXd> body_wrenches(const TestRobot& robot, const DenseReference& reference,
                                    const Vector3d& gravity, const DenseState& state) {
  std::vector<VectorXd> wrenches;
  for (std::size_t k = 0; k < robot.links.size(); ++k) {
    const TestLink& link = robot.links[k];
    const int at = static_cast<int>(k);
    const Eigen::Isometry3d pose = reference.pose(state.position, at);
    const MatrixXd J = reference.jacobian(state.position, at);
    const VectorXd twist = J * state.velocity,
                   acceleration = J * state.acceleration + reference.jacobian_rate(state, at);
    const Vector3d w = twist.head<3>(), al = acceleration.head<3>();
    const Vector3d arm = pose.linear() * link.com;
    const Vector3d force =
        link.mass * (acceleration.tail<3>() + al.cross(arm) + w.cross(w.cross(arm)) - gravity);
    const Matrix3d I = pose.linear() * link.inertia * pose.linear().transpose();
    VectorXd wrench(6);
    wrench << I * al + w.cross(I * w) + (pose * link.com).cross(force), force;
    wrenches.push_back(wrench);
  }
  return wrenches;
}

VectorXd joint_wrench(const TestRobot& robot, const DenseReference& reference,
                      const std::vector<VectorXd>& wrenches, const VectorXd& position,
                      std::size_t joint) {
  VectorXd sum = VectorXd::Zero(6);
  for (std::size_t link = joint + 1; link < robot.links.size(); ++link) {
    std::size_t at = link;
    while (at > joint + 1) at = static_cast<std::size_t>(robot.joints[at - 1].parent);
    if (at == joint + 1) sum += wrenches[link];
  }
  const Eigen::Isometry3d pose = reference.pose(position, static_cast<int>(joint) + 1);
  const Vector3d force = sum.tail<3>();
  const Vector3d moment = sum.head<3>() - pose.translation().cross(force);
  VectorXd seen(6);
  seen << pose.linear().transpose() * moment, pose.linear().transpose() * force;
  return seen;
}

VectorXd position_and_quaternion(const DenseReference& reference, const VectorXd& position,
                                 int link) {
  const Eigen::Isometry3d pose = reference.pose(position, link);
  Eigen::Quaterniond q(pose.linear());
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  VectorXd numbers(7);
  numbers << pose.translation(), q.coeffs();
  return numbers;
}

MatrixXd analytic_jacobian(const DenseReference& reference, const VectorXd& position,
                           int velocities, int link) {
  constexpr double h = 1e-3;
  const VectorXd now = position_and_quaternion(reference, position, link);
  MatrixXd J(7, velocities);
  for (int k = 0; k < velocities; ++k) {
    const auto after = [&](double time) -> VectorXd {
      VectorXd there = position_and_quaternion(
          reference, reference.moved(position, VectorXd::Unit(velocities, k), time), link);
      // On the same side of the sphere of quaternions.
      if (there.tail<4>().dot(now.tail<4>()) < 0) there.tail<4>() = -there.tail<4>();
      return there;
    };
    J.col(k) = (8 * (after(h) - after(-h)) - (after(2 * h) - after(-2 * h))) / (12 * h);
  }
  return J;
}

}  // namespace sinew::test
