#include "dense_reference.h"

#include <cmath>
#include <random>

namespace sinew::test {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

Matrix3d cross(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// A quaternion is stored x y z w.
Eigen::Quaterniond quaternion(const VectorXd& q, int at) {
  return {q[at + 3], q[at], q[at + 1], q[at + 2]};
}

}  // namespace

// The body's origin moves with it: columns so far are those of a point that is carried along.
void DenseReference::move(const TestJoint& joint, const VectorXd& position, Body& body) const {
  const auto shift = [&](const Vector3d& by) {
    // v(p + d) = v(p) + w x d
    body.jacobian.bottomRows(3) -= cross(by) * body.jacobian.topRows(3);
    body.pose.translation() += by;
  };
  shift(body.pose.linear() * joint.placement.translation());
  body.pose.linear() = body.pose.linear() * joint.placement.linear();
  if (joint.motions.empty()) {
    const bool floats = joint.kind == "floating";
    if (floats) shift(body.pose.linear() * position.segment<3>(joint.position));
    body.pose.linear() =
        body.pose.linear() * quaternion(position, joint.position + (floats ? 3 : 0)).matrix();
    body.jacobian.block<3, 3>(0, joint.velocity) += body.pose.linear();
    if (floats) body.jacobian.block<3, 3>(3, joint.velocity + 3) += body.pose.linear();
    return;
  }
  for (const TestMotion& motion : joint.motions) {
    // The leader's position, which is the coordinate's number itself.
    const TestJoint& owner =
        joint.leader < 0 ? joint : robot_.joints[static_cast<std::size_t>(joint.leader)];
    const double q = motion.ratio * position[owner.position + motion.coordinate - owner.velocity] +
                     motion.offset;
    const Vector3d axis = body.pose.linear() * motion.axis;
    if (motion.turns) {
      body.pose.linear() = Eigen::AngleAxisd(q, axis) * body.pose.linear();
      body.jacobian.block<3, 1>(0, motion.coordinate) += motion.ratio * axis;
    } else {
      shift(q * axis);
      body.jacobian.block<3, 1>(3, motion.coordinate) += motion.ratio * axis;
    }
  }
}

std::vector<DenseReference::Body> DenseReference::bodies(const VectorXd& position) const {
  std::vector<Body> list(1);
  list[0].jacobian = MatrixXd::Zero(6, robot_.velocities);
  for (const TestJoint& joint : robot_.joints) {
    Body body = list[static_cast<std::size_t>(joint.parent)];
    move(joint, position, body);
    list.push_back(body);
  }
  return list;
}

Isometry3d DenseReference::pose(const VectorXd& position, int link) const {
  return bodies(position)[static_cast<std::size_t>(link)].pose;
}

MatrixXd DenseReference::jacobian(const VectorXd& position, int link) const {
  return bodies(position)[static_cast<std::size_t>(link)].jacobian;
}

MatrixXd DenseReference::mass_matrix(const VectorXd& position) const {
  MatrixXd M = MatrixXd::Zero(robot_.velocities, robot_.velocities);
  const auto list = bodies(position);
  for (std::size_t k = 1; k < list.size(); ++k) {
    const TestLink& link = robot_.links[k];
    const Matrix3d R = list[k].pose.linear();
    const MatrixXd w = list[k].jacobian.topRows(3);
    const MatrixXd v = list[k].jacobian.bottomRows(3) - cross(R * link.com) * w;
    M += link.mass * v.transpose() * v + w.transpose() * (R * link.inertia * R.transpose()) * w;
  }
  for (const TestJoint& joint : robot_.joints) {
    if (joint.rotor == 0) continue;
    const TestMotion& motion = joint.motions.front();
    const double turns = joint.gear * motion.ratio;
    M(motion.coordinate, motion.coordinate) += turns * turns * joint.rotor;
  }
  return M;
}

VectorXd DenseReference::moved(const VectorXd& position, const VectorXd& velocity,
                               double time) const {
  VectorXd result = position;
  for (const TestJoint& joint : robot_.joints) {
    if (!joint.motions.empty()) {
      if (joint.leader < 0)
        result.segment(joint.position, joint.positions) +=
            time * velocity.segment(joint.velocity, joint.velocities);
      continue;
    }
    const bool floats = joint.kind == "floating";
    const int at = joint.position + (floats ? 3 : 0);
    const Eigen::Quaterniond Q = quaternion(position, at);
    const Vector3d w = velocity.segment<3>(joint.velocity);
    const double angle = time * w.norm();
    const Vector3d axis = w.norm() > 0 ? Vector3d(w.normalized()) : Vector3d::UnitX();
    const Eigen::Quaterniond turned = Q * Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
    result.segment<4>(at) = turned.coeffs();
    if (!floats) continue;
    // p' = R(t) v with R(t) = Q exp(t [w]x): the integral of exp, in closed form.
    const Vector3d v = velocity.segment<3>(joint.velocity + 3);
    const Matrix3d W = cross(axis);
    const double n = w.norm();
    const Matrix3d V = n == 0
                           ? Matrix3d(time * Matrix3d::Identity())
                           : Matrix3d(time * Matrix3d::Identity() + (1 - std::cos(angle)) / n * W +
                                      (angle - std::sin(angle)) / n * W * W);
    result.segment<3>(joint.position) += Q * (V * v);
  }
  return result;
}

VectorXd DenseReference::jacobian_rate(const DenseState& state, int link) const {
  constexpr double h = 1e-3;
  const auto twist = [&](double time) -> VectorXd {
    return jacobian(moved(state.position, state.velocity, time), link) * state.velocity;
  };
  return (8 * (twist(h) - twist(-h)) - (twist(2 * h) - twist(-2 * h))) / (12 * h);
}

VectorXd DenseReference::inverse_dynamics(const DenseState& state) const {
  constexpr double h = 1e-3;
  const auto list = bodies(state.position);
  const auto twists = [&](double time) {
    std::vector<VectorXd> result;
    for (const Body& body : bodies(moved(state.position, state.velocity, time)))
      result.push_back(body.jacobian * state.velocity);
    return result;
  };
  const auto a = twists(-2 * h), b = twists(-h), c = twists(h), d = twists(2 * h);
  VectorXd force = VectorXd::Zero(robot_.velocities);
  for (std::size_t k = 1; k < list.size(); ++k) {
    const TestLink& link = robot_.links[k];
    const VectorXd twist = list[k].jacobian * state.velocity;
    const VectorXd rate = (8 * (c[k] - b[k]) - (d[k] - a[k])) / (12 * h);
    const VectorXd acceleration = list[k].jacobian * state.acceleration + rate;
    const Vector3d w = twist.head<3>(), al = acceleration.head<3>();
    const Vector3d com = list[k].pose.linear() * link.com;
    const Vector3d a_com =
        acceleration.tail<3>() + al.cross(com) + w.cross(w.cross(com)) - gravity_;
    const Matrix3d I = list[k].pose.linear() * link.inertia * list[k].pose.linear().transpose();
    const MatrixXd J_w = list[k].jacobian.topRows(3);
    const MatrixXd J_v = list[k].jacobian.bottomRows(3) - cross(com) * J_w;
    force += J_v.transpose() * (link.mass * a_com) + J_w.transpose() * (I * al + w.cross(I * w));
  }
  for (const TestJoint& joint : robot_.joints) {
    if (joint.rotor == 0) continue;
    const TestMotion& motion = joint.motions.front();
    const double turns = joint.gear * motion.ratio;
    force[motion.coordinate] += turns * turns * joint.rotor * state.acceleration[motion.coordinate];
  }
  return force;
}

DenseState random_state(const TestRobot& robot, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<> number(-1, 1);
  const auto vector = [&](int size) {
    VectorXd v(size);
    for (double& x : v) x = number(random);
    return v;
  };
  DenseState state{vector(robot.positions), vector(robot.velocities), vector(robot.velocities)};
  for (const TestJoint& joint : robot.joints) {
    if (joint.motions.empty())
      state.position.segment<4>(joint.position + joint.positions - 4).normalize();
  }
  return state;
}

}  // namespace sinew::test
