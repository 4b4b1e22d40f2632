#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/WeldJoint.hpp>

#include "coupled_peer.h"
#include "urdf_model.h"

namespace sinew::peers {
namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::SkeletonPtr;

Eigen::Isometry3d isometry(const urdf::Pose& pose) {
  const auto q = quaternion(pose.rotation);
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix();
  result.translation() << pose.position.x, pose.position.y, pose.position.z;
  return result;
}

BodyNode::Properties properties(const urdf::Link& link) {
  BodyNode::Properties result{BodyNode::AspectProperties(link.name)};
  dart::dynamics::Inertia inertia(kLeastMass, Eigen::Vector3d::Zero(),
                                  kLeastMass * Eigen::Matrix3d::Identity());
  if (link.inertial && link.inertial->mass > 0) {
    const urdf::Inertial& i = *link.inertial;
    Eigen::Matrix3d moment;
    moment << i.ixx, i.ixy, i.ixz, i.ixy, i.iyy, i.iyz, i.ixz, i.iyz, i.izz;
    const Eigen::Isometry3d origin = isometry(i.origin);
    inertia = dart::dynamics::Inertia(i.mass, origin.translation(),
                                      origin.linear() * moment * origin.linear().transpose());
  }
  result.mInertia = inertia;
  return result;
}

template <typename Joint, typename Properties>
BodyNode* attach(const SkeletonPtr& skeleton, BodyNode* parent, Properties joint,
                 const BodyNode::Properties& body, const std::string& name,
                 const Eigen::Isometry3d& origin) {
  joint.mName = name;
  joint.mT_ParentBodyToJoint = origin;
  return skeleton->createJointAndBodyNodePair<Joint>(parent, joint, body).second;
}

void add(const SkeletonPtr& skeleton, BodyNode* parent, const urdf::Link& link) {
  for (const auto& child : link.child_links) {
    const urdf::Joint& j = *child->parent_joint;
    const Eigen::Isometry3d origin = isometry(j.parent_to_joint_origin_transform);
    const Eigen::Vector3d axis = Eigen::Vector3d(j.axis.x, j.axis.y, j.axis.z).normalized();
    const auto body = properties(*child);
    BodyNode* node = nullptr;
    if (!moves(j)) {
      using Joint = dart::dynamics::WeldJoint;
      node = attach<Joint>(skeleton, parent, Joint::Properties(), body, j.name, origin);
    } else if (j.type == urdf::Joint::PRISMATIC) {
      using Joint = dart::dynamics::PrismaticJoint;
      Joint::Properties joint;
      joint.mAxis = axis;
      node = attach<Joint>(skeleton, parent, joint, body, j.name, origin);
    } else {
      using Joint = dart::dynamics::RevoluteJoint;
      Joint::Properties joint;
      joint.mAxis = axis;
      node = attach<Joint>(skeleton, parent, joint, body, j.name, origin);
    }
    add(skeleton, node, *child);
  }
}

class DartPeer final : public Peer {
 public:
  explicit DartPeer(const Setup& setup) : floating_(setup.floating) {
    const auto model = parse_urdf(setup.urdf);
    skeleton_ = dart::dynamics::Skeleton::create(model->getName());
    const auto body = properties(*model->getRoot());
    const Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();
    BodyNode* root = nullptr;
    if (floating_) {
      using Joint = dart::dynamics::FreeJoint;
      root = attach<Joint>(skeleton_, nullptr, Joint::Properties(), body, "floating base", origin);
    } else {
      using Joint = dart::dynamics::WeldJoint;
      root = attach<Joint>(skeleton_, nullptr, Joint::Properties(), body, "fixed base", origin);
    }
    add(skeleton_, root, *model->getRoot());
    skeleton_->setGravity({setup.gravity[0], setup.gravity[1], setup.gravity[2]});
    for (const std::string& joint : setup.joints) {
      auto* found = skeleton_->getJoint(joint);
      if (found == nullptr) throw std::runtime_error("DART has no joint " + joint);
      index_.push_back(found->getIndexInSkeleton(0));
    }
  }

  std::string name() const override { return "DART"; }

  Vector inverse_dynamics(const State& state) override {
    set(state);
    skeleton_->setAccelerations(own(state.acceleration));
    skeleton_->computeInverseDynamics();
    return ours(skeleton_->getForces());
  }

