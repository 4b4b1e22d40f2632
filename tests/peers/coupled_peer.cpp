#include "coupled_peer.h"

#include <Eigen/Dense>
#include <algorithm>

#include "urdf_model.h"

namespace sinew::peers {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::Map<const Eigen::VectorXd> vector(const Vector& numbers) {
  return {numbers.data(), static_cast<Eigen::Index>(numbers.size())};
}
Vector numbers(const Eigen::MatrixXd& values) {
  const Matrix rows = values;
  return {rows.data(), rows.data() + rows.size()};
}

// A joint that follows the joint `leader` of the setup.
struct Follower {
  std::string name;
  std::size_t leader;
  double ratio, offset;
};

// Velocities of all joints are G times those of the setup's.
class CoupledPeer final : public Peer {
 public:
  CoupledPeer(std::unique_ptr<Peer> peer, std::size_t base, std::size_t joints,
              std::vector<Follower> followers)
      : peer_(std::move(peer)), base_(base), joints_(joints), followers_(std::move(followers)) {
    const auto m = static_cast<Eigen::Index>(base_ + joints_);
    G_ = Eigen::MatrixXd::Zero(m + static_cast<Eigen::Index>(followers_.size()), m);
    G_.topRows(m).setIdentity();
    for (std::size_t i = 0; i < followers_.size(); ++i)
      G_(m + static_cast<Eigen::Index>(i),
         static_cast<Eigen::Index>(base_ + followers_[i].leader)) = followers_[i].ratio;
  }

  std::string name() const override { return peer_->name(); }

  Vector inverse_dynamics(const State& state) override {
    return numbers(G_.transpose() * vector(peer_->inverse_dynamics(all(state))));
  }
  Vector inverse_dynamics_under(const State& state, const std::string& link,
                                const Vector& wrench) override {
    return numbers(G_.transpose() *
                   vector(peer_->inverse_dynamics_under(all(state), link, wrench)));
  }
  Vector mass_matrix(const State& state) override {
    const Vector full = peer_->mass_matrix(all(state));
    const Eigen::Map<const Matrix> M(full.data(), G_.rows(), G_.rows());
    return numbers(G_.transpose() * M * G_);
  }
  // G' (M G qdd + h) = tau
  Vector forward_dynamics(const State& state, const Vector& force) override {
    State still = state;
    std::fill(still.acceleration.begin(), still.acceleration.end(), 0.0);
    const Vector bias = inverse_dynamics(still), mass = mass_matrix(state);
    const Eigen::Map<const Matrix> M(mass.data(), G_.cols(), G_.cols());
    return numbers(M.ldlt().solve(vector(force) - vector(bias)));
  }
  Vector link_pose(const State& state, const std::string& link) override {
    return peer_->link_pose(all(state), link);
  }
  std::optional<Vector> quantity(const State& state, std::string_view name,
                                 const std::string& link) override {
    const auto full = peer_->quantity(all(state), name, link);
    const bool columns = name == "jacobian" || name == "center-of-mass-jacobian" ||
                         name == "centroidal-momentum-matrix";
    if (!full || !columns) return full;
    const Eigen::Map<const Matrix> J(
        full->data(), static_cast<Eigen::Index>(full->size()) / G_.rows(), G_.rows());
    return numbers(J * G_);
  }

  // The library moves every joint by itself: its own calls are for all of them, and none of them
  // accelerates what follows.
  void load(const std::vector<State>& states, const std::vector<Vector>& forces) override {
    std::vector<State> full;
    for (const State& state : states) full.push_back(all(state));
    std::vector<Vector> padded = forces;
    for (Vector& force : padded) force.resize(force.size() + followers_.size(), 0.0);
    peer_->load(full, padded);
  }
  bool call(std::string_view solver, std::size_t state) override {
    return solver != "aba" && peer_->call(solver, state);
  }

 private:
  State all(const State& state) const {
    State full = state;
    const std::size_t first = base_ == 0 ? 0 : base_ + 1;  // behind the base's position
    for (const Follower& follower : followers_)
      full.position.push_back(follower.ratio * state.position[first + follower.leader] +
                              follower.offset);
    full.velocity = numbers(G_ * vector(state.velocity));
    full.acceleration = numbers(G_ * vector(state.acceleration));
    return full;
  }

  std::unique_ptr<Peer> peer_;
  std::size_t base_, joints_;
  std::vector<Follower> followers_;
  Eigen::MatrixXd G_;
};

}  // namespace

std::unique_ptr<Peer> with_followers(
    const Setup& setup, const std::function<std::unique_ptr<Peer>(const Setup&)>& make) {
  const auto model = parse_urdf(setup.urdf);
  const auto place = [&](const std::string& joint) {
    return std::find(setup.joints.begin(), setup.joints.end(), joint);
  };
  std::vector<Follower> followers;
  Setup all = setup;
  for (const auto& [name, joint] : model->joints_) {
    if (!joint->mimic || !moves(*joint) || place(name) != setup.joints.end()) continue;
    const auto leader = place(joint->mimic->joint_name);
    if (leader == setup.joints.end())
      throw std::runtime_error(name + " mimics a joint that is not asked about");
    followers.push_back({name, static_cast<std::size_t>(leader - setup.joints.begin()),
                         joint->mimic->multiplier, joint->mimic->offset});
    all.joints.push_back(name);
  }
  if (followers.empty()) return make(setup);
  return std::make_unique<CoupledPeer>(make(all), setup.floating ? 6 : 0, setup.joints.size(),
                                       std::move(followers));
}

}  // namespace sinew::peers
