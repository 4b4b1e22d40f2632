#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "coupled_peer.h"
#include "urdf_model.h"

namespace sinew::peers {
namespace {

using Vector3 = std::array<double, 3>;
using Quaternion = std::array<double, 4>;  // w x y z, as MuJoCo has it

std::string text(const urdf::Pose& pose) {
  const auto q = quaternion(pose.rotation);
  return fmt::format("pos='{:.17g} {:.17g} {:.17g}' quat='{:.17g} {:.17g} {:.17g} {:.17g}'",
                     pose.position.x, pose.position.y, pose.position.z, q[3], q[0], q[1], q[2]);
}

// The link's inertia about its centre of mass, in its principal axes. MuJoCo would find them
// itself, to eight digits.
std::string inertial(const urdf::Link& link) {
  urdf::Inertial inertial;
  inertial.clear();
  if (link.inertial) inertial = *link.inertial;
  const auto q = quaternion(inertial.origin.rotation);
  Eigen::Matrix3d moment;
  moment << inertial.ixx, inertial.ixy, inertial.ixz, inertial.ixy, inertial.iyy, inertial.iyz,
      inertial.ixz, inertial.iyz, inertial.izz;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(moment);
  Eigen::Matrix3d axes = principal.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond(q[3], q[0], q[1], q[2]) * Eigen::Quaterniond(axes);
  const Eigen::Vector3d moments = principal.eigenvalues().cwiseMax(kLeastMass);
  const urdf::Vector3& p = inertial.origin.position;
  return fmt::format(
      "<inertial pos='{:.17g} {:.17g} {:.17g}' quat='{:.17g} {:.17g} {:.17g} {:.17g}' "
      "mass='{:.17g}' "
      "diaginertia='{:.17g} {:.17g} {:.17g}'/>",
      p.x, p.y, p.z, turn.w(), turn.x(), turn.y(), turn.z(), std::max(inertial.mass, kLeastMass),
      moments[0], moments[1], moments[2]);
}

std::string body(const urdf::Link& link, const std::string& placement, const std::string& joint) {
  std::string xml =
      fmt::format("<body name='link {}' {}>{}{}\n", link.name, placement, joint, inertial(link));
  for (const auto& child : link.child_links) {
    const urdf::Joint& j = *child->parent_joint;
    std::string moving;
    if (moves(j)) {
      moving = fmt::format("<joint name='{}' type='{}' axis='{:.17g} {:.17g} {:.17g}'/>", j.name,
                           j.type == urdf::Joint::PRISMATIC ? "slide" : "hinge", j.axis.x, j.axis.y,
                           j.axis.z);
    }
    xml += body(*child, text(j.parent_to_joint_origin_transform), moving);
  }
  return xml + "</body>\n";
}

std::string mjcf(const Setup& setup) {
  const auto model = parse_urdf(setup.urdf);
  return fmt::format(
      "<mujoco><compiler angle='radian' fusestatic='false' balanceinertia='false' "
      "inertiafromgeom='false'/><option gravity='{:.17g} {:.17g} "
      "{:.17g}'/><worldbody>{}</worldbody></mujoco>",
      setup.gravity[0], setup.gravity[1], setup.gravity[2],
      body(*model->getRoot(), "", setup.floating ? "<freejoint name='floating base'/>" : ""));
}

class MujocoPeer final : public Peer {
 public:
  explicit MujocoPeer(const Setup& setup) : floating_(setup.floating) {
    const std::string xml = mjcf(setup);
    mjVFS files;
    mj_defaultVFS(&files);
    mj_makeEmptyFileVFS(&files, "robot.xml", static_cast<int>(xml.size()));
    std::memcpy(files.filedata[0], xml.data(), xml.size());
    char fault[1000] = "";
    model_ = mj_loadXML("robot.xml", &files, fault, sizeof fault);
    mj_deleteVFS(&files);
    if (model_ == nullptr) throw std::runtime_error(std::string("MuJoCo: ") + fault);
    model_->opt.enableflags |= mjENBL_ENERGY;
    data_ = mj_makeData(model_);
    for (const std::string& joint : setup.joints) {
      const int id = mj_name2id(model_, mjOBJ_JOINT, joint.c_str());
      if (id < 0) throw std::runtime_error("MuJoCo has no joint " + joint);
      position_.push_back(model_->jnt_qposadr[id]);
      velocity_.push_back(model_->jnt_dofadr[id]);
    }
  }
  ~MujocoPeer() override {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }

  std::string name() const override { return "MuJoCo"; }

  Vector inverse_dynamics(const State& state) override {
    set(state);
    write_acceleration(state, state.acceleration);
    mj_inverse(model_, data_);
    return read_force(data_->qfrc_inverse);
  }

