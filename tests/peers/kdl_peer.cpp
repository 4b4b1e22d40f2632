#include <kdl/chainjnttojacdotsolver.hpp>
#include <kdl/tree.hpp>
#include <kdl/treefksolverpos_recursive.hpp>
#include <kdl/treeidsolver_recursive_newton_euler.hpp>
#include <kdl/treejnttojacsolver.hpp>

#include "coupled_peer.h"
#include "kdl_model.h"

namespace sinew::peers {
namespace {

KDL::Joint joint(const urdf::Joint& j) {
  const KDL::Frame origin = kdl_frame(j.parent_to_joint_origin_transform);
  const KDL::Vector axis = origin.M * KDL::Vector(j.axis.x, j.axis.y, j.axis.z);
  if (!moves(j)) return KDL::Joint(j.name, KDL::Joint::None);
  return KDL::Joint(j.name, origin.p, axis,
                    j.type == urdf::Joint::PRISMATIC ? KDL::Joint::TransAxis : KDL::Joint::RotAxis);
}

void add_children(KDL::Tree& tree, const urdf::Link& link) {
  for (const auto& j : link.child_joints) {
    for (const auto& child : link.child_links) {
      if (child->parent_joint != j) continue;
      tree.addSegment(
          KDL::Segment(child->name, joint(*j), kdl_frame(j->parent_to_joint_origin_transform),
                       kdl_inertia(*child)),
          link.name);
      add_children(tree, *child);
    }
  }
}

class KdlPeer final : public Peer {
 public:
  explicit KdlPeer(const Setup& setup) {
    if (setup.floating) throw std::runtime_error("KDL has no floating base");
    const auto model = parse_urdf(setup.urdf);
    tree_ = KDL::Tree(model->getRoot()->name);
    add_children(tree_, *model->getRoot());
    const auto count = static_cast<unsigned>(setup.joints.size());
    if (tree_.getNrOfJoints() != count) throw std::runtime_error("KDL counts other joints");
    index_.resize(count);
    for (const auto& [name, element] : tree_.getSegments()) {
      const auto& segment_joint = element.segment.getJoint();
      if (segment_joint.getType() == KDL::Joint::None) continue;
      for (unsigned i = 0; i < count; ++i) {
        if (setup.joints[i] == segment_joint.getName()) index_[i] = element.q_nr;
      }
    }
    const KDL::Vector gravity(setup.gravity[0], setup.gravity[1], setup.gravity[2]);
    inverse_ = std::make_unique<KDL::TreeIdSolver_RNE>(tree_, gravity);
    without_gravity_ = std::make_unique<KDL::TreeIdSolver_RNE>(tree_, KDL::Vector::Zero());
    q_.resize(count);
    qd_.resize(count);
    qdd_.resize(count);
    tau_.resize(count);
  }

  std::string name() const override { return "KDL"; }

  Vector inverse_dynamics(const State& state) override {
    set(state);
    return solve(*inverse_);
  }

  Vector mass_matrix(const State& state) override {
    const std::size_t n = index_.size();
    Vector matrix(n * n);
    State unit{state.position, Vector(n, 0), Vector(n, 0)};
    for (std::size_t column = 0; column < n; ++column) {
      unit.acceleration.assign(n, 0);
      unit.acceleration[column] = 1;
      set(unit);
      const Vector force = solve(*without_gravity_);
      for (std::size_t row = 0; row < n; ++row) matrix[row * n + column] = force[row];
    }
    return matrix;
  }

  Vector forward_dynamics(const State&, const Vector&) override {
    throw std::runtime_error("KDL has no forward dynamics of trees");
  }

  Vector link_pose(const State& state, const std::string& link) override {
    set(state);
    KDL::TreeFkSolverPos_recursive solver(tree_);
    KDL::Frame pose;
    if (solver.JntToCart(q_, pose, link) < 0) throw std::runtime_error("KDL has no link " + link);
    Vector numbers;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) numbers.push_back(pose.M(row, column));
      numbers.push_back(pose.p(row));
    }
    return numbers;
  }

  Vector inverse_dynamics_under(const State& state, const std::string& link,
                                const Vector& wrench) override {
    set(state);
    KDL::WrenchMap external;
    external[link] = {KDL::Vector(wrench[3], wrench[4], wrench[5]),
                      KDL::Vector(wrench[0], wrench[1], wrench[2])};
    return solve(*inverse_, external);
  }

  void load(const std::vector<State>& states, const std::vector<Vector>&) override {
    loaded_.clear();
    for (const State& state : states) {
      set(state);
      loaded_.push_back({q_, qd_, qdd_});
    }
    jacobian_.resize(tree_.getNrOfJoints());
    for (const auto& [name, element] : tree_.getSegments()) {
      if (element.children.empty()) last_ = name;
    }
  }

