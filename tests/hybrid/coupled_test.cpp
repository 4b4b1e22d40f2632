// Where joints follow others: imposed accelerations, wrenches and joint forces beside the dense
// equations of motion with constraints, with the independent joints as coordinates,
//   [ M  -J^T ] [qdd]   [ tau - h + sum of J_w^T w ]
//   [ J   0   ] [ x ] = [ energies - Jdot qd       ]
// On trees with joints of all kinds, with followers on any branch and at any depth, helical ones
// (also such that follow), rotors behind gears; on fixed and on floating bases.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "dense_reference.h"
#include "exact_joints.h"
#include "hybrid_question.h"
#include "model_solver.h"
#include "sinew/backend/c_target.h"
#include "sinew/backend/compile.h"

namespace sinew::test {
namespace {

using Exact = ExactDynamics<long double>;
using Long = Exact::Vector;

// An axis-aligned unit force on the frame of a link.
struct Imposed {
  int link = 0, axis = 0;
  bool seen_by_itself = false;
  double energy = 0;
};

std::string frame(int link) { return "link" + std::to_string(link) + "-root"; }

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

struct Wrench {
  int link = 0;
  VectorXd numbers;
};

struct Solution {
  VectorXd acceleration, magnitude, constraint_force;
  MatrixXd coupling;
  VectorXd residual;
  double condition = 0;
};

struct Task {
  DenseState state;
  VectorXd force;
  std::vector<Imposed> imposed;
  std::vector<Wrench> wrenches;
};

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

Long given_force(const Exact& exact, const Task& task) {
  Long force = task.force.cast<long double>() - exact.bias();
  for (const Wrench& one : task.wrenches) {
    const Exact::Body& body = exact.body(static_cast<std::size_t>(one.link));
    force += body.J.transpose() * (turned(body) * one.numbers.cast<long double>());
  }
  return force;
}

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
    missing(i) = one.energy - a.dot(bias);
  }
  const Long force = given_force(exact, task);
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
  Long force = given_force(exact, task);
  for (std::size_t i = 0; i < task.imposed.size(); ++i) {
    const Imposed& one = task.imposed[i];
    const Exact::Body& body = exact.body(static_cast<std::size_t>(one.link));
    Eigen::Matrix<long double, 6, 1> a = Eigen::Matrix<long double, 6, 1>::Unit(one.axis);
    if (one.seen_by_itself) a = turned(body) * a;
    force += body.J.transpose() * a * magnitude(static_cast<Eigen::Index>(i));
  }
  return exact.mass_matrix().ldlt().solve(force).cast<double>();
}

VectorXd numbers(std::mt19937& random, Eigen::Index count, double size) {
  std::uniform_real_distribution<> number(-size, size);
  VectorXd result(count);
  for (double& one : result) one = number(random);
  return result;
}

// Some directions of some links, and wrenches on two of them.
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

struct Case {
  unsigned joints;
  double branching;
  std::size_t directions;
  std::vector<std::string> kinds;
};

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

void compare(const Case& what, unsigned seed, unsigned& compared, unsigned& across) {
  RandomJoints options;
  options.joints = what.joints;
  options.branching = what.branching;
  options.seed = seed;
  if (!what.kinds.empty()) options.kinds = what.kinds;
  const TestRobot robot = random_joints(options);
  SCOPED_TRACE(testing::Message() << what.joints << " joints, seed " << seed);
  std::mt19937 random(seed);
  Task task = random_task(robot, random, what.directions);
  ModelSolver hybrid(turtle(robot), query_of(task));
  across += follows_in_another_branch(robot) ? 1 : 0;
  for (unsigned s = 0; s < 4; ++s) {
    draw(robot, random, 100 * seed + s, task);
    set(hybrid, task);
    const Solution expected = solve(robot, task);
    if (!(expected.condition < 1e4)) continue;  // singular, or nearly: see below
    ++compared;
    const auto found = hybrid.answer(robot, task.state, task.force);
    EXPECT_LT(difference(joined(robot, found, "acceleration"), expected.acceleration), 1e-8);
    EXPECT_LT(difference(magnitudes(task, found), expected.magnitude), 1e-8);
    EXPECT_LT(difference(joined(robot, found, "constraint-force"), expected.constraint_force),
              1e-8);
    EXPECT_LT(
        difference(joined(robot, found, "control-force"), expected.constraint_force + task.force),
        1e-8);
  }
}