  Vector forward_dynamics(const State& state, const Vector& force) override {
    set(state);
    mju_zero(data_->qfrc_applied, model_->nv);
    std::size_t at = 0;
    if (floating_) {
      // Torque in body axes, force in world axes.
      for (int i = 0; i < 3; ++i) data_->qfrc_applied[3 + i] = force[static_cast<std::size_t>(i)];
      mju_rotVecQuat(data_->qfrc_applied, force.data() + 3, data_->qpos + 3);
      at = 6;
    }
    for (std::size_t i = 0; i < velocity_.size(); ++i) {
      data_->qfrc_applied[velocity_[i]] = force[at + i];
    }
    mj_forward(model_, data_);
    Vector acceleration;
    if (floating_) {
      const Vector3 linear = to_body(data_->qacc),
                    turning{data_->qvel[3], data_->qvel[4], data_->qvel[5]};
      const Vector3 speed = to_body(data_->qvel);
      Vector3 carried;
      mju_cross(carried.data(), turning.data(), speed.data());
      for (int i = 0; i < 3; ++i) acceleration.push_back(data_->qacc[3 + i]);
      for (std::size_t i = 0; i < 3; ++i) acceleration.push_back(linear[i] - carried[i]);
    }
    for (const int i : velocity_) acceleration.push_back(data_->qacc[i]);
    return acceleration;
  }

  Vector mass_matrix(const State& state) override {
    set(state);
    mj_fwdPosition(model_, data_);
    const auto nv = static_cast<std::size_t>(model_->nv);
    Vector own(nv * nv);
    mj_fullM(model_, own.data(), data_->qM);
    const std::vector<Vector> to_own = own_velocities();
    const std::size_t n = to_own.size();
    Vector matrix(n * n, 0.0);
    for (std::size_t row = 0; row < n; ++row) {
      for (std::size_t column = 0; column < n; ++column) {
        double sum = 0;
        for (std::size_t a = 0; a < nv; ++a) {
          for (std::size_t b = 0; b < nv; ++b)
            sum += to_own[row][a] * own[a * nv + b] * to_own[column][b];
        }
        matrix[row * n + column] = sum;
      }
    }
    return matrix;
  }

  Vector link_pose(const State& state, const std::string& link) override {
    set(state);
    mj_kinematics(model_, data_);
    const int id = mj_name2id(model_, mjOBJ_BODY, ("link " + link).c_str());
    if (id < 0) throw std::runtime_error("MuJoCo has no link " + link);
    Vector pose;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column)
        pose.push_back(data_->xmat[9 * id + 3 * row + column]);
      pose.push_back(data_->xpos[3 * id + row]);
    }
    return pose;
  }

  Vector inverse_dynamics_under(const State& state, const std::string& link,
                                const Vector& wrench) override {
    // What MuJoCo calls inverse dynamics is all forces together; a wrench's share is J^T W.
    Vector force = inverse_dynamics(state);
    const int body = body_of(link);
    Vector in_world(6);
    mju_rotVecMat(in_world.data(), wrench.data(), data_->xmat + 9 * body);
    mju_rotVecMat(in_world.data() + 3, wrench.data() + 3, data_->xmat + 9 * body);
    const Vector J = jacobian(body);
    for (std::size_t i = 0; i < J.size(); ++i)
      force[i % force.size()] -= J[i] * in_world[i / force.size()];
    return force;
  }

  void load(const std::vector<State>& states, const std::vector<Vector>& forces) override {
    loaded_.clear();
    for (std::size_t k = 0; k < states.size(); ++k) {
      Loaded own;
      forward_dynamics(states[k], forces[k]);
      own.force.assign(data_->qfrc_applied, data_->qfrc_applied + model_->nv);
      set(states[k]);
      write_acceleration(states[k], states[k].acceleration);
      own.position.assign(data_->qpos, data_->qpos + model_->nq);
      own.velocity.assign(data_->qvel, data_->qvel + model_->nv);
      own.acceleration.assign(data_->qacc, data_->qacc + model_->nv);
      loaded_.push_back(std::move(own));
    }
    result_.resize(6 * static_cast<std::size_t>(model_->nv));
  }

  // The engine's own stages, without contacts, sensors and actuators.
  bool call(std::string_view solver, std::size_t state) override {
    const Loaded& own = loaded_[state];
    mju_copy(data_->qpos, own.position.data(), model_->nq);
    mju_copy(data_->qvel, own.velocity.data(), model_->nv);
    mj_kinematics(model_, data_);
    if (solver == "fpk") return true;
    mj_comPos(model_, data_);
    if (solver == "jacobian") {
      const int body = model_->nbody - 1;
      mj_jac(model_, data_, result_.data() + 3 * model_->nv, result_.data(), data_->xpos + 3 * body,
             body);
      return true;
    }
    if (solver == "rnea") {
      mju_copy(data_->qacc, own.acceleration.data(), model_->nv);
      mj_comVel(model_, data_);
      mj_rne(model_, data_, 1, result_.data());
      return true;
    }
    mj_crb(model_, data_);
    if (solver == "crba") return true;
    mj_factorM(model_, data_);
    mj_comVel(model_, data_);
    mj_rne(model_, data_, 0, data_->qfrc_bias);
    mju_sub(result_.data(), own.force.data(), data_->qfrc_bias, model_->nv);
    mj_solveM(model_, data_, data_->qacc, result_.data(), 1);
    return true;
  }

