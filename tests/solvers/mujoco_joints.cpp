#include "mujoco_joints.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <Eigen/Eigenvalues>
#include <cstring>
#include <stdexcept>

namespace sinew::test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

std::string place(const Vector3d& p, const Eigen::Quaterniond& q) {
  return fmt::format("pos='{:.17g} {:.17g} {:.17g}' quat='{:.17g} {:.17g} {:.17g} {:.17g}'", p.x(),
                     p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
}

// In principal axes: MuJoCo would find them itself, to eight digits.
std::string inertial(const TestLink& link) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(link.inertia);
  Eigen::Matrix3d axes = principal.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
  const Vector3d moments = principal.eigenvalues();
  return fmt::format("<inertial {} mass='{:.17g}' diaginertia='{:.17g} {:.17g} {:.17g}'/>",
                     place(link.com, Eigen::Quaterniond(axes)), link.mass, moments.x(), moments.y(),
                     moments.z());
}

std::string joints(const TestJoint& j) {
  if (j.kind == "spherical") return fmt::format("<joint name='{}-0' type='ball'/>", j.name);
  if (j.motions.empty() || j.leader >= 0 || j.kind == "helical")
    throw std::runtime_error("MuJoCo has no joint like a " + j.kind + " one");
  std::string xml;
  for (std::size_t m = 0; m < j.motions.size(); ++m) {
    const Vector3d& a = j.motions[m].axis;
    xml += fmt::format(
        "<joint name='{}-{}' type='{}' axis='{:.17g} {:.17g} {:.17g}' armature='{:.17g}'/>", j.name,
        m, j.motions[m].turns ? "hinge" : "slide", a.x(), a.y(), a.z(), j.gear * j.gear * j.rotor);
  }
  return xml;
}

std::string bodies(const TestRobot& robot, int parent) {
  std::string xml;
  for (std::size_t k = 0; k < robot.joints.size(); ++k) {
    const TestJoint& j = robot.joints[k];
    if (j.parent != parent) continue;
    xml += fmt::format("<body name='link{}' {}>{}{}{}</body>\n", k + 1,
                       place(j.placement.translation(), Eigen::Quaterniond(j.placement.linear())),
                       joints(j), inertial(robot.links[k + 1]),
                       bodies(robot, static_cast<int>(k) + 1));
  }
  return xml;
}

}  // namespace

struct MujocoJoints::Model {
  TestRobot robot;
  mjModel* model = nullptr;
  mjData* data = nullptr;

  ~Model() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  int joint(const TestJoint& j, int motion) const {
    return mj_name2id(model, mjOBJ_JOINT, fmt::format("{}-{}", j.name, motion).c_str());
  }
  // MuJoCo's index of our velocity `k` of a joint.
  int degree(const TestJoint& j, int k) const {
    return j.motions.empty() ? model->jnt_dofadr[joint(j, 0)] + k : model->jnt_dofadr[joint(j, k)];
  }
  VectorXd ours(const mjtNum* theirs) const {
    VectorXd numbers(robot.velocities);
    for (const TestJoint& j : robot.joints)
      for (int k = 0; k < j.velocities; ++k) numbers[j.velocity + k] = theirs[degree(j, k)];
    return numbers;
  }
  void take(const VectorXd& numbers, mjtNum* theirs) const {
    for (const TestJoint& j : robot.joints)
      for (int k = 0; k < j.velocities; ++k) theirs[degree(j, k)] = numbers[j.velocity + k];
  }
  void set(const DenseState& state) const {
    for (const TestJoint& j : robot.joints) {
      if (j.motions.empty()) {
        mjtNum* const q = data->qpos + model->jnt_qposadr[joint(j, 0)];
        q[0] = state.position[j.position + 3];  // w
        for (int i = 0; i < 3; ++i) q[1 + i] = state.position[j.position + i];
      }
      for (std::size_t m = 0; m < j.motions.size(); ++m)
        data->qpos[model->jnt_qposadr[joint(j, static_cast<int>(m))]] =
            state.position[j.position + static_cast<int>(m)];
    }
    take(state.velocity, data->qvel);
  }
};

MujocoJoints::MujocoJoints(const TestRobot& robot, const Vector3d& gravity)
    : model_(std::make_unique<Model>()) {
  model_->robot = robot;
  const std::string xml = fmt::format(
      "<mujoco><compiler angle='radian' fusestatic='false' balanceinertia='false' "
      "inertiafromgeom='false'/><option gravity='{:.17g} {:.17g} {:.17g}'/><worldbody>{}"
      "</worldbody></mujoco>",
      gravity.x(), gravity.y(), gravity.z(), bodies(robot, 0));
  mjVFS files;
  mj_defaultVFS(&files);
  mj_makeEmptyFileVFS(&files, "robot.xml", static_cast<int>(xml.size()));
  std::memcpy(files.filedata[0], xml.data(), xml.size());
  char fault[1000] = "";
  model_->model = mj_loadXML("robot.xml", &files, fault, sizeof fault);
  mj_deleteVFS(&files);
  if (model_->model == nullptr) throw std::runtime_error(std::string("MuJoCo: ") + fault);
  model_->data = mj_makeData(model_->model);
}

MujocoJoints::~MujocoJoints() = default;

PeerAnswer MujocoJoints::ask(const DenseState& state, const VectorXd& given_force) {
  const Model& m = *model_;
  mjData* const data = m.data;
  const Eigen::Index n = m.robot.velocities;
  PeerAnswer answer;
  m.set(state);
  m.take(state.acceleration, data->qacc);
  mj_inverse(m.model, data);
  answer.force = m.ours(data->qfrc_inverse);

  std::vector<mjtNum> full(static_cast<std::size_t>(n * n));
  mj_fullM(m.model, full.data(), data->qM);
  answer.mass_matrix.resize(n, n);
  for (Eigen::Index column = 0; column < n; ++column) {
    VectorXd unit(n);
    std::vector<mjtNum> own(static_cast<std::size_t>(n));
    m.take(VectorXd::Unit(n, column), own.data());
    for (Eigen::Index r = 0; r < n; ++r) {
      unit[r] = 0;
      for (Eigen::Index c = 0; c < n; ++c)
        unit[r] += full[static_cast<std::size_t>(r * n + c)] * own[static_cast<std::size_t>(c)];
    }
    answer.mass_matrix.col(column) = m.ours(unit.data());
  }

  for (std::size_t link = 0; link < m.robot.links.size(); ++link) {
    const int body = mj_name2id(m.model, mjOBJ_BODY, fmt::format("link{}", link).c_str());
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    MatrixXd J = MatrixXd::Zero(6, n);
    if (body > 0) {
      const mjtNum *R = data->xmat + 9 * body, *p = data->xpos + 3 * body;
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) pose.linear()(r, c) = R[3 * r + c];
        pose.translation()[r] = p[r];
      }
      std::vector<mjtNum> linear(static_cast<std::size_t>(3 * n)), angular = linear;
      mj_jac(m.model, data, linear.data(), angular.data(), p, body);
      for (int r = 0; r < 3; ++r) {
        J.row(r) = m.ours(angular.data() + r * n);
        J.row(3 + r) = m.ours(linear.data() + r * n);
      }
    }
    answer.poses.push_back(pose);
    answer.jacobians.push_back(J);
  }

  m.take(given_force, data->qfrc_applied);
  mj_forward(m.model, data);
  answer.acceleration = m.ours(data->qacc);
  return answer;
}

}  // namespace sinew::test