  Vector forward_dynamics(const State& state, const Vector& force) override {
    set(state);
    skeleton_->setForces(own(force));
    skeleton_->computeForwardDynamics();
    return ours(skeleton_->getAccelerations());
  }

  Vector mass_matrix(const State& state) override {
    set(state);
    const Eigen::MatrixXd& m = skeleton_->getMassMatrix();
    const auto all = order();
    Vector matrix;
    for (const auto row : all) {
      for (const auto column : all) {
        matrix.push_back(m(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)));
      }
    }
    return matrix;
  }

  Vector link_pose(const State& state, const std::string& link) override {
    set(state);
    const auto* body = skeleton_->getBodyNode(link);
    if (body == nullptr) throw std::runtime_error("DART has no link " + link);
    const Eigen::Isometry3d& pose = body->getWorldTransform();
    Vector numbers;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) numbers.push_back(pose(row, column));
    }
    return numbers;
  }

  Vector inverse_dynamics_under(const State& state, const std::string& link,
                                const Vector& wrench) override {
    set(state);
    skeleton_->setAccelerations(own(state.acceleration));
    BodyNode* body = body_of(link);
    body->setExtForce({wrench[3], wrench[4], wrench[5]}, Eigen::Vector3d::Zero(), true, true);
    body->addExtTorque({wrench[0], wrench[1], wrench[2]}, true);
    skeleton_->computeInverseDynamics(true);
    const Vector force = ours(skeleton_->getForces());
    skeleton_->clearExternalForces();
    return force;
  }

  void load(const std::vector<State>& states, const std::vector<Vector>& forces) override {
    loaded_.clear();
    for (std::size_t k = 0; k < states.size(); ++k) {
      set(states[k]);
      loaded_.push_back({skeleton_->getPositions(), skeleton_->getVelocities(),
                         own(states[k].acceleration), own(forces[k])});
    }
  }

  bool call(std::string_view solver, std::size_t state) override {
    const Loaded& loaded = loaded_[state];
    skeleton_->setPositions(loaded.position);
    BodyNode* last = skeleton_->getBodyNode(skeleton_->getNumBodyNodes() - 1);
    if (solver == "fpk") {
      last->getWorldTransform();
      for (BodyNode* body : skeleton_->getBodyNodes()) body->getWorldTransform();
      return true;
    }
    if (solver == "crba") {
      skeleton_->getMassMatrix();
      return true;
    }
    if (solver == "jacobian") {
      skeleton_->getWorldJacobian(last);
      return true;
    }
    skeleton_->setVelocities(loaded.velocity);
    if (solver == "rnea") {
      skeleton_->setAccelerations(loaded.acceleration);
      skeleton_->computeInverseDynamics();
    } else {
      skeleton_->setForces(loaded.force);
      skeleton_->computeForwardDynamics();
    }
    return true;
  }

  std::optional<Vector> quantity(const State& state, std::string_view name,
                                 const std::string& link) override {
    set(state);
    skeleton_->setAccelerations(own(state.acceleration));
    if (name == "joint-wrench") {
      skeleton_->computeInverseDynamics();
      auto* joint = skeleton_->getJoint(link);
      return numbers((joint ? joint->getChildBodyNode() : body_of(link))->getBodyForce());
    }
    if (!link.empty()) return of_link(name, *body_of(link));
    if (name == "center-of-mass") return numbers(skeleton_->getCOM());
    if (name == "center-of-mass-velocity") return numbers(skeleton_->getCOMLinearVelocity());
    if (name == "center-of-mass-jacobian") return columns(skeleton_->getCOMLinearJacobian());
    if (name == "momentum") return momentum(Eigen::Vector3d::Zero());
    if (name == "centroidal-momentum") return momentum(skeleton_->getCOM());
    if (name == "centroidal-momentum-matrix") return momentum_matrix(state);
    if (name == "kinetic-energy") return Vector{skeleton_->computeKineticEnergy()};
    // Skeleton::computePotentialEnergy takes centres of mass in their bodies' own coordinates.
    if (name == "potential-energy")
      return Vector{-skeleton_->getMass() * skeleton_->getGravity().dot(skeleton_->getCOM())};
    return std::nullopt;
  }

 private:
  BodyNode* body_of(const std::string& link) {
    BodyNode* body = skeleton_->getBodyNode(link);
    if (body == nullptr) throw std::runtime_error("DART has no link " + link);
    return body;
  }
  template <typename Column>
  static Vector numbers(const Column& column) {
    return Vector(column.data(), column.data() + column.size());
  }
  // Row by row, with the degrees of freedom in our order.
  Vector columns(const Eigen::MatrixXd& matrix) const {
    Vector result;
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
      for (const auto column : order()) {
        result.push_back(matrix(row, static_cast<Eigen::Index>(column)));
      }
    }
    return result;
  }
  Vector momentum(const Eigen::Vector3d& about) {
    Eigen::Vector3d angular = Eigen::Vector3d::Zero(), linear = Eigen::Vector3d::Zero();
    for (BodyNode* body : skeleton_->getBodyNodes()) {
      // DART takes the pivot, and gives the result, in the body's own coordinates.
      const Eigen::Isometry3d& pose = body->getWorldTransform();
      angular += pose.linear() * body->getAngularMomentum(pose.inverse() * about);
      linear += pose.linear() * body->getLinearMomentum();
    }
    Vector result = numbers(angular);
    for (int i = 0; i < 3; ++i) result.push_back(linear[i]);
    return result;
  }
  Vector momentum_matrix(const State& state) {
    State unit = state;
    const std::size_t n = state.velocity.size();
    Vector matrix(6 * n);
    for (std::size_t column = 0; column < n; ++column) {
      unit.velocity.assign(n, 0);
      unit.velocity[column] = 1;
      set(unit);
      const Vector one = momentum(skeleton_->getCOM());
      for (std::size_t row = 0; row < 6; ++row) matrix[row * n + column] = one[row];
    }
    return matrix;
  }
  std::optional<Vector> of_link(std::string_view name, BodyNode& body) {
    Eigen::Matrix<double, 6, 1> both;
    if (name == "twist") {
      both << body.getAngularVelocity(), body.getLinearVelocity();
    } else if (name == "acceleration-twist") {
      both << body.getAngularAcceleration(), body.getLinearAcceleration();
    } else if (name == "jacobian-rate-times-velocity") {
      both = skeleton_->getJacobianClassicDeriv(&body) * skeleton_->getVelocities();
    } else if (name == "jacobian") {
      return columns(skeleton_->getWorldJacobian(&body));
    } else {
      return std::nullopt;
    }
    return numbers(both);
  }

  // Degrees of freedom in our order. DART's free joint moves as ours does: angular then linear, in
  // the body.
  std::vector<std::size_t> order() const {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < (floating_ ? 6U : 0U); ++i) all.push_back(i);
    all.insert(all.end(), index_.begin(), index_.end());
    return all;
  }
  Eigen::VectorXd own(const Vector& numbers) const {
    Eigen::VectorXd result =
        Eigen::VectorXd::Zero(static_cast<Eigen::Index>(skeleton_->getNumDofs()));
    if (numbers.empty()) return result;
    const auto all = order();
    for (std::size_t i = 0; i < all.size(); ++i) {
      result(static_cast<Eigen::Index>(all[i])) = numbers[i];
    }
    return result;
  }
  Vector ours(const Eigen::VectorXd& numbers) const {
    Vector result;
    for (const auto i : order()) result.push_back(numbers(static_cast<Eigen::Index>(i)));
    return result;
  }
  void set(const State& state) {
    Eigen::VectorXd position =
        Eigen::VectorXd::Zero(static_cast<Eigen::Index>(skeleton_->getNumDofs()));
    std::size_t at = 0;
    if (floating_) {
      const double* p = state.position.data();
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.linear() = Eigen::Quaterniond(p[6], p[3], p[4], p[5]).toRotationMatrix();
      pose.translation() << p[0], p[1], p[2];
      position.head<6>() = dart::dynamics::FreeJoint::convertToPositions(pose);
      at = 7;
    }
    for (std::size_t i = 0; i < index_.size(); ++i) {
      position(static_cast<Eigen::Index>(index_[i])) = state.position[at + i];
    }
    skeleton_->setPositions(position);
    skeleton_->setVelocities(own(state.velocity));
  }

  struct Loaded {
    Eigen::VectorXd position, velocity, acceleration, force;
  };

  std::vector<Loaded> loaded_;
  bool floating_;
  SkeletonPtr skeleton_;
  std::vector<std::size_t> index_;
};

}  // namespace

std::unique_ptr<Peer> make_dart(const Setup& setup) {
  return with_followers(setup, [](const Setup& all) { return std::make_unique<DartPeer>(all); });
}

}  // namespace sinew::peers
