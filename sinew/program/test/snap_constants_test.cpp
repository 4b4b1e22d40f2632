#include "sinew/program/snap_constants.h"

#include <gtest/gtest.h>

namespace sinew::program {
namespace {

Variable constant(const std::string& quantity, std::vector<double> value) {
  Variable v;
  v.name = quantity;
  v.quantity = quantity;
  v.role = Role::kConstant;
  v.size = static_cast<std::uint32_t>(value.size());
  v.value = std::move(value);
  return v;
}

TEST(SnapConstants, MakesRotationsExact) {
  Program p;
  p.variables = {
      constant("pose", {6e-17, -1 + 1e-16, 0, 0.4, 1, 6e-17, 4e-15, 3e-17, 0, 0, 0.999, 0})};
  const auto snapped = snap_constants(p);
  EXPECT_EQ(p.variables[0].value, (std::vector<double>{0, -1, 0, 0.4, 1, 0, 0, 0, 0, 0, 0.999, 0}));
  ASSERT_EQ(snapped.size(), 5U);
  EXPECT_EQ(snapped[1].number, 1U);
  EXPECT_EQ(snapped[1].from, -1 + 1e-16);
  EXPECT_EQ(snapped[1].to, -1);
}

TEST(SnapConstants, KnowsSmallRobotsFromRoundOff) {
  // A body of a microgram beside another: nothing of it is round-off.
  Program p;
  p.variables = {constant("rigid-body-inertia", {1e-9, 1e-13, 0, 0, 1e-17, 0, 0, 1e-17, 0, 1e-17}),
                 constant("rigid-body-inertia", {2e-9, 1e-28, 0, 0, 1e-17, 0, 0, 1e-17, 0, 1e-17})};
  EXPECT_EQ(snap_constants(p).size(), 1U);
  EXPECT_EQ(p.variables[0].value[4], 1e-17);
  EXPECT_EQ(p.variables[1].value[1], 0.0);
}

TEST(SnapConstants, KeepsALightBodyBesideAHeavyOne) {
  Program p;
  p.variables = {
      constant("rigid-body-inertia", {1e6, 1e7, 0, 0, 1e8, 0, 0, 1e8, 0, 1e8}),
      constant("rigid-body-inertia", {1e-3, 1e-6, 0, 1e-18, 1e-9, 1e-16, 1e-24, 1e-9, 0, 1e-9})};
  const auto snapped = snap_constants(p);
  ASSERT_EQ(snapped.size(), 2U);  // 1e-15 m beside an axis, and 1e-15 of the moments
  EXPECT_EQ(snapped[0].number, 3U);
  EXPECT_EQ(snapped[1].number, 6U);
}

TEST(SnapConstants, MeasuresLengthsByTheRobotWhereItIsShorterThanAMetre) {
  Program p;
  p.variables = {constant("pose", {1, 0, 0, 1e-7, 0, 1, 0, 1e-20, 0, 0, 1, 1e-22})};
  const auto snapped = snap_constants(p);
  ASSERT_EQ(snapped.size(), 1U);
  EXPECT_EQ(snapped[0].number, 11U);
  p.variables = {constant("pose", {1, 0, 0, 1e9, 0, 1, 0, 1e-13, 0, 0, 1, 1e-15})};
  ASSERT_EQ(snap_constants(p).size(), 1U);
  EXPECT_EQ(p.variables[0].value[7], 1e-13);
}

TEST(SnapConstants, MeasuresATwistByItself) {
  Program p;
  p.variables = {constant("acceleration-twist", {0, 0, 0, 6e-16, -1e-20, 9.81})};
  snap_constants(p);
  EXPECT_EQ(p.variables[0].value, (std::vector<double>{0, 0, 0, 0, 0, 9.81}));
}

TEST(SnapConstants, LeavesWhatItDoesNotKnow) {
  Program p;
  p.variables = {constant("gain", {1e-17, 1.0 + 1e-15})};
  p.variables.push_back(constant("pose", std::vector<double>(12, 1e-16)));
  p.variables.back().role = Role::kState;
  EXPECT_TRUE(snap_constants(p).empty());
}

}  // namespace
}  // namespace sinew::program
