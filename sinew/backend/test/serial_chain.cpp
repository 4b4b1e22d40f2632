#include "serial_chain.h"

#include <Eigen/Dense>
#include <cmath>

namespace sinew::test {
namespace {

using program::Closure;
using program::Program;
using program::Role;
using program::Variable;

const std::string kIri = "https://example.org/chain#";

// Adds variables and closures; a variable is known by its name.
class Builder {
 public:
  std::uint32_t add(const std::string& name, const std::string& quantity, std::uint32_t size,
                    Role role = Role::kInternal, std::vector<double> value = {},
                    bool output = false) {
    Variable v;
    v.name = name;
    v.iri = kIri + "data/" + name;
    v.represents = kIri + name.substr(name.find('.') + 1);
    v.quantity = quantity;
    v.unit = "UNITLESS";
    v.frame = size == 1 ? "" : kIri + "frame";
    v.role = role;
    v.output = output;
    v.size = size;
    v.value = std::move(value);
    program_.variables.push_back(std::move(v));
    return static_cast<std::uint32_t>(program_.variables.size() - 1);
  }

  // Calls an operator whose last argument is a new variable, and returns that.
  std::uint32_t call(const std::string& operation, std::vector<std::uint32_t> arguments,
                     const std::string& result, std::uint32_t size, bool output = false) {
    arguments.push_back(add(result, "of " + operation, size, Role::kInternal, {}, output));
    Closure closure;
    closure.operation = operation;
    closure.iri = kIri + "closure/" + result;
    closure.step = kIri + "step";
    closure.about = kIri + result.substr(result.find('.') + 1);
    closure.arguments = std::move(arguments);
    program_.schedule.push_back(static_cast<std::uint32_t>(program_.closures.size()));
    program_.closures.push_back(std::move(closure));
    return program_.closures.back().arguments.back();
  }

  Program take() { return std::move(program_); }
  Program program_;
};

}  // namespace

std::array<double, 12> placement(double twist_rad, double x, double y, double z) {
  const double c = std::cos(twist_rad);
  const double s = std::sin(twist_rad);
  return {1, 0, 0, x, 0, c, -s, y, 0, s, c, z};
}

std::vector<ChainJoint> mixed_chain() {
  const double half_pi = std::acos(0.0);
  std::vector<ChainJoint> joints = {
      {true, placement(0, 0, 0, 0.3), {}},         {true, placement(-half_pi, 0, 0.1, 0), {}},
      {true, placement(half_pi, 0.2, 0, 0.4), {}}, {false, placement(0.7, 0.1, -0.2, 0.05), {}},
      {true, placement(-half_pi, 0, 0, 0.25), {}}, {true, placement(1.1, 0.3, 0.02, -0.1), {}},
      {true, placement(half_pi, 0, -0.15, 0), {}},
  };
  // Each link a box of its own about a centre of mass of its own, seen from the link's frame.
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const double d = static_cast<double>(k);
    const double m = 3.0 - 0.3 * d;
    const Eigen::Vector3d c(0.02 + 0.01 * d, -0.03 * d + 0.05, 0.1 - 0.02 * d);
    Eigen::Matrix3d I;
    I << 0.02 + 0.001 * d, 0.001, -0.002, 0.001, 0.03, 0.0015 * d, -0.002, 0.0015 * d, 0.025;
    const Eigen::Matrix3d J = I + m * (c.dot(c) * Eigen::Matrix3d::Identity() - c * c.transpose());
    joints[k].inertia = {m,       m * c.x(), m * c.y(), m * c.z(), J(0, 0),
                         J(0, 1), J(0, 2),   J(1, 1),   J(1, 2),   J(2, 2)};
  }
  return joints;
}