  std::optional<Vector> quantity(const State& state, std::string_view name,
                                 const std::string& link) override {
    set(state);
    mju_zero(data_->xfrc_applied, 6 * model_->nbody);
    write_acceleration(state, state.acceleration);
    mj_inverse(model_, data_);
    if (name == "joint-wrench") {
      const int joint = mj_name2id(model_, mjOBJ_JOINT, link.c_str());
      return joint_wrench(joint < 0 ? body_of(link) : model_->jnt_bodyid[joint]);
    }
    if (!link.empty()) return of_link(name, body_of(link));
    mj_subtreeVel(model_, data_);
    if (name == "center-of-mass") return Vector(data_->subtree_com, data_->subtree_com + 3);
    if (name == "center-of-mass-velocity")
      return Vector(data_->subtree_linvel, data_->subtree_linvel + 3);
    if (name == "center-of-mass-jacobian") {
      Vector own(3 * static_cast<std::size_t>(model_->nv));
      mj_jacSubtreeCom(model_, data_, own.data(), 0);
      return our_columns(own);
    }
    if (name == "momentum") return momentum(true);
    if (name == "centroidal-momentum") return momentum(false);
    if (name == "centroidal-momentum-matrix") return momentum_matrix(state);
    mj_energyPos(model_, data_);
    mj_energyVel(model_, data_);
    if (name == "potential-energy") return Vector{data_->energy[0]};
    if (name == "kinetic-energy") return Vector{data_->energy[1]};
    return std::nullopt;
  }

 private:
  struct Loaded {
    Vector position, velocity, acceleration, force;
  };

  int body_of(const std::string& link) const {
    const int id = mj_name2id(model_, mjOBJ_BODY, ("link " + link).c_str());
    if (id < 0) throw std::runtime_error("MuJoCo has no link " + link);
    return id;
  }

  // Column k: MuJoCo's velocities for one unit of our velocity k. It sees the linear velocity of a
  // floating base from the world, we from the base: v_world = R v_body.
  std::vector<Vector> own_velocities() const {
    const auto nv = static_cast<std::size_t>(model_->nv);
    std::vector<Vector> to_own;
    const std::size_t base = floating_ ? 6 : 0, n = base + velocity_.size();
    for (std::size_t k = 0; k < n; ++k) {
      Vector column(nv, 0.0);
      if (floating_ && k < 3) column[3 + k] = 1;
      if (floating_ && k >= 3 && k < 6) {
        Vector3 unit{0, 0, 0};
        unit[k - 3] = 1;
        mju_rotVecQuat(column.data(), unit.data(), data_->qpos + 3);
      }
      if (k >= base) column[static_cast<std::size_t>(velocity_[k - base])] = 1;
      to_own.push_back(std::move(column));
    }
    return to_own;
  }

