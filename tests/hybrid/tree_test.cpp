// On trees of any branching, fixed and floating, beside the dense solution of the equations of
// motion, whose terms come from KDL and MuJoCo.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "hybrid_question.h"
#include "random_urdf.h"

namespace sinew::test {
namespace {

double relative(const VectorXd& a, const VectorXd& b) {
  return (a - b).lpNorm<Eigen::Infinity>() / std::max(1.0, b.lpNorm<Eigen::Infinity>());
}

peers::Vector numbers(std::mt19937& random, std::size_t count, double size) {
  std::uniform_real_distribution<> number(-size, size);
  peers::Vector result(count);
  for (double& one : result) one = number(random);
  return result;
}

// Links on which something can act: those of a random robot that hang on moving joints.
std::vector<std::string> moving_links(const std::string& urdf) {
  std::vector<std::string> links;
  for (std::size_t at = urdf.find("<joint name=\"joint"); at != std::string::npos;
       at = urdf.find("<joint name=\"joint", at + 1)) {
    const std::size_t child = urdf.find("child link=\"", at) + 12;
    links.push_back(urdf.substr(child, urdf.find('"', child) - child));
  }
  return links;
}

// Some directions of some links, seen by the base or by the link itself.
std::vector<DenseConstraint> random_constraints(std::mt19937& random,
                                                const std::vector<std::string>& links,
                                                std::size_t count) {
  std::vector<DenseConstraint> constraints;
  std::set<std::string> taken;
  while (constraints.size() < count && taken.size() < links.size()) {
    const std::string link = links[random() % links.size()];
    if (!taken.insert(link).second) continue;
    const bool itself = random() % 2 == 0;
    std::set<int> axes;
    const std::size_t some = std::min<std::size_t>(count - constraints.size(), 1 + random() % 3);
    while (axes.size() < some) axes.insert(static_cast<int>(random() % 6));
    for (const int i : axes) constraints.push_back({link, axis(i), itself, 0});
  }
  return constraints;
}

struct Case {
  unsigned joints;
  double branching;
  std::size_t constraints;
  bool floating;
};

void compare(const Case& what, unsigned seed, unsigned& compared) {
  SCOPED_TRACE(testing::Message() << what.joints << " joints, seed " << seed
                                  << (what.floating ? ", floating" : ""));
  RandomRobot options;
  options.joints = what.joints;
  options.branching = what.branching;
  options.floating = what.floating;
  options.seed = seed;
  const TemporaryRobot file(random_urdf(options));
  const Robot& robot = file.robot();
  std::mt19937 random(seed);
  std::vector<std::string> links = moving_links(robot.urdf);
  Problem problem;
  problem.constraints = random_constraints(random, links, what.constraints);
  problem.wrenches = {{links.front(), {}}, {links.back(), {}}};
  if (links.size() == 1) problem.wrenches.pop_back();
  cli::QueryOptions query;
  query.solver = "hybrid";
  query.gravity = "0,0,-9.81";
  query.floating = what.floating;
  query.constraints = constraint_options(problem.constraints);
  for (const DenseWrench& one : problem.wrenches)
    query.give.push_back("external-wrench of " + one.link);
  Question question(robot, query);
  const peers::Setup setup{robot.urdf, question.joints(), what.floating, {0, 0, -9.81}};
  const auto peer = what.floating ? peers::make_mujoco(setup) : peers::make_kdl(setup);

  const std::size_t base = what.floating ? 6 : 0;
  for (unsigned s = 0; s < 10; ++s) {
    problem.state = random_state(question.joints().size(), 100 * seed + s, what.floating);
    problem.force = numbers(random, base + question.joints().size(), 10);
    for (DenseConstraint& one : problem.constraints) one.energy = numbers(random, 1, 3)[0];
    for (DenseWrench& one : problem.wrenches) one.wrench = numbers(random, 6, 5);
    const DenseSolution dense = solve_densely(*peer, problem);
    if (!(dense.condition < 1e4)) continue;  // singular, or nearly: singular_test.cpp
    ++compared;
    const auto ours = answers(question, problem);
    const VectorXd acceleration = outputs(question, ours, "acceleration");
    EXPECT_LT(relative(acceleration, dense.acceleration), 1e-8);
    EXPECT_LT(relative(outputs(question, ours, "constraint-magnitude"), dense.magnitude), 1e-8);
    EXPECT_LT(relative(outputs(question, ours, "constraint-force"), dense.constraint_force), 1e-8);
    const VectorXd met = dense.jacobian * acceleration + dense.bias;
    for (std::size_t i = 0; i < problem.constraints.size(); ++i)
      EXPECT_NEAR(met(static_cast<Eigen::Index>(i)), problem.constraints[i].energy, 1e-8);
  }
}

TEST(HybridOnTrees, AgreesWithTheDenseSolution) {
  unsigned compared = 0, seed = 0;
  for (const Case& what :
       {Case{4, 0, 2, false}, Case{8, 0.3, 3, false}, Case{12, 0.5, 5, false},
        Case{20, 0.7, 6, false}, Case{30, 0.4, 8, false}, Case{60, 0.5, 12, false}})
    for (int i = 0; i < 4; ++i) compare(what, ++seed, compared);
  EXPECT_GT(compared, 120u);
}

TEST(HybridOnTrees, AgreesWithTheDenseSolutionOnAFloatingBase) {
  unsigned compared = 0, seed = 100;
  for (const Case& what : {Case{3, 0, 3, true}, Case{8, 0.5, 5, true}, Case{15, 0.4, 8, true},
                           Case{30, 0.6, 10, true}})
    for (int i = 0; i < 4; ++i) compare(what, ++seed, compared);
  EXPECT_GT(compared, 100u);
}

TEST(HybridOnTrees, TakesUnitForcesAsInputs) {
  RandomRobot options;
  options.joints = 7;
  options.branching = 0;
  options.seed = 11;
  const TemporaryRobot file(random_urdf(options));
  const Robot& robot = file.robot();
  const std::string link = moving_links(robot.urdf).back();
  cli::QueryOptions query;
  query.solver = "hybrid";
  query.gravity = "0,0,-9.81";
  query.constraints = {link + ":2"};
  Question question(robot, query);
  const peers::Setup setup{robot.urdf, question.joints(), false, {0, 0, -9.81}};
  const auto peer = peers::make_kdl(setup);
  std::mt19937 random(2);
  for (unsigned s = 0; s < 20; ++s) {
    Problem problem;
    problem.state = random_state(7, s);
    problem.force = numbers(random, 7, 10);
    for (int i = 1; i <= 2; ++i) {
      DenseConstraint one{link, {}, false, numbers(random, 1, 3)[0]};
      const peers::Vector direction = numbers(random, 6, 1);
      std::copy(direction.begin(), direction.end(), one.direction.begin());
      problem.constraints.push_back(one);
      const std::string name = link + "." + std::to_string(i);
      question.set("constraint-direction." + name, direction);
      question.set("acceleration-energy." + name, {one.energy});
    }
    const DenseSolution dense = solve_densely(*peer, problem);
    const auto ours = question.answers(problem.state, problem.force);
    EXPECT_LT(relative(outputs(question, ours, "acceleration"), dense.acceleration), 1e-8);
    EXPECT_LT(relative(outputs(question, ours, "constraint-magnitude"), dense.magnitude), 1e-8);
  }
}

// The joint forces in place of the constraint forces move the robot alike, by forward dynamics that
// knows nothing of constraints.
TEST(HybridOnTrees, ControlForcesMoveTheRobotAsTheConstraintsDo) {
  RandomRobot options;
  options.joints = 15;
  options.branching = 0.4;
  options.seed = 21;
  const TemporaryRobot file(random_urdf(options));
  const Robot& robot = file.robot();
  std::mt19937 random(3);
  Problem problem;
  problem.constraints = random_constraints(random, moving_links(robot.urdf), 4);
  cli::QueryOptions query;
  query.solver = "hybrid";
  query.gravity = "0,0,-9.81";
  query.constraints = constraint_options(problem.constraints);
  Question question(robot, query), aba(robot, "aba");
  for (unsigned s = 0; s < 20; ++s) {
    problem.state = random_state(15, s);
    problem.force = numbers(random, 15, 10);
    for (DenseConstraint& one : problem.constraints) one.energy = numbers(random, 1, 3)[0];
    const auto ours = answers(question, problem);
    const VectorXd control = outputs(question, ours, "control-force");
    const VectorXd acceleration = outputs(question, ours, "acceleration");
    const peers::Vector free =
        aba.answer(problem.state, peers::Vector(control.begin(), control.end()));
    EXPECT_LT(relative(Eigen::Map<const VectorXd>(free.data(), 15), acceleration), 1e-8);
  }
}

}  // namespace
}  // namespace sinew::test
