// Values in memory: the layouts of docs/architecture.md, and the C support library that reads them.
#include "sinew/math/layout.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "sinew/math/sinew_math.h"

namespace sinew::math {
namespace {

template <typename T>
void expect_round_trip() {
  std::array<double, Layout<T>::kSize> numbers{};
  std::iota(numbers.begin(), numbers.end(), 1.0);
  std::array<double, Layout<T>::kSize> again{};
  Layout<T>::store(Layout<T>::load(numbers.data()), again.data());
  EXPECT_EQ(numbers, again);
}

TEST(Layout, StoresWhatItLoads) {
  expect_round_trip<double>();
  expect_round_trip<Pose<double>>();
  expect_round_trip<VelocityTwist<double>>();
  expect_round_trip<AccelerationTwist<double>>();
  expect_round_trip<Wrench<double>>();
  expect_round_trip<RigidBodyInertia<double>>();
  expect_round_trip<ArticulatedInertia<double>>();
}

TEST(Layout, PutsThePositionInTheFourthColumnOfAPose) {
  const std::array<double, 12> X = {1, 0, 0, 7, 0, 1, 0, 8, 0, 0, 1, 9};
  const Pose<double> pose = Layout<Pose<double>>::load(X.data());
  EXPECT_EQ(pose.p.x, 7);
  EXPECT_EQ(pose.p.y, 8);
  EXPECT_EQ(pose.p.z, 9);
  EXPECT_EQ(pose.R.yy, 1);
}

TEST(SupportLibrary, ComposesPosesInPlainC) {
  const std::array<double, 12> X_AB = {0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3};
  const std::array<double, 12> X_BC = {1, 0, 0, 4, 0, 1, 0, 5, 0, 0, 1, 6};
  std::array<double, 12> X_AC{};
  sinew_compose_pose(X_AB.data(), X_BC.data(), X_AC.data());
  EXPECT_EQ(X_AC, (std::array<double, 12>{0, -1, 0, -4, 1, 0, 0, 6, 0, 0, 1, 9}));
}

}  // namespace
}  // namespace sinew::math
