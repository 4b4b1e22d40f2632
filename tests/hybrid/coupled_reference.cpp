#include "coupled_reference.h"

#include <set>

#include "exact_joints.h"
#include "hybrid_question.h"

namespace sinew::test::coupled {
namespace {

using Exact = ExactDynamics<long double>;
using Long = Exact::Vector;

// "FRAME:AXIS@OBSERVER" for each, in their order; a frame has all of its directions in a row.
std::vector<std::string> options_of(const std::vector<Imposed>& all) {
  std::vector<std::string> options;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool more = i > 0 && all[i - 1].link == all[i].link;
    const std::string name = axis_name(axis(all[i].axis));
    if (more)
      options.back().insert(options.back().rfind('@'), "," + name);
    else
      options.push_back(frame(all[i].link) + ":" + name +
                        (all[i].seen_by_itself ? "@itself" : "@base"));
  }
  return options;
}

Eigen::Matrix<long double, 6, 6> turned(const Exact::Body& body) {
  Eigen::Matrix<long double, 6, 6> R;
  R.setZero();
  R.topLeftCorner<3, 3>() = body.R;
  R.bottomRightCorner<3, 3>() = body.R;
  return R;
}

Exact exact_of(const TestRobot& robot, const DenseState& state) {
  return Exact(exact_robot<long double>(robot), kGravity, state.position.cast<long double>(),
               state.velocity.cast<long double>());
}

// What acts on the coordinates beside constraint forces.
Long given_force(const Exact& exact, const TestRobot& robot, const Task& task) {
  DenseState still = task.state;
  still.velocity.setZero();
  const Long falls = exact_of(robot, still).bias(), both = exact.bias();
  Long force =
      task.force.cast<long double>() - task.gravity * falls - task.velocity * (both - falls);
  for (const Wrench& one : task.wrenches) {
    const Exact::Body& body = exact.body(static_cast<std::size_t>(one.link));
    force += body.J.transpose() * (turned(body) * one.numbers.cast<long double>());
  }
  return force;
}

VectorXd numbers(std::mt19937& random, Eigen::Index count, double size) {
  std::uniform_real_distribution<> number(-size, size);
  VectorXd result(count);
  for (double& one : result) one = number(random);
  return result;
}

}  // namespace

Solution solve(const TestRobot& robot, const Task& task) {
  const Exact exact = exact_of(robot, task.state);
  const auto n = static_cast<Eigen::Index>(robot.velocities),
             m = static_cast<Eigen::Index>(task.imposed.size());
  Exact::Matrix J(m, n);
  Long missing(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const Imposed& one = task.imposed[static_cast<std::size_t>(i)];
    const Exact::Body& body = exact.body(static_cast<std::size_t>(one.link));
    Eigen::Matrix<long double, 6, 1> a = Eigen::Matrix<long double, 6, 1>::Unit(one.axis);
    if (one.seen_by_itself) a = turned(body) * a;
    J.row(i) = a.transpose() * body.J;
    Eigen::Matrix<long double, 6, 1> bias;
    bias << body.al, body.a;
    missing(i) = one.energy - task.velocity * a.dot(bias);
  }
  const Long force = given_force(exact, robot, task);
  Exact::Matrix kkt = Exact::Matrix::Zero(n + m, n + m);
  kkt << exact.mass_matrix(), -J.transpose(), J, Exact::Matrix::Zero(m, m);
  Long right(n + m);
  right << force, missing;
  const Long all = kkt.fullPivLu().solve(right);
  const Eigen::LDLT<Exact::Matrix> factors(exact.mass_matrix());
  Solution solution;
  solution.acceleration = all.head(n).cast<double>();
  solution.magnitude = all.tail(m).cast<double>();
  solution.constraint_force = (J.transpose() * all.tail(m)).cast<double>();
  solution.coupling = (J * factors.solve(J.transpose())).cast<double>();
  solution.residual = (missing - J * factors.solve(force)).cast<double>();
  const VectorXd scale = solution.coupling.diagonal().cwiseSqrt().cwiseInverse();
  const VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(
                              scale.asDiagonal() * solution.coupling * scale.asDiagonal())
                              .eigenvalues();
  solution.condition = scale.allFinite() ? values(m - 1) / std::max(values(0), 1e-300) : 1e300;
  return solution;
}

VectorXd acceleration_under(const TestRobot& robot, const Task& task, const VectorXd& magnitude) {
  const Exact exact = exact_of(robot, task.state);
  Long force = given_force(exact, robot, task);
  for (std::size_t i = 0; i < task.imposed.size(); ++i) {
    const Imposed& one = task.imposed[i];
    const Exact::Body& body = exact.body(static_cast<std::size_t>(one.link));
    Eigen::Matrix<long double, 6, 1> a = Eigen::Matrix<long double, 6, 1>::Unit(one.axis);
    if (one.seen_by_itself) a = turned(body) * a;
    force += body.J.transpose() * a * magnitude(static_cast<Eigen::Index>(i));
  }
  return exact.mass_matrix().ldlt().solve(force).cast<double>();
}