TEST(CoupledHybrid, AgreesWithTheDenseSolutionOnTreesOfRevoluteAndPrismaticFollowers) {
  unsigned compared = 0, across = 0, seed = 300;
  for (const Case& what :
       {Case{3, 0, 1, {"revolute", "prismatic"}}, Case{6, 0, 2, {"revolute", "prismatic"}},
        Case{9, 0.5, 3, {"revolute", "prismatic"}}, Case{20, 0.6, 4, {"revolute", "prismatic"}}})
    for (int i = 0; i < 6; ++i) compare(what, ++seed, compared, across);
  EXPECT_GT(compared, 40u);
  EXPECT_GT(across, 5u);
}

TEST(CoupledHybrid, AgreesWithTheDenseSolutionOnTreesOfJointsOfAllKinds) {
  unsigned compared = 0, across = 0, seed = 400;
  for (const Case& what : {Case{2, 0, 1, {"helical"}}, Case{5, 0.3, 2, {"helical", "revolute"}},
                           Case{8, 0.4, 4, {}}, Case{15, 0.5, 5, {}}})
    for (int i = 0; i < 5; ++i) compare(what, ++seed, compared, across);
  EXPECT_GT(compared, 40u);
  EXPECT_GT(across, 3u);
}

// A floating base is a floating joint before the first link.
TEST(CoupledHybrid, AgreesWithTheDenseSolutionOnAFloatingBase) {
  unsigned compared = 0;
  for (unsigned seed = 500; seed < 506; ++seed) {
    SCOPED_TRACE(seed);
    RandomJoints options;
    options.joints = 7;
    options.branching = 0.4;
    options.seed = seed;
    options.kinds = {"revolute", "prismatic", "helical"};
    const TestRobot robot = random_joints(options);
    // The reference's robot has the floating joint; links are one further on.
    TestRobot floating;
    floating.links.push_back({});
    floating.links.insert(floating.links.end(), robot.links.begin(), robot.links.end());
    TestJoint base;
    base.name = "base";
    base.kind = "floating";
    base.velocities = 6;
    base.positions = 7;
    floating.joints.push_back(base);
    for (TestJoint joint : robot.joints) {
      ++joint.parent;
      if (joint.leader >= 0) ++joint.leader;
      joint.velocity += 6;
      joint.position += 7;
      for (TestMotion& motion : joint.motions) motion.coordinate += 6;
      floating.joints.push_back(joint);
    }
    floating.velocities = robot.velocities + 6;
    floating.positions = robot.positions + 7;
    std::mt19937 random(seed);
    const Task asked = random_task(robot, random, 3);
    ModelSolver hybrid(turtle(robot), [&] {
      cli::QueryOptions query = query_of(asked);
      query.floating = true;
      return query;
    }());
    for (unsigned s = 0; s < 4; ++s) {
      Task task = asked;
      draw(floating, random, 100 * seed + s, task);
      set(hybrid, task);
      const auto found = hybrid.answer(floating, task.state, task.force);
      Task moved = task;
      for (Imposed& one : moved.imposed) ++one.link;
      for (Wrench& one : moved.wrenches) ++one.link;
      const Solution expected = solve(floating, moved);
      if (!(expected.condition < 1e4)) continue;
      ++compared;
      auto named = found;  // the base's numbers are called by its link
      for (const std::string quantity : {"acceleration", "constraint-force"})
        named[quantity + ".base"] = found.at(quantity + ".link0");
      EXPECT_LT(difference(joined(floating, named, "acceleration"), expected.acceleration), 1e-8);
      EXPECT_LT(difference(joined(floating, named, "constraint-force"), expected.constraint_force),
                1e-8);
      EXPECT_LT(difference(magnitudes(task, found), expected.magnitude), 1e-8);
    }
  }
  EXPECT_GT(compared, 15u);
}