  bool call(std::string_view solver, std::size_t state) override {
    const Loaded& own = loaded_[state];
    if (solver == "rnea") {
      return inverse_->CartToJnt(own.q, own.qd, own.qdd, none_, tau_) == 0;
    }
    if (solver == "jacobian") {
      if (!jacobian_solver_) jacobian_solver_.emplace(tree_);
      return jacobian_solver_->JntToJac(own.q, jacobian_, last_) >= 0;
    }
    return false;  // KDL has no mass matrix and no forward dynamics of trees
  }

  std::optional<Vector> quantity(const State& state, std::string_view name,
                                 const std::string& link) override {
    if (link.empty() || link == tree_.getRootSegment()->first) return std::nullopt;
    set(state);
    if (name == "jacobian") return jacobian(link);
    if (name == "twist") return times(jacobian(link), state.velocity);
    if (name == "jacobian-rate-times-velocity") return jacobian_rate(link);
    if (name == "acceleration-twist") {
      Vector sum = times(jacobian(link), state.acceleration);
      const Vector rate = jacobian_rate(link);
      for (std::size_t i = 0; i < 6; ++i) sum[i] += rate[i];
      return sum;
    }
    return std::nullopt;
  }

 private:
  // KDL has linear rows first.
  static std::size_t our_row(std::size_t row) { return row < 3 ? row + 3 : row - 3; }

  Vector jacobian(const std::string& link) {
    const std::size_t n = index_.size();
    KDL::Jacobian own(static_cast<unsigned>(n));
    KDL::TreeJntToJacSolver solver(tree_);
    if (solver.JntToJac(q_, own, link) < 0) throw std::runtime_error("KDL has no link " + link);
    Vector matrix(6 * n);
    for (std::size_t row = 0; row < 6; ++row) {
      for (std::size_t column = 0; column < n; ++column) {
        matrix[our_row(row) * n + column] = own(static_cast<unsigned>(row), index_[column]);
      }
    }
    return matrix;
  }

  static Vector times(const Vector& matrix, const Vector& vector) {
    const std::size_t n = vector.size();
    Vector result(matrix.size() / n, 0.0);
    for (std::size_t i = 0; i < matrix.size(); ++i) result[i / n] += matrix[i] * vector[i % n];
    return result;
  }

  Vector jacobian_rate(const std::string& link) {
    KDL::Chain chain;
    if (!tree_.getChain(tree_.getRootSegment()->first, link, chain))
      throw std::runtime_error("KDL has no chain to " + link);
    KDL::JntArrayVel motion(chain.getNrOfJoints());
    unsigned at = 0;
    for (const KDL::Segment& segment : chain.segments) {
      if (segment.getJoint().getType() == KDL::Joint::None) continue;
      const unsigned own = GetTreeElementQNr(tree_.getSegment(segment.getName())->second);
      motion.q(at) = q_(own);
      motion.qdot(at++) = qd_(own);
    }
    if (at == 0) return Vector(6, 0.0);
    KDL::ChainJntToJacDotSolver solver(chain);
    KDL::Twist rate;
    if (solver.JntToJacDot(motion, rate) < 0) throw std::runtime_error("KDL fails");
    Vector result(6);
    for (int row = 0; row < 6; ++row) result[our_row(static_cast<std::size_t>(row))] = rate(row);
    return result;
  }

  void set(const State& state) {
    for (std::size_t i = 0; i < index_.size(); ++i) {
      q_(index_[i]) = state.position[i];
      qd_(index_[i]) = state.velocity.empty() ? 0 : state.velocity[i];
      qdd_(index_[i]) = state.acceleration.empty() ? 0 : state.acceleration[i];
    }
  }
  Vector solve(KDL::TreeIdSolver_RNE& solver, const KDL::WrenchMap& external = {}) {
    if (solver.CartToJnt(q_, qd_, qdd_, external, tau_) != 0) throw std::runtime_error("KDL fails");
    Vector force;
    for (const unsigned i : index_) force.push_back(tau_(i));
    return force;
  }

  struct Loaded {
    KDL::JntArray q, qd, qdd;
  };

  std::vector<Loaded> loaded_;
  KDL::WrenchMap none_;
  KDL::Jacobian jacobian_;
  std::optional<KDL::TreeJntToJacSolver> jacobian_solver_;
  std::string last_;
  KDL::Tree tree_;
  std::vector<unsigned> index_;  // of the caller's joints in KDL's arrays
  std::unique_ptr<KDL::TreeIdSolver_RNE> inverse_, without_gravity_;
  KDL::JntArray q_, qd_, qdd_, tau_;
};

}  // namespace

std::unique_ptr<Peer> make_kdl(const Setup& setup) {
  return with_followers(setup, [](const Setup& all) { return std::make_unique<KdlPeer>(all); });
}

}  // namespace sinew::peers
