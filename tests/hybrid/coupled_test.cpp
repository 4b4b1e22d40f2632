// Where joints follow others: imposed accelerations, wrenches from outside and joint forces beside
// a dense solution (coupled_reference.h). On trees with joints of all kinds, with followers on any
// branch and at any depth, helical ones (also such that follow), rotors behind gears; on fixed and
// on floating bases.
#include <gtest/gtest.h>

#include "coupled_reference.h"
#include "sinew/backend/c_target.h"

namespace sinew::test::coupled {
namespace {

struct Case {
  unsigned joints;
  double branching;
  std::size_t directions;
  std::vector<std::string> kinds;
};

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
    const TestRobot floating = behind_a_floating_joint(robot);
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
  VectorXd expected(interpreter.out_size());
  interpreter.evaluate(in.data(), expected.data());
  for (const backend::Style style : {backend::Style::kFlat, backend::Style::kReadable}) {
    EXPECT_LT(difference(evaluated_by_c(hybrid.program(), style, in), expected), 1e-9);
  }
}

}  // namespace
}  // namespace sinew::test::coupled