// ---- where constraints depend on each other ----

// A finger of three turns about parallel axes of which two follow the first: one degree of freedom.
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

VectorXd by_policy(const std::string& policy, const Solution& of) {
  const auto m = of.residual.size();
  VectorXd s = of.coupling.diagonal();
  for (double& one : s) one = one > 1e-14 ? 1 / std::sqrt(one) : 0;
  const MatrixXd L = s.asDiagonal() * of.coupling * s.asDiagonal();
  const VectorXd r = s.asDiagonal() * of.residual;
  if (policy.starts_with("truncated")) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(L);
    VectorXd inverse = eigen.eigenvalues();
    for (double& one : inverse) one = one > 1e-6 ? 1 / one : 0;
    return s.asDiagonal() *
           (eigen.eigenvectors() * (inverse.asDiagonal() * (eigen.eigenvectors().transpose() * r)));
  }
  if (policy.starts_with("damped")) {
    const MatrixXd normal = L * L + 1e-4 * MatrixXd::Identity(m, m);
    return s.asDiagonal() * normal.fullPivLu().solve(L * r);
  }
  // One degree of freedom: the first constraint that moves anything is met, the others depend on
  // it.
  VectorXd x = VectorXd::Zero(m);
  for (Eigen::Index i = 0; i < m; ++i)
    if (of.coupling(i, i) > 1e-14) {
      x[i] = of.residual[i] / of.coupling(i, i);
      break;
    }
  return x;
}

TEST(CoupledHybrid, GivesTheAnswerThatThePolicyNamesWhereConstraintsDependOnEachOther) {
  const TestRobot robot = finger();
  for (const std::string policy : {"in-order:1e-6", "truncated:1e-6", "damped:0.01"}) {
    SCOPED_TRACE(policy);
    Task task;
    // Out of the plane nothing moves; in it one coordinate cannot do three things.
    for (const int i : {2, 3, 4, 5}) task.imposed.push_back({3, i, false, 0});
    cli::QueryOptions query = query_of(task);
    query.singular = policy;
    ModelSolver hybrid(turtle(robot), query);
    std::mt19937 random(3);
    for (unsigned seed = 0; seed < 10; ++seed) {
      draw(robot, random, seed, task);
      set(hybrid, task);
      const VectorXd magnitude = by_policy(policy, solve(robot, task));
      const auto found = hybrid.answer(robot, task.state, task.force);
      EXPECT_LT(difference(magnitudes(task, found), magnitude), 1e-6);
      EXPECT_LT(difference(joined(robot, found, "acceleration"),
                           acceleration_under(robot, task, magnitude)),
                1e-6);
    }
  }
}

// ---- drivers apart, limits ----

// The first of some trees in which a joint follows one of another branch.
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

TEST(CoupledHybrid, DriversApartSumToWhatTheyDoTogether) {
  const TestRobot robot = coupled_tree(8);
  std::mt19937 random(8);
  Task task = random_task(robot, random, 2);
  cli::QueryOptions query = query_of(task);
  ModelSolver together(turtle(robot), query);
  query.drivers = "apart";
  ModelSolver apart(turtle(robot), query);
  for (unsigned seed = 0; seed < 5; ++seed) {
    draw(robot, random, seed, task);
    set(together, task);
    set(apart, task);
    const auto expected = together.answer(robot, task.state, task.force),
               found = apart.answer(robot, task.state, task.force);
    const VectorXd acceleration = joined(robot, expected, "acceleration");
    EXPECT_LT(difference(joined(robot, found, "acceleration"), acceleration), 1e-9);
    std::map<std::string, double> sums;
    std::size_t drivers = 0;
    for (const auto& [name, effect] : found) {
      if (!name.starts_with("driver-acceleration.")) continue;
      sums[name.substr(name.rfind('.') + 1)] += effect[0];
      ++drivers;
    }
    ASSERT_EQ(sums.size(), static_cast<std::size_t>(robot.velocities));
    EXPECT_GT(drivers, 4 * sums.size());
    VectorXd sum(robot.velocities), total(robot.velocities);
    Eigen::Index at = 0;
    for (const auto& [joint, number] : sums) {
      sum[at] = number;
      // A helical joint's driving part is called after it.
      const std::string of = joint.substr(0, joint.find('-'));
      total[at++] = expected.at("acceleration." + of)[0];
    }
    EXPECT_LT(difference(sum, total), 1e-9);
  }
}

