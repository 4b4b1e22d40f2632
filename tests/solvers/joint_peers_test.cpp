// Joints of every kind beside libraries that no one here wrote: MuJoCo's hinges, slides and balls,
// and DART's joints of the same kinds.
#include <gtest/gtest.h>

#include <functional>

#include "dart_joints.h"
#include "model_solver.h"

namespace sinew::test {
namespace {

using Ask = std::function<PeerAnswer(const DenseState&, const VectorXd& force)>;

void expect_agreement(const TestRobot& robot, const Ask& ask, unsigned states) {
  const std::string model = turtle(robot);
  ModelSolver kinematics(model, "fpk,jacobian"), rnea(model, "rnea"), crba(model, "crba"),
      aba(model, "aba");
  const auto order = crba.order(robot);
  for (unsigned seed = 0; seed < states; ++seed) {
    const DenseState state = random_state(robot, seed);
    const VectorXd force = joined(robot, rnea.answer(robot, state), "force");
    const PeerAnswer peer = ask(state, force);
    EXPECT_LT(difference(force, peer.force), 1e-9);
    EXPECT_LT(difference(matrix(crba.answer(robot, state).at("mass-matrix"), robot.velocities),
                         peer.mass_matrix(order, order)),
              1e-9);
    // How well a mass matrix can be solved at all depends on the robot.
    const VectorXd sizes = peer.mass_matrix.jacobiSvd().singularValues();
    EXPECT_LT(difference(joined(robot, aba.answer(robot, state, force), "acceleration"),
                         peer.acceleration),
              std::max(1e-8, 1e-13 * sizes(0) / sizes(sizes.size() - 1)));
    unsigned links = 0;
    for (const auto& [name, numbers] : kinematics.answer(robot, state)) {
      const auto link = static_cast<std::size_t>(std::stoi(name.substr(name.find(".link") + 5)));
      if (name.starts_with("pose."))
        EXPECT_LT(difference(matrix(numbers, 3), peer.poses[link].matrix().topRows(3)), 1e-10);
      else
        EXPECT_LT(difference(matrix(numbers, 6), peer.jacobians[link](Eigen::all, order)), 1e-9);
      ++links;
    }
    EXPECT_GE(links, 2u);
  }
}

void expect_agreement_with_mujoco(const RandomJoints& options, unsigned states) {
  SCOPED_TRACE(testing::Message() << options.joints << " joints, seed " << options.seed);
  const TestRobot robot = random_joints(options);
  MujocoJoints mujoco(robot, kGravity);
  expect_agreement(
      robot,
      [&](const DenseState& state, const VectorXd& force) { return mujoco.ask(state, force); },
      states);
}

void expect_agreement_with_dart(const RandomJoints& options, unsigned states) {
  SCOPED_TRACE(testing::Message() << options.joints << " joints, seed " << options.seed);
  const TestRobot robot = random_joints(options);
  expect_agreement(
      robot,
      [&](const DenseState& state, const VectorXd& force) {
        return ask_dart(robot, kGravity, state, force);
      },
      states);
}

RandomJoints of_kinds(std::vector<std::string> kinds, unsigned joints, std::uint32_t seed) {
  RandomJoints options;
  options.kinds = std::move(kinds);
  options.couplings = options.rotors = false;
  options.joints = joints;
  options.seed = seed;
  return options;
}

class MujocoJointKind : public testing::TestWithParam<const char*> {};

TEST_P(MujocoJointKind, AloneAgreesWithMujoco) {
  for (const unsigned joints : {1u, 2u, 5u})
    expect_agreement_with_mujoco(of_kinds({GetParam()}, joints, 400 + joints), 20);
}

INSTANTIATE_TEST_SUITE_P(Every, MujocoJointKind,
                         testing::Values("revolute", "prismatic", "cylindrical", "planar",
                                         "universal", "spherical", "composite"),
                         [](const auto& info) { return std::string(info.param); });

class DartJointKind : public testing::TestWithParam<const char*> {};

TEST_P(DartJointKind, AloneAgreesWithDart) {
  for (const unsigned joints : {1u, 2u, 5u})
    expect_agreement_with_dart(of_kinds({GetParam()}, joints, 500 + joints), 20);
}

INSTANTIATE_TEST_SUITE_P(Every, DartJointKind,
                         testing::Values("revolute", "prismatic", "helical", "universal", "planar",
                                         "spherical", "floating"),
                         [](const auto& info) { return std::string(info.param); });

// Rotors behind gears are what MuJoCo calls armature.
TEST(JointTypes, MixedInTreesAgreeWithMujoco) {
  std::uint32_t seed = 320;
  for (const unsigned joints : {2u, 5u, 13u, 34u, 60u}) {
    RandomJoints options = of_kinds(
        {"revolute", "prismatic", "cylindrical", "planar", "universal", "spherical", "composite"},
        joints, seed++);
    options.rotors = true;
    expect_agreement_with_mujoco(options, joints > 20 ? 3 : 20);
  }
}

TEST(JointTypes, MixedInTreesAgreeWithDart) {
  for (std::uint32_t k = 0; k < 6; ++k)
    expect_agreement_with_dart(of_kinds({"revolute", "prismatic", "helical", "universal", "planar",
                                         "spherical", "floating"},
                                        2 + 3 * k, 300 + k),
                               20);
}

}  // namespace
}  // namespace sinew::test
