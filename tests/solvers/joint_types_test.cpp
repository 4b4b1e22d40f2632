// Joints of every kind, followers and rotors: every solver beside dense matrices.
#include <gtest/gtest.h>

#include "model_solver.h"
#include "sinew/backend/compile.h"
#include "sinew/program/scalar_program.h"

namespace sinew::test {
namespace {

using Solver = ModelSolver;

void expect_agreement(const TestRobot& robot, unsigned states) {
  const std::string model = turtle(robot);
  const DenseReference dense(robot, kGravity);
  Solver fpk(model, "fpk"), fvk(model, "fvk"), fak(model, "fak"), jacobian(model, "jacobian"),
      rnea(model, "rnea"), gravity(model, "gravity"), bias(model, "bias"), crba(model, "crba"),
      aba(model, "aba"), cholesky(model, "cholesky"), factors(model, "forward_cholesky");
  for (unsigned seed = 0; seed < states; ++seed) {
    const DenseState state = random_state(robot, seed);
    DenseState still = state, free = state;
    still.velocity.setZero();
    still.acceleration.setZero();
    free.acceleration.setZero();
    const VectorXd force = dense.inverse_dynamics(state);
    const auto order = crba.order(robot);
    const MatrixXd mass = dense.mass_matrix(state.position)(order, order);

    const auto poses = fpk.answer(robot, state), twists = fvk.answer(robot, state),
               rates = fak.answer(robot, state), jacobians = jacobian.answer(robot, state);
    for (const auto& [name, pose] : poses) {
      const std::string frame = name.substr(name.find('.') + 1);  // linkK-root
      const int link = std::stoi(frame.substr(4));
      const MatrixXd J = dense.jacobian(state.position, link);
      const MatrixXd in_order = J(Eigen::all, order);
      EXPECT_LT(difference(matrix(pose, 3), dense.pose(state.position, link).matrix().topRows(3)),
                1e-10)
          << name;
      EXPECT_LT(difference(twists.at("twist." + frame), J * state.velocity), 1e-9) << name;
      EXPECT_LT(difference(rates.at("acceleration-twist." + frame),
                           J * state.acceleration + dense.jacobian_rate(state, link)),
                1e-8)
          << name;
      EXPECT_LT(difference(matrix(jacobians.at("jacobian." + frame), 6), in_order), 1e-9) << name;
    }
    EXPECT_LT(difference(joined(robot, rnea.answer(robot, state), "force"), force), 1e-8);
    EXPECT_LT(difference(joined(robot, gravity.answer(robot, state), "gravity-force"),
                         dense.inverse_dynamics(still)),
              1e-8);
    EXPECT_LT(difference(joined(robot, bias.answer(robot, state), "bias-force"),
                         dense.inverse_dynamics(free)),
              1e-8);
    EXPECT_LT(
        difference(matrix(crba.answer(robot, state).at("mass-matrix"), robot.velocities), mass),
        1e-9);
    // How well a mass matrix can be solved at all depends on the robot.
    const double condition = mass.jacobiSvd().singularValues()(0) /
                             mass.jacobiSvd().singularValues()(robot.velocities - 1);
    const double tolerance = std::max(1e-8, 1e-13 * condition);
    EXPECT_LT(difference(joined(robot, aba.answer(robot, state, force), "acceleration"),
                         state.acceleration),
              tolerance);
    EXPECT_LT(difference(joined(robot, factors.answer(robot, state, force), "acceleration"),
                         state.acceleration),
              tolerance);
    const MatrixXd L =
        matrix(cholesky.answer(robot, state).at("cholesky-factor"), robot.velocities);
    EXPECT_LT(difference(L.transpose() * L, mass), 1e-9);
    EXPECT_TRUE(L.isLowerTriangular(0));
  }
}

class JointKind : public testing::TestWithParam<const char*> {};

TEST_P(JointKind, AloneAgreesWithDenseMatrices) {
  RandomJoints options;
  options.kinds = {GetParam()};
  options.couplings = options.rotors = false;
  for (const unsigned joints : {1u, 2u, 5u}) {
    options.joints = joints;
    options.seed = joints;
    SCOPED_TRACE(testing::Message() << joints << " joints");
    expect_agreement(random_joints(options), 5);
  }
}

INSTANTIATE_TEST_SUITE_P(Every, JointKind,
                         testing::Values("revolute", "prismatic", "helical", "cylindrical",
                                         "planar", "universal", "spherical", "floating",
                                         "composite"),
                         [](const auto& info) { return std::string(info.param); });

TEST(JointTypes, MixedInTreesAgreeWithDenseMatrices) {
  unsigned seed = 100;
  for (const unsigned joints : {2u, 3u, 8u, 21u, 60u}) {
    RandomJoints options;
    options.joints = joints;
    options.couplings = false;
    options.rotors = false;
    options.kinds = {"revolute",  "prismatic", "cylindrical", "planar",
                     "universal", "spherical", "floating",    "composite"};
    options.seed = seed++;
    SCOPED_TRACE(testing::Message() << joints << " joints, seed " << options.seed);
    expect_agreement(random_joints(options), 2);
  }
}

TEST(JointTypes, WithFollowersAndRotorsAgreeWithDenseMatrices) {
  unsigned seed = 200;
  for (const unsigned joints : {2u, 3u, 5u, 8u, 13u, 25u}) {
    RandomJoints options;
    options.joints = joints;
    options.seed = seed++;
    SCOPED_TRACE(testing::Message() << joints << " joints, seed " << options.seed);
    expect_agreement(random_joints(options), 3);
  }
}

TEST(JointTypes, RotorsAloneLeaveTheArticulatedBodyAlgorithm) {
  RandomJoints options;
  options.couplings = false;
  options.kinds = {"revolute", "prismatic"};
  options.seed = 7;
  const TestRobot robot = random_joints(options);
  expect_agreement(robot, 5);
  const Solver aba(turtle(robot), "aba");
  bool by_bodies = false;
  for (const program::Closure& closure : aba.program().closures)
    by_bodies |= closure.operation == "project-articulated-body-inertia";
  EXPECT_TRUE(by_bodies);
}

// A floating base is a floating joint between the world and the first link.
TEST(JointTypes, OnAFloatingBaseAreThoseBehindAFloatingJoint) {
  RandomJoints options;
  options.joints = 9;
  options.seed = 220;
  const TestRobot robot = random_joints(options);
  const TestRobot behind = behind_a_floating_joint(robot);
  const std::string free = turtle(robot), fixed = turtle(behind);
  for (const char* name : {"rnea", "aba", "crba", "gravity", "bias", "forward_cholesky"}) {
    SCOPED_TRACE(name);
    Solver one(free, name, true), other(fixed, name);
    for (unsigned seed = 0; seed < 3; ++seed) {
      const DenseState state = random_state(behind, seed);
      const auto expected = other.answer(behind, state, state.acceleration);
      for (const auto& [result, numbers] : one.answer(behind, state, state.acceleration)) {
        const bool of_base = result.ends_with(".link0");
        const std::string same = of_base ? result.substr(0, result.find('.')) + ".base" : result;
        EXPECT_LT(difference(numbers, expected.at(same)), 1e-8) << result;
      }
    }
  }
}

// Flat and readable C, and the machine code that is made in this process.
TEST(JointTypes, AreTheSameFromEveryBackEnd) {
  RandomJoints options;
  options.joints = 8;
  options.seed = 211;
  const TestRobot robot = random_joints(options);
  const std::string model = turtle(robot);
  for (const char* name : {"rnea", "aba", "crba", "cholesky", "jacobian"}) {
    SCOPED_TRACE(name);
    const Solver solver(model, name);
    const DenseState state = random_state(robot, 3);
    const std::vector<double> in = solver.inputs(robot, state, state.acceleration);
    backend::Interpreter interpreter(solver.program());
    VectorXd expected(interpreter.out_size()), out(interpreter.out_size());
    interpreter.evaluate(in.data(), expected.data());
    for (const backend::Style style : {backend::Style::kFlat, backend::Style::kReadable})
      EXPECT_LT(difference(evaluated_by_c(solver.program(), style, in), expected), 1e-9)
          << (style == backend::Style::kFlat);
    if (!backend::jit_available()) continue;
    const auto jit = backend::jit_compile(program::scalar_program(solver.program()).computation,
                                          {backend::JitLevel::kFast, ""});
    jit(in.data(), out.data());
    EXPECT_LT(difference(out, expected), 1e-9) << "JIT";
  }
}

// An entry of L is zero wherever two joints are on different branches, so sparse solves cost less.
TEST(JointTypes, FactorsAreAsSparseAsTheTree) {
  TestRobot robot = random_joints(
      {.joints = 6, .couplings = false, .rotors = false, .seed = 3, .kinds = {"revolute"}});
  for (std::size_t k = 0; k < robot.joints.size(); ++k)
    robot.joints[k].parent = k < 3 ? static_cast<int>(k) : k == 3 ? 0 : static_cast<int>(k);
  Solver cholesky(turtle(robot), "cholesky");
  const MatrixXd L = matrix(cholesky.answer(robot, random_state(robot, 1)).at("cholesky-factor"),
                            robot.velocities);
  EXPECT_TRUE((L.bottomLeftCorner(3, 3).array() == 0).all());
  EXPECT_TRUE((L.diagonal().array() > 0).all());
}

}  // namespace
}  // namespace sinew::test