// An actuator drives the joint at the head of a line and through it all that follow: its limit is
// that of the head, and what counts against it is the sum.
TEST(CoupledHybrid, OneDriverIsScaledDownUntilNoActuatorSaturates) {
  const TestRobot robot = finger();
  std::string model = turtle(robot);
  for (const auto& [joint, limit] : {std::pair<std::string, double>{"j0", 1.5}, {"j1", 1e-6}})
    model += ":" + joint + "-limit a skc:JointForceLimit ; kc-stat:of-joint :" + joint +
             " ; skc:maximum " + std::to_string(limit) + " ; qudt:unit unit:N-M .\n";
  Task task;
  task.imposed.push_back({3, 4, true, 0});
  cli::QueryOptions query = query_of(task);
  ModelSolver together(model, query);
  query.limited = frame(3);
  ModelSolver limited(model, query);
  unsigned scaled = 0, untouched = 0;
  std::mt19937 random(4);
  for (unsigned seed = 0; seed < 60; ++seed) {
    draw(robot, random, seed, task);
    task.force *= 0.1;
    task.imposed.front().energy *= 3;
    set(limited, task);
    const auto found = limited.answer(robot, task.state, task.force);
    const double scale = found.at("driver-scale.constraint-" + frame(3))[0];
    ASSERT_GE(scale, 0);
    ASSERT_LE(scale, 1);
    Task smaller = task;
    smaller.imposed.front().energy *= scale;
    set(together, smaller);
    const auto expected = together.answer(robot, task.state, task.force);
    EXPECT_LT(difference(found.at("acceleration.j0"), expected.at("acceleration.j0")), 1e-9);
    const double control = std::abs(found.at("control-force.j0")[0]);
    if (scale > 0) {
      EXPECT_LE(control, 1.5 + 1e-9);
    }
    scaled += scale > 0 && scale < 1 ? 1 : 0;
    untouched += scale == 1 ? 1 : 0;
    if (scale > 0 && scale < 1) {
      EXPECT_NEAR(control, 1.5, 1e-9);
    }
  }
  EXPECT_GT(scaled, 5u);
  EXPECT_GT(untouched, 5u);
}

// Flat and readable C take the same steps.
TEST(CoupledHybrid, IsTheSameInGeneratedCode) {
  const TestRobot robot = coupled_tree(5);
  std::mt19937 random(9);
  Task task = random_task(robot, random, 2);
  ModelSolver hybrid(turtle(robot), query_of(task));
  draw(robot, random, 1, task);
  set(hybrid, task);
  const std::vector<double> in = hybrid.inputs(robot, task.state, task.force);
  backend::Interpreter interpreter(hybrid.program());
  std::vector<double> expected(interpreter.out_size()), out(expected.size());
  interpreter.evaluate(in.data(), expected.data());
  for (const backend::Style style : {backend::Style::kFlat, backend::Style::kReadable}) {
    backend::COptions c;
    c.name = "solver";
    c.style = style;
    const backend::LoadedCode code = backend::compile_and_load(
        backend::generate_c(hybrid.program(), c),
        {"cc",
         {"-O1", "-Wall", "-Wextra", "-Werror", "-std=c11", "-I" SINEW_SOURCE_DIR "/sinew/math"},
         {SINEW_MATH_LIBRARY}});
    code.function()(in.data(), out.data());
    for (std::size_t i = 0; i < out.size(); ++i)
      EXPECT_NEAR(out[i], expected[i], 1e-9 * std::max(1.0, std::abs(expected[i])));
  }
}

}  // namespace
}  // namespace sinew::test
