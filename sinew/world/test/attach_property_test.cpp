// Random attaching and detaching over random trees: nothing moves by it in the world, what is
// carried moves with its carrier, and a clone made before sees none of it.
#include <gtest/gtest.h>

#include <random>

#include "random_poses.h"
#include "sinew/base/error.h"
#include "sinew/world/edit.h"
#include "sinew/world/world.h"
#include "times_and_places.h"

namespace sinew::world {
namespace {

struct Tree {
  explicit Tree(std::mt19937_64& random) {
    frames.push_back(world.add_frame("http://x/root"));
    for (int i = 1; i <= 12; ++i) {
      const std::string number = std::to_string(i);
      frames.push_back(world.add_frame("http://x/f" + number));
      // Under the root or under what came before; four of them move.
      const FrameId parent = frames[random() % static_cast<std::size_t>(i)];
      if (i % 3 == 0) {
        world.add_static("http://x/r" + number, frames.back(), parent, random_pose(random), "me");
        continue;
      }
      const RelationId relation = world.add_relation(
          {.name = "http://x/r" + number, .of = frames.back(), .with_respect_to = parent});
      measured.push_back(
          world.add_measurement({.name = "http://x/m" + number, .relation = relation}));
      world.write(measured.back(), at_s(0), random_pose(random), {"me"});
    }
  }
  std::vector<Pose> poses(const World& in, Stamp now) const {
    std::vector<Pose> all;
    for (const FrameId frame : frames) {
      const PoseAnswer answer = in.pose(frame, frames.front(), now);
      EXPECT_EQ(answer.status, Status::kOk) << in.name(frame);
      all.push_back(answer.pose);
    }
    return all;
  }
  World world;
  std::vector<FrameId> frames;
  std::vector<MeasurementId> measured;
};

double furthest(const std::vector<Pose>& a, const std::vector<Pose>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, difference(a[i], b[i]));
  return worst;
}

TEST(Attach, RandomSequencesMoveNothingAndClonesSeeNothing) {
  std::mt19937_64 random(1);
  int attached = 0, detached = 0, refused = 0;
  for (int run = 0; run < 20; ++run) {
    Tree tree(random);
    const World clone = tree.world.clone();
    const std::vector<Pose> at_first = tree.poses(tree.world, at_s(0));
    for (int second = 1; second < 25; ++second) {
      const Stamp now = at_s(second);
      const FrameId frame = tree.frames[1 + random() % (tree.frames.size() - 1)];
      const FrameId parent = tree.frames[random() % tree.frames.size()];
      const std::vector<Pose> before = tree.poses(tree.world, now);
      const std::uint64_t structure = tree.world.structure_version();
      try {
        if (random() % 2) {
          tree.world.attach(frame, parent, now, "me");
          ++attached;
          EXPECT_LT(
              difference(tree.world.pose(frame, parent, now).pose,
                         compose(invert(before[static_cast<std::size_t>(
                                     std::find(tree.frames.begin(), tree.frames.end(), parent) -
                                     tree.frames.begin())]),
                                 before[static_cast<std::size_t>(
                                     std::find(tree.frames.begin(), tree.frames.end(), frame) -
                                     tree.frames.begin())])),
              1e-12);
        } else {
          tree.world.detach(frame, parent, now, "me");
          ++detached;
        }
      } catch (const Error&) {
        // Itself, what it carries, or not attached: then nothing has changed at all.
        EXPECT_EQ(tree.world.structure_version(), structure);
        ++refused;
      }
      ASSERT_LT(furthest(tree.poses(tree.world, now), before), 1e-12) << run << " " << second;
    }
    EXPECT_EQ(furthest(tree.poses(clone, at_s(0)), at_first), 0);
  }
  EXPECT_GT(attached, 50);
  EXPECT_GT(detached, 5);
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace sinew::world