Program inverse_dynamics(const std::vector<ChainJoint>& joints, bool with_tip_pose) {
  Builder b;
  const std::size_t n = joints.size();
  std::vector<std::uint32_t> q(n), qd(n), qdd(n);
  const auto name = [](const char* quantity, std::size_t k) {
    return std::string(quantity) + ".joint" + std::to_string(k + 1);
  };
  for (std::size_t k = 0; k < n; ++k)
    q[k] = b.add(name("position", k), "joint-position", 1, Role::kInput);
  for (std::size_t k = 0; k < n; ++k)
    qd[k] = b.add(name("velocity", k), "joint-velocity", 1, Role::kInput);
  for (std::size_t k = 0; k < n; ++k)
    qdd[k] = b.add(name("acceleration", k), "joint-acceleration", 1, Role::kInput);

  std::uint32_t V =
      b.add("twist.base", "velocity-twist", 6, Role::kConstant, std::vector<double>(6, 0.0));
  std::uint32_t A = b.add("acceleration-twist.base", "acceleration-twist", 6, Role::kConstant,
                          {0, 0, 0, 0, 0, 9.81});
  std::vector<std::uint32_t> X_fixed(n), X_joint(n), W(n);
  std::uint32_t X_tip = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::string kind = joints[k].revolute ? "revolute" : "prismatic";
    const std::array<double, 12>& X = joints[k].placement;
    const std::array<double, 10>& I = joints[k].inertia;
    X_fixed[k] = b.add(name("placement", k), "pose", 12, Role::kConstant, {X.begin(), X.end()});
    X_joint[k] = b.call("position-to-pose-" + kind, {q[k]}, name("pose", k), 12);
    const std::uint32_t V_rel =
        b.call("velocity-to-twist-" + kind, {qd[k]}, name("relative-velocity", k), 6);
    const std::uint32_t A_rel =
        b.call("acceleration-to-twist-" + kind, {qdd[k]}, name("relative-acceleration", k), 6);
    const std::uint32_t A_fixed = b.call("transform-acceleration-twist-to-distal-fixed",
                                         {X_fixed[k], V, A}, name("fixed-acceleration", k), 6);
    const std::uint32_t V_fixed =
        b.call("transform-velocity-twist-to-distal", {X_fixed[k], V}, name("fixed-velocity", k), 6);
    const std::uint32_t A_moved =
        b.call("transform-acceleration-twist-to-distal", {X_joint[k], V_fixed, V_rel, A_fixed},
               name("moved-acceleration", k), 6);
    const std::uint32_t V_moved = b.call("transform-velocity-twist-to-distal",
                                         {X_joint[k], V_fixed}, name("moved-velocity", k), 6);
    V = b.call("add-velocity-twist", {V_moved, V_rel}, name("twist", k), 6);
    A = b.call("add-acceleration-twist", {A_moved, A_rel}, name("acceleration-twist", k), 6);
    const std::uint32_t inertia =
        b.add(name("inertia", k), "rigid-body-inertia", 10, Role::kConstant, {I.begin(), I.end()});
    W[k] = b.call("newton-euler-wrench", {inertia, V, A}, name("own-wrench", k), 6);
    if (!with_tip_pose) continue;
    const std::uint32_t X_link = b.call("compose-pose", {X_fixed[k], X_joint[k]},
                                        name("link-pose", k), 12, k == 0 && n == 1);
    X_tip = k == 0 ? X_link
                   : b.call("compose-pose", {X_tip, X_link},
                            k + 1 == n ? "pose.tip" : name("total-pose", k), 12, k + 1 == n);
  }
  for (std::size_t k = n; k-- > 0;) {
    const std::string kind = joints[k].revolute ? "revolute" : "prismatic";
    b.call("force-from-wrench-" + kind, {W[k]}, name("force", k), 1, true);
    if (k == 0) break;
    const std::uint32_t at_joint =
        b.call("transform-wrench-to-proximal", {X_joint[k], W[k]}, name("joint-wrench", k), 6);
    const std::uint32_t at_parent =
        b.call("transform-wrench-to-proximal", {X_fixed[k], at_joint}, name("parent-wrench", k), 6);
    W[k - 1] = b.call("accumulate-wrench", {W[k - 1], at_parent}, name("total-wrench", k - 1), 6);
  }
  Program program = b.take();
  program.name = "chain";
  program.iri = kIri + "algorithm";
  return program;
}

std::vector<double> dense_inverse_dynamics(const std::vector<ChainJoint>& joints,
                                           const std::vector<double>& q,
                                           const std::vector<double>& qd,
                                           const std::vector<double>& qdd) {
  using Eigen::Matrix3d;
  using Eigen::Vector3d;
  const std::size_t n = joints.size();
  Matrix3d R = Matrix3d::Identity();
  Vector3d p = Vector3d::Zero(), w = p, al = p, a(0, 0, 9.81);
  std::vector<Vector3d> axis(n), origin(n), f(n), moment(n);  // moment about the base's origin
  for (std::size_t k = 0; k < n; ++k) {
    Matrix3d Rf;
    const std::array<double, 12>& X = joints[k].placement;
    Rf << X[0], X[1], X[2], X[4], X[5], X[6], X[8], X[9], X[10];
    Vector3d d = R * Vector3d(X[3], X[7], X[11]);
    R = R * Rf;
    const Vector3d z = R.col(2);
    if (!joints[k].revolute) d += q[k] * z;
    a += al.cross(d) + w.cross(w.cross(d));
    if (joints[k].revolute) {
      al += w.cross(z) * qd[k] + z * qdd[k];
      w += z * qd[k];
      R = R * Eigen::AngleAxisd(q[k], Vector3d::UnitZ()).toRotationMatrix();
    } else {
      a += 2 * w.cross(z) * qd[k] + z * qdd[k];
    }
    p += d;
    const std::array<double, 10>& I = joints[k].inertia;
    Matrix3d J;
    J << I[4], I[5], I[6], I[5], I[7], I[8], I[6], I[8], I[9];
    J = R * J * R.transpose();
    const Vector3d h = R * Vector3d(I[1], I[2], I[3]);
    f[k] = I[0] * a + al.cross(h) + w.cross(w.cross(h));
    moment[k] = J * al + w.cross(J * w) + h.cross(a) + p.cross(f[k]);
    axis[k] = z;
    origin[k] = p;
  }
  std::vector<double> force(n);
  Vector3d F = Vector3d::Zero(), M = F;
  for (std::size_t k = n; k-- > 0;) {
    F += f[k];
    M += moment[k];
    force[k] = joints[k].revolute ? axis[k].dot(M - origin[k].cross(F)) : axis[k].dot(F);
  }
  return force;
}

program::Program running_sum() {
  program::Program sum;
  sum.name = "sum";
  const auto variable = [&](const std::string& name, program::Role role, std::vector<double> value,
                            bool output) {
    program::Variable v;
    v.name = name;
    v.size = 6;
    v.role = role;
    v.value = std::move(value);
    v.output = output;
    sum.variables.push_back(std::move(v));
  };
  variable("push", program::Role::kInput, {}, false);
  variable("total", program::Role::kState, {1, 2, 3, 4, 5, 6}, true);
  variable("sum", program::Role::kInternal, {}, false);
  variable("zero", program::Role::kConstant, std::vector<double>(6, 0.0), false);
  sum.closures = {{"accumulate-wrench", "", "", "", {1, 0, 2}},
                  {"accumulate-wrench", "", "", "", {2, 3, 1}}};
  sum.schedule = {0, 1};
  return sum;
}

}  // namespace sinew::test
