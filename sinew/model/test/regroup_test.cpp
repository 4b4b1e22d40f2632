// Regrouped inertial parameters give the same joint forces with fewer numbers.
#include "sinew/model/regroup.h"

#include <gtest/gtest.h>

#include <random>

#include "models.h"
#include "newton_euler.h"

namespace sinew::model::test {
namespace {

Motion random_motion(std::size_t joints, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-2, 2);
  Motion motion;
  for (auto* values : {&motion.q, &motion.qd, &motion.qdd}) {
    for (std::size_t k = 0; k < joints; ++k) values->push_back(uniform(random));
  }
  return motion;
}

class Regrouping : public testing::TestWithParam<const char*> {};

TEST_P(Regrouping, LeavesJointForcesAsTheyWere) {
  const auto file = shared() / "robots" / GetParam();
  SINEW_NEEDS(file);
  Model model;
  NormaliseOptions options;
  options.gravity = Vector3{1, 2, -9.81};
  load_and_normalise(model, {file}, options);
  ASSERT_FALSE(model.report.has_errors()) << model.problems();
  Tree regrouped = model.tree;
  regroup_inertial_parameters(regrouped);
  std::mt19937 random(1);
  for (int sample = 0; sample < 20; ++sample) {
    const Motion motion = random_motion(model.tree.joints.size(), random);
    const Dynamics before = newton_euler(model.tree, motion);
    const Dynamics after = newton_euler(regrouped, motion);
    for (std::size_t k = 0; k < motion.q.size(); ++k) {
      EXPECT_NEAR(after.forces[k], before.forces[k], 2e-13 * (1 + std::abs(before.forces[k])));
    }
  }
}

TEST_P(Regrouping, LeavesNoPartOnTheAxisOfARevoluteJoint) {
  const auto file = shared() / "robots" / GetParam();
  SINEW_NEEDS(file);
  Model model;
  load_and_normalise(model, {file});
  ASSERT_FALSE(model.report.has_errors()) << model.problems();
  regroup_inertial_parameters(model.tree);
  for (std::size_t b = 1; b < model.tree.bodies.size(); ++b) {
    const RigidBodyInertia& I = model.tree.bodies[b].inertia;
    const auto& J = I.rotational;
    if (model.tree.joints[b - 1].kind == JointKind::kRevolute) {
      EXPECT_EQ(I.mass, 0);
      EXPECT_EQ(I.first_moment.z, 0);
      EXPECT_EQ(0.5 * (J.xx + J.yy - J.zz), 0);
    } else {
      EXPECT_EQ(J.xx, 0);
      EXPECT_EQ(J.yz, 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, Regrouping,
                         testing::Values("clean/gen3.urdf", "clean/iiwa.urdf", "clean/hyq.urdf",
                                         "clean/general_7r.urdf", "panda.urdf", "baxter.urdf"));

}  // namespace
}  // namespace sinew::model::test
