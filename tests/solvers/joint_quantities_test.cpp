// Everything that can be asked of a robot with joints of every kind, followers and gears, beside
// dense matrices; and what must hold between the answers, whatever the joints are.
#include <gtest/gtest.h>

#include "dense_whole.h"
#include "model_solver.h"

namespace sinew::test {
namespace {

using Answers = std::map<std::string, VectorXd>;

TestRobot random_tree(unsigned joints, std::uint32_t seed) {
  RandomJoints options;
  options.joints = joints;
  options.seed = seed;
  return random_joints(options);
}

cli::QueryOptions question(const std::string& solver, std::vector<std::string> ask = {}) {
  cli::QueryOptions query;
  query.solver = solver;
  query.ask = std::move(ask);
  return query;
}

std::vector<int> links_of(const Answers& answers, const std::string& quantity) {
  std::vector<int> links;
  for (const auto& [name, numbers] : answers)
    if (name.starts_with(quantity + ".link"))
      links.push_back(std::stoi(name.substr(quantity.size() + 5)));
  return links;
}

void expect_wholes(const TestRobot& robot, const Answers& found, const DenseWhole& expected,
                   const DenseState& state, const std::vector<Eigen::Index>& order) {
  const MatrixXd A = expected.centroidal_momentum_matrix;
  EXPECT_LT(difference(found.at("center-of-mass"), expected.center_of_mass), 1e-10);
  EXPECT_LT(
      difference(found.at("center-of-mass-velocity"), expected.center_jacobian * state.velocity),
      1e-9);
  EXPECT_LT(difference(matrix(found.at("center-of-mass-jacobian"), 3),
                       expected.center_jacobian(Eigen::all, order)),
            1e-9);
  EXPECT_LT(difference(found.at("momentum"), expected.momentum_matrix * state.velocity), 1e-9);
  EXPECT_LT(difference(found.at("centroidal-momentum"), A * state.velocity), 1e-9);
  EXPECT_LT(difference(matrix(found.at("centroidal-momentum-matrix"), 6), A(Eigen::all, order)),
            1e-9);
  EXPECT_LT(difference(matrix(found.at("centroidal-momentum-matrix"), 6) * state.velocity(order),
                       found.at("centroidal-momentum")),
            1e-9);
  EXPECT_NEAR(found.at("potential-energy")[0], expected.potential_energy,
              1e-9 * std::max(1.0, std::abs(expected.potential_energy)));
  EXPECT_EQ(robot.velocities, A.cols());
}

void expect_frames(const TestRobot& robot, const DenseReference& dense, const Answers& found,
                   const DenseState& state, const std::vector<Eigen::Index>& order) {
  for (const int link : links_of(found, "analytic-jacobian")) {
    const std::string name = ".link" + std::to_string(link) + "-root";
    SCOPED_TRACE(name);
    EXPECT_LT(difference(found.at("position-and-quaternion" + name),
                         position_and_quaternion(dense, state.position, link)),
              1e-9);
    const MatrixXd analytic =
        analytic_jacobian(dense, state.position, robot.velocities, link)(Eigen::all, order);
    EXPECT_LT(difference(matrix(found.at("analytic-jacobian" + name), 7), analytic), 1e-8);
    EXPECT_LT(difference(found.at("jacobian-rate-times-velocity" + name),
                         dense.jacobian_rate(state, link)),
              1e-8);
  }
}

TEST(JointTypes, EveryQuantityAgreesWithDenseMatrices) {
  std::uint32_t seed = 600;
  for (const unsigned joints : {1u, 2u, 3u, 5u, 9u, 17u, 30u}) {
    const TestRobot robot = random_tree(joints, ++seed);
    SCOPED_TRACE(testing::Message() << joints << " joints, seed " << seed);
    const std::string model = turtle(robot);
    const DenseReference dense(robot, kGravity);
    ModelSolver all(
        model,
        question("com,momentum,energy,rnea",
                 {"analytic-jacobian of every-tip", "position-and-quaternion of every-tip",
                  "jacobian-rate-times-velocity of every-tip", "joint-wrench of every-joint"}));
    const auto order = all.order(robot);
    for (unsigned k = 0; k < (joints > 10 ? 1u : 3u); ++k) {
      const DenseState state = random_state(robot, k);
      const Answers found = all.answer(robot, state);
      expect_wholes(robot, found, whole(robot, dense, kGravity, state.position), state, order);
      expect_frames(robot, dense, found, state, order);
      const MatrixXd mass = dense.mass_matrix(state.position);
      double rotors = 0;  // the energy of what turns behind gears is no link's
      for (const TestJoint& j : robot.joints)
        if (j.rotor > 0)
          rotors +=
              0.5 * j.rotor *
              std::pow(j.gear * j.motions[0].ratio * state.velocity[j.motions[0].coordinate], 2);
      EXPECT_NEAR(found.at("kinetic-energy")[0] + rotors,
                  0.5 * state.velocity.dot(mass * state.velocity),
                  1e-9 * std::max(1.0, found.at("kinetic-energy")[0]));
      const auto wrenches = body_wrenches(robot, dense, kGravity, state);
      for (std::size_t j = 0; j < robot.joints.size(); ++j) {
        const TestJoint& joint = robot.joints[j];
        EXPECT_LT(difference(found.at("joint-wrench." + joint.name),
                             joint_wrench(robot, dense, wrenches, state.position, j)),
                  1e-8)
            << joint.name << ", " << joint.kind;
      }
    }
  }
}

// Asked in one program, quantities are computed from each other; apart, they are not.
TEST(JointTypes, WhatIsAskedTogetherIsWhatIsAskedApart) {
  std::uint32_t seed = 640;
  for (const unsigned joints : {1u, 3u, 8u, 20u}) {
    const TestRobot robot = random_tree(joints, ++seed);
    SCOPED_TRACE(testing::Message() << joints << " joints, seed " << seed);
    const std::string model = turtle(robot);
    const char* const names[] = {"fpk", "fvk", "jacobian", "rnea", "bias", "gravity", "crba"};
    ModelSolver together(model, "fpk,fvk,jacobian,rnea,bias,gravity,crba");
    const DenseState state = random_state(robot, 5);
    const Answers found = together.answer(robot, state);
    for (const char* name : names)
      for (const auto& [output, numbers] : ModelSolver(model, name).answer(robot, state))
        EXPECT_LT(difference(found.at(output), numbers), 1e-10) << name << ": " << output;
  }
}

TEST(JointTypes, MassTimesAccelerationAndBiasIsForceAndForwardDynamicsUndoesIt) {
  std::uint32_t seed = 660;
  for (const unsigned joints : {2u, 7u, 20u, 60u}) {
    const TestRobot robot = random_tree(joints, ++seed);
    SCOPED_TRACE(testing::Message() << joints << " joints, seed " << seed);
    const std::string model = turtle(robot);
    ModelSolver rnea(model, "rnea"), bias(model, "bias"), crba(model, "crba"), aba(model, "aba");
    const auto order = crba.order(robot);
    for (unsigned k = 0; k < 5; ++k) {
      const DenseState state = random_state(robot, k);
      const VectorXd force = joined(robot, rnea.answer(robot, state), "force");
      const VectorXd h = joined(robot, bias.answer(robot, state), "bias-force");
      const MatrixXd M = matrix(crba.answer(robot, state).at("mass-matrix"), robot.velocities);
      EXPECT_LT(difference(M * state.acceleration(order) + h(order), force(order)), 1e-9);
      const VectorXd sizes = M.jacobiSvd().singularValues();
      EXPECT_LT(difference(joined(robot, aba.answer(robot, state, force), "acceleration"),
                           state.acceleration),
                std::max(1e-8, 1e-13 * sizes(0) / sizes(sizes.size() - 1)));
    }
  }
}

// Along a second of falling and being driven, energy grows by the work that the drives do.
// Positions move by the midpoint's velocity, on the sphere where there is a quaternion.
TEST(JointTypes, EnergyGrowsByTheWorkOfTheJointForces) {
  RandomJoints options;
  options.joints = 6;
  options.rotors = false;
  options.seed = 681;
  const TestRobot robot = random_joints(options);
  const std::string model = turtle(robot);
  const DenseReference dense(robot, kGravity);
  ModelSolver aba(model, "aba"), energy(model, "energy");
  const auto total = [&](const DenseState& at) {
    const Answers now = energy.answer(robot, at);
    return now.at("kinetic-energy")[0] + now.at("potential-energy")[0];
  };
  DenseState state = random_state(robot, 1);
  state.velocity *= 0.3;
  const VectorXd force = VectorXd::Constant(robot.velocities, 0.1);
  const double before = total(state);
  double work = 0, kinetic = 0;
  constexpr int kSteps = 4000;
  for (int step = 0; step < kSteps; ++step) {
    const double time = 1.0 / kSteps;
    const auto acceleration = [&](const DenseState& at) {
      return joined(robot, aba.answer(robot, at, force), "acceleration");
    };
    DenseState middle = state;
    middle.position = dense.moved(state.position, state.velocity, time / 2);
    middle.velocity = state.velocity + time / 2 * acceleration(state);
    const VectorXd change = acceleration(middle);
    state.position = dense.moved(state.position, middle.velocity, time);
    state.velocity += time * change;
    work += time * force.dot(middle.velocity);
    kinetic = std::max(kinetic, energy.answer(robot, state).at("kinetic-energy")[0]);
  }
  EXPECT_GT(kinetic, 1e-2);  // it did move
  EXPECT_NEAR(total(state) - before, work, 1e-4 * std::max(1.0, kinetic));
}

}  // namespace
}  // namespace sinew::test
