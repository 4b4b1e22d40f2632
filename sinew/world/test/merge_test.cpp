// Differences of a world and its clone, and bringing a clone's changes back.
#include <gtest/gtest.h>

#include <algorithm>

#include "random_poses.h"
#include "sinew/world/clone.h"
#include "sinew/world/edit.h"
#include "times_and_places.h"

namespace sinew::world {
namespace {

using Kind = Difference::Kind;

Pose at_x(double x) { return {{}, {x, 0, 0}}; }

struct Cell2 {
  World world;
  FrameId table = world.add_frame("http://x/table");
  FrameId part = world.add_frame("http://x/part");
  FrameId gripper = world.add_frame("http://x/gripper");
  RelationId lies =
      world.add_relation({.name = "http://x/lies", .of = part, .with_respect_to = table});
  MeasurementId seen = world.add_measurement({.name = "http://x/seen", .relation = lies});
  RelationId arm =
      world.add_relation({.name = "http://x/arm", .of = gripper, .with_respect_to = table});
  MeasurementId position = world.add_measurement({.name = "http://x/position", .relation = arm});
  Cell2() {
    world.write(seen, at_s(1), at_x(1), {});
    world.write(position, at_s(1), at_x(0.5), {});
  }
};

bool contains(const std::vector<Difference>& all, const Difference& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

std::string conflict(World& world, const World& clone) {
  try {
    merge(world, clone);
  } catch (const Error& error) {
    return error.what();
  }
  return "no conflict";
}

TEST(Difference, OfACloneThatDidNothingIsNone) {
  Cell2 c;
  const World clone = c.world.clone();
  EXPECT_TRUE(differences(c.world, clone).empty());
}

TEST(Merge, BringsBackAPlannedPick) {
  Cell2 c;
  World clone = c.world.clone();
  clone.attach(c.part, c.gripper, at_s(2), "planner");
  clone.write(c.position, at_s(3), at_x(5), {});
  clone.add_frame("http://x/grasp");
  const Pose planned = clone.pose(c.part, c.table, at_s(3)).pose;
  const auto found = differences(c.world, clone);
  EXPECT_TRUE(contains(found, {Kind::kAdded, ElementKind::kFrame, "http://x/grasp"}));
  EXPECT_TRUE(contains(found, {Kind::kChanged, ElementKind::kRelation, "http://x/lies"}));
  EXPECT_TRUE(contains(found, {Kind::kWritten, ElementKind::kMeasurement, "http://x/position"}));
  EXPECT_TRUE(
      contains(found, {Kind::kAdded, ElementKind::kRelation, "http://x/part/attached-to/gripper"}));
  // The original goes on elsewhere meanwhile.
  c.world.add_frame("http://x/elsewhere");
  const auto applied = merge(c.world, clone);
  EXPECT_EQ(applied.size(), found.size());
  EXPECT_LT(difference(c.world.pose(c.part, c.table, at_s(3)).pose, planned), 1e-12);
  EXPECT_TRUE(c.world.find_frame("http://x/grasp"));
  EXPECT_TRUE(c.world.find_frame("http://x/elsewhere"));
  // And then it is the original's: the clone does not follow.
  c.world.write(c.position, at_s(4), at_x(7), {});
  EXPECT_NEAR(clone.pose(c.gripper, c.table, at_s(4)).pose.p.x, 5, 0);
}

TEST(Merge, RemovesWhatTheCloneRemoved) {
  Cell2 c;
  World clone = c.world.clone();
  clone.remove(c.part);
  merge(c.world, clone);
  EXPECT_FALSE(c.world.find_frame("http://x/part"));
  EXPECT_FALSE(c.world.find_measurement("http://x/seen"));
  EXPECT_TRUE(c.world.find_frame("http://x/gripper"));
}

TEST(Merge, NamesEveryConflictAndChangesNothing) {
  Cell2 c;
  World clone = c.world.clone();
  clone.write(c.seen, at_s(2), at_x(2), {});
  clone.add_frame("http://x/new");
  clone.attach(c.gripper, c.table, at_s(2), "planner");
  c.world.write(c.seen, at_s(2), at_x(-2), {});
  c.world.add_frame("http://x/new");
  const std::uint64_t version = c.world.structure_version();
  const std::string said = conflict(c.world, clone);
  EXPECT_NE(said.find("http://x/seen: written in the clone and in the original"),
            std::string::npos);
  EXPECT_NE(said.find("http://x/new: added in the clone and in the original"), std::string::npos);
  EXPECT_EQ(c.world.structure_version(), version);
  EXPECT_FALSE(c.world.state().relations[c.arm.index].suspended);
  EXPECT_NEAR(c.world.latest(c.seen, at_s(3)).values[4], -2, 0);
}

TEST(Merge, OnlyIntoTheOriginal) {
  Cell2 c;
  World clone = c.world.clone();
  World other;
  EXPECT_NE(conflict(other, clone).find("not cloned from"), std::string::npos);
  World of_clone = clone.clone();
  EXPECT_NE(conflict(c.world, of_clone).find("not cloned from"), std::string::npos);
  EXPECT_EQ(conflict(clone, of_clone), "no conflict");
}

}  // namespace
}  // namespace sinew::world
