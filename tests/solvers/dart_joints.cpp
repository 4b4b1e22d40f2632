#include "dart_joints.h"

#include <cmath>
#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PlanarJoint.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/ScrewJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/UniversalJoint.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <stdexcept>

namespace sinew::test {
namespace {

using namespace dart::dynamics;
using Eigen::VectorXd;

struct Model {
  SkeletonPtr skeleton = Skeleton::create("robot");
  std::vector<Joint*> joints;
  std::vector<BodyNode*> bodies;
};

template <typename Type>
void attach(Model& model, BodyNode* parent, typename Type::Properties joint,
            const Eigen::Isometry3d& placement, const TestLink& link) {
  joint.mT_ParentBodyToJoint = placement;
  BodyNode::Properties body{
      BodyNode::AspectProperties("body" + std::to_string(model.bodies.size()))};
  body.mInertia = Inertia(link.mass, link.com, link.inertia);
  const auto made = model.skeleton->createJointAndBodyNodePair<Type>(parent, joint, body);
  model.joints.push_back(made.first);
  model.bodies.push_back(made.second);
}

Model build(const TestRobot& robot, const Eigen::Vector3d& gravity) {
  Model model;
  attach<WeldJoint>(model, nullptr, {}, Eigen::Isometry3d::Identity(), robot.links[0]);
  model.joints.clear();
  for (std::size_t k = 0; k < robot.joints.size(); ++k) {
    const TestJoint& j = robot.joints[k];
    BodyNode* parent = model.bodies[static_cast<std::size_t>(j.parent)];
    const TestLink& link = robot.links[k + 1];
    if (j.kind == "revolute") {
      RevoluteJoint::Properties p;
      p.mAxis = j.motions[0].axis;
      attach<RevoluteJoint>(model, parent, p, j.placement, link);
    } else if (j.kind == "prismatic") {
      PrismaticJoint::Properties p;
      p.mAxis = j.motions[0].axis;
      attach<PrismaticJoint>(model, parent, p, j.placement, link);
    } else if (j.kind == "helical") {
      ScrewJoint::Properties p;
      p.mAxis = j.motions[0].axis;
      p.mPitch = 2 * M_PI * j.pitch;  // DART's is for a whole turn
      attach<ScrewJoint>(model, parent, p, j.placement, link);
    } else if (j.kind == "universal") {
      UniversalJoint::Properties p;
      p.mAxis = {j.motions[0].axis, j.motions[1].axis};
      attach<UniversalJoint>(model, parent, p, j.placement, link);
    } else if (j.kind == "planar") {
      attach<PlanarJoint>(model, parent, {}, j.placement, link);
    } else if (j.kind == "spherical") {
      attach<BallJoint>(model, parent, {}, j.placement, link);
    } else if (j.kind == "floating") {
      attach<FreeJoint>(model, parent, {}, j.placement, link);
    } else {
      throw std::runtime_error("DART has no joint like a " + j.kind + " one");
    }
  }
  model.skeleton->setGravity(gravity);
  return model;
}

VectorXd positions(const TestJoint& j, const VectorXd& all) {
  if (j.kind != "spherical" && j.kind != "floating") return all.segment(j.position, j.positions);
  const int at = j.position + j.positions - 4;
  const Eigen::Matrix3d R =
      Eigen::Quaterniond(all[at + 3], all[at], all[at + 1], all[at + 2]).toRotationMatrix();
  if (j.kind == "spherical") return BallJoint::convertToPositions(R);
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = R;
  X.translation() = all.segment<3>(j.position);
  return FreeJoint::convertToPositions(X);
}

}  // namespace

PeerAnswer ask_dart(const TestRobot& robot, const Eigen::Vector3d& gravity, const DenseState& state,
                    const VectorXd& given_force) {
  Model model = build(robot, gravity);
  const auto n = static_cast<Eigen::Index>(robot.velocities);
  std::vector<Eigen::Index> place(static_cast<std::size_t>(n));  // of our coordinates in DART
  for (std::size_t k = 0; k < robot.joints.size(); ++k) {
    const TestJoint& j = robot.joints[k];
    model.joints[k]->setPositions(positions(j, state.position));
    for (int d = 0; d < j.velocities; ++d)
      place[static_cast<std::size_t>(j.velocity + d)] = static_cast<Eigen::Index>(
          model.joints[k]->getIndexInSkeleton(static_cast<std::size_t>(d)));
  }
  const auto theirs = [&](const VectorXd& ours) {
    VectorXd result(n);
    for (Eigen::Index i = 0; i < n; ++i) result[place[static_cast<std::size_t>(i)]] = ours[i];
    return result;
  };
  const auto ours = [&](const VectorXd& dart) {
    VectorXd result(n);
    for (Eigen::Index i = 0; i < n; ++i) result[i] = dart[place[static_cast<std::size_t>(i)]];
    return result;
  };
  PeerAnswer answer;
  Skeleton& skeleton = *model.skeleton;
  skeleton.setVelocities(theirs(state.velocity));
  skeleton.setAccelerations(theirs(state.acceleration));
  skeleton.computeInverseDynamics();
  answer.force = ours(skeleton.getForces());
  const Eigen::MatrixXd M = skeleton.getMassMatrix();
  answer.mass_matrix.resize(n, n);
  for (Eigen::Index r = 0; r < n; ++r)
    for (Eigen::Index c = 0; c < n; ++c)
      answer.mass_matrix(r, c) =
          M(place[static_cast<std::size_t>(r)], place[static_cast<std::size_t>(c)]);
  for (BodyNode* body : model.bodies) {
    answer.poses.push_back(body->getWorldTransform());
    const Eigen::MatrixXd J = skeleton.getWorldJacobian(body);
    answer.jacobians.emplace_back(6, n);
    for (Eigen::Index c = 0; c < n; ++c)
      answer.jacobians.back().col(c) = J.col(place[static_cast<std::size_t>(c)]);
  }
  skeleton.setForces(theirs(given_force));
  skeleton.computeForwardDynamics();
  answer.acceleration = ours(skeleton.getAccelerations());
  return answer;
}

}  // namespace sinew::test