Task random_task(const TestRobot& robot, std::mt19937& random, std::size_t count) {
  Task task;
  std::set<int> taken;
  const int links = static_cast<int>(robot.joints.size());
  const auto any = [&] { return 1 + static_cast<int>(random() % static_cast<unsigned>(links)); };
  while (task.imposed.size() < count && taken.size() < robot.joints.size()) {
    const int link = any();
    if (!taken.insert(link).second) continue;
    const bool itself = random() % 2 == 0;
    std::set<int> axes;
    const std::size_t some = std::min<std::size_t>(count - task.imposed.size(), 1 + random() % 2);
    while (axes.size() < some) axes.insert(static_cast<int>(random() % 6));
    for (const int i : axes) task.imposed.push_back({link, i, itself, 0});
  }
  const int first = any(), second = any();
  task.wrenches.push_back({first, {}});
  if (second != first) task.wrenches.push_back({second, {}});
  return task;
}

void draw(const TestRobot& robot, std::mt19937& random, unsigned seed, Task& task) {
  task.state = random_state(robot, seed);
  task.force = numbers(random, robot.velocities, 10);
  for (Imposed& one : task.imposed) one.energy = numbers(random, 1, 3)[0];
  for (Wrench& one : task.wrenches) one.numbers = numbers(random, 6, 5);
}

cli::QueryOptions query_of(const Task& task) {
  cli::QueryOptions query;
  query.solver = "hybrid";
  query.constraints = options_of(task.imposed);
  for (const Wrench& one : task.wrenches)
    query.give.push_back("external-wrench of " + frame(one.link));
  return query;
}

void set(ModelSolver& solver, const Task& task) {
  for (const Imposed& one : task.imposed)
    solver.set("acceleration-energy." + frame(one.link) + "." + axis_name(axis(one.axis)),
               VectorXd::Constant(1, one.energy));
  for (const Wrench& one : task.wrenches) solver.set("wrench." + frame(one.link), one.numbers);
}

VectorXd magnitudes(const Task& task, const std::map<std::string, VectorXd>& answers) {
  VectorXd all(task.imposed.size());
  for (std::size_t i = 0; i < task.imposed.size(); ++i)
    all[static_cast<Eigen::Index>(i)] =
        answers.at("constraint-magnitude." + frame(task.imposed[i].link) + "." +
                   axis_name(axis(task.imposed[i].axis)))[0];
  return all;
}

std::string frame(int link) { return "link" + std::to_string(link) + "-root"; }

bool follows_in_another_branch(const TestRobot& robot) {
  for (std::size_t k = 0; k < robot.joints.size(); ++k) {
    const int leader = robot.joints[k].leader;
    if (leader < 0) continue;
    int at = robot.joints[k].parent;  // a link; joint i leads to link i + 1
    while (at > leader + 1) at = robot.joints[static_cast<std::size_t>(at - 1)].parent;
    if (at != leader + 1) return true;
  }
  return false;
}

TestRobot coupled_tree(unsigned joints) {
  RandomJoints options;
  options.joints = joints;
  options.branching = 0.4;
  options.kinds = {"revolute", "prismatic", "helical"};
  for (options.seed = 310;; ++options.seed) {
    const TestRobot robot = random_joints(options);
    if (follows_in_another_branch(robot)) return robot;
  }
}

TestRobot finger() {
  TestRobot robot;
  robot.links.push_back({});
  for (int k = 0; k < 3; ++k) {
    TestJoint joint;
    joint.name = "j" + std::to_string(k);
    joint.kind = "revolute";
    joint.parent = k;
    if (k > 0) joint.placement.translation() = Eigen::Vector3d(0.3, 0, 0);
    joint.motions = {{true, Eigen::Vector3d::UnitZ(), 0, 1, 0}};
    if (k == 0) joint.velocities = joint.positions = 1;
    if (k > 0) {
      joint.leader = 0;
      joint.multiplier = joint.motions[0].ratio = k == 1 ? 0.8 : -0.5;
      joint.offset = joint.motions[0].offset = 0.1 * k;
    }
    robot.joints.push_back(joint);
    TestLink link;
    link.mass = 0.4;
    link.com = Eigen::Vector3d(0.15, 0.01, 0);
    link.inertia = Eigen::Vector3d(1e-4, 4e-3, 4e-3).asDiagonal();
    robot.links.push_back(link);
  }
  robot.positions = robot.velocities = 1;
  return robot;
}

}  // namespace sinew::test::coupled