  // A matrix with a column for each of MuJoCo's velocities, with one for each of ours.
  Vector our_columns(const Vector& own) const {
    const auto nv = static_cast<std::size_t>(model_->nv);
    const std::vector<Vector> to_own = own_velocities();
    const std::size_t rows = own.size() / nv, n = to_own.size();
    Vector result(rows * n, 0.0);
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t column = 0; column < n; ++column) {
        for (std::size_t k = 0; k < nv; ++k)
          result[row * n + column] += own[row * nv + k] * to_own[column][k];
      }
    }
    return result;
  }

  Vector jacobian(int body) {
    const auto nv = static_cast<std::size_t>(model_->nv);
    Vector own(6 * nv);
    mj_jac(model_, data_, own.data() + 3 * nv, own.data(), data_->xpos + 3 * body, body);
    return our_columns(own);
  }

  Vector momentum(bool about_origin) const {
    const double* c = data_->subtree_com;
    Vector result(data_->subtree_angmom, data_->subtree_angmom + 3);
    for (int i = 0; i < 3; ++i)
      result.push_back(model_->body_subtreemass[0] * data_->subtree_linvel[i]);
    if (about_origin) {
      Vector3 moment;
      mju_cross(moment.data(), c, result.data() + 3);
      for (std::size_t i = 0; i < 3; ++i) result[i] += moment[i];
    }
    return result;
  }

  Vector momentum_matrix(const State& state) {
    const std::size_t n = state.velocity.size();
    State unit = state;
    Vector matrix(6 * n);
    for (std::size_t column = 0; column < n; ++column) {
      unit.velocity.assign(n, 0);
      unit.velocity[column] = 1;
      set(unit);
      mj_fwdPosition(model_, data_);
      mj_fwdVelocity(model_, data_);
      mj_subtreeVel(model_, data_);
      const Vector one = momentum(false);
      for (std::size_t row = 0; row < 6; ++row) matrix[row * n + column] = one[row];
    }
    return matrix;
  }

  std::optional<Vector> of_link(std::string_view name, int body) {
    Vector both(6);
    if (name == "jacobian") return jacobian(body);
    if (name == "twist") {
      mj_objectVelocity(model_, data_, mjOBJ_XBODY, body, both.data(), 0);
      return both;
    }
    mj_rnePostConstraint(model_, data_);
    if (name == "acceleration-twist") {
      // What an accelerometer there would read: gravity is to be added.
      mj_objectAcceleration(model_, data_, mjOBJ_XBODY, body, both.data(), 0);
      for (int i = 0; i < 3; ++i) both[static_cast<std::size_t>(3 + i)] += model_->opt.gravity[i];
      return both;
    }
    return std::nullopt;
  }

  // MuJoCo's is about the centre of mass of the whole tree, with the world's directions.
  Vector joint_wrench(int body) {
    mj_rnePostConstraint(model_, data_);
    const double* wrench = data_->cfrc_int + 6 * body;
    const double* center = data_->subtree_com + 3 * model_->body_rootid[body];
    Vector3 lever, moment;
    mju_sub3(lever.data(), center, data_->xpos + 3 * body);
    mju_cross(moment.data(), lever.data(), wrench + 3);
    mju_addTo3(moment.data(), wrench);
    Vector both(6);
    mju_rotVecMatT(both.data(), moment.data(), data_->xmat + 9 * body);
    mju_rotVecMatT(both.data() + 3, wrench + 3, data_->xmat + 9 * body);
    return both;
  }

  Vector3 to_body(const double* in_world) const {
    Quaternion inverse;
    mju_negQuat(inverse.data(), data_->qpos + 3);
    Vector3 result;
    mju_rotVecQuat(result.data(), in_world, inverse.data());
    return result;
  }

  void set(const State& state) {
    std::size_t position_at = 0, velocity_at = 0;
    if (floating_) {
      const double* p = state.position.data();
      const double own[] = {p[0], p[1], p[2], p[6], p[3], p[4], p[5]};
      mju_copy(data_->qpos, own, 7);
      mju_zero(data_->qvel, 6);
      if (!state.velocity.empty()) {
        mju_rotVecQuat(data_->qvel, state.velocity.data() + 3, data_->qpos + 3);
        mju_copy(data_->qvel + 3, state.velocity.data(), 3);
      }
      position_at = 7;
      velocity_at = 6;
    }
    for (std::size_t i = 0; i < position_.size(); ++i) {
      data_->qpos[position_[i]] = state.position[position_at + i];
      data_->qvel[velocity_[i]] = state.velocity.empty() ? 0 : state.velocity[velocity_at + i];
    }
  }

  void write_acceleration(const State& state, const Vector& acceleration) {
    std::size_t at = 0;
    if (floating_) {
      // d/dt (R v) = R (dv/dt + omega x v)
      const double* v = state.velocity.data();
      Vector3 in_body;
      mju_cross(in_body.data(), v, v + 3);
      for (std::size_t i = 0; i < 3; ++i) in_body[i] += acceleration[3 + i];
      mju_rotVecQuat(data_->qacc, in_body.data(), data_->qpos + 3);
      mju_copy(data_->qacc + 3, acceleration.data(), 3);
      at = 6;
    }
    for (std::size_t i = 0; i < velocity_.size(); ++i)
      data_->qacc[velocity_[i]] = acceleration[at + i];
  }

  Vector read_force(const double* own) const {
    Vector force;
    if (floating_) {
      const Vector3 linear = to_body(own);
      force.assign(own + 3, own + 6);
      force.insert(force.end(), linear.begin(), linear.end());
    }
    for (const int i : velocity_) force.push_back(own[i]);
    return force;
  }

  std::vector<Loaded> loaded_;
  Vector result_;
  bool floating_;
  mjModel* model_ = nullptr;
  mjData* data_ = nullptr;
  std::vector<int> position_, velocity_;  // addresses of the caller's joints
};

}  // namespace

std::unique_ptr<Peer> make_mujoco(const Setup& setup) {
  return with_followers(setup, [](const Setup& all) { return std::make_unique<MujocoPeer>(all); });
}

}  // namespace sinew::peers
