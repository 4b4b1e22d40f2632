// An update touches what has changed, and what it does not touch is as if it had been asked anew:
// poses, freshness, and what is found, after writes, corrections, predictions, expiry and edits.
#include <gtest/gtest.h>

#include <random>

#include "random_poses.h"
#include "sinew/world/edit.h"
#include "sinew/world/space.h"

namespace sinew::world {
namespace {

Stamp at_ms(std::int64_t ms) { return stamp_of_ns(1'000'000 * ms); }

TEST(SpaceUpdate, IsAsIfEverythingWereAskedAnew) {
  std::mt19937_64 random(3);
  for (const Policy policy : {Policy::kInform, Policy::kFilter}) {
    World world;
    const FrameId hall = world.add_frame("http://x/hall");
    std::vector<FrameId> frames;
    std::vector<MeasurementId> seen;
    Space space(world, hall, policy);
    std::vector<BodyId> bodies;
    for (int i = 0; i < 40; ++i) {
      const std::string number = std::to_string(i);
      frames.push_back(world.add_frame("http://x/frame" + number));
      // Every fourth hangs on the one before.
      const FrameId parent = i % 4 == 3 ? frames[static_cast<std::size_t>(i - 1)] : hall;
      MeasurementModel model;
      if (i % 5 == 1) model.life_cycle = TimeDependent{.validity = std::chrono::milliseconds(30)};
      if (i % 5 == 2) model.period = std::chrono::milliseconds(7);
      if (i % 5 == 4) {
        model.life_cycle = Prediction{ConstantVelocity{.twist = Twist{{0, 0, 1}, {1, 0, 0}}},
                                      std::chrono::milliseconds(50)};
      }
      seen.push_back(world.add_measurement(
          {.name = "http://x/seen" + number,
           .relation = world.add_relation(
               {.name = "http://x/r" + number, .of = frames.back(), .with_respect_to = parent}),
           .model = model}));
      bodies.push_back(space.add(frames.back(), {{Box{{0.2, 0.2, 0.2}}, {}}}));
    }
    std::int64_t now = 100;
    for (int round = 0; round < 400; ++round) {
      if (random() % 10 == 0) now -= 3;
      now += static_cast<std::int64_t>(random() % 6);
      for (std::size_t k = random() % 3; k > 0; --k) {
        // Some of the past, and some of what is to come.
        const auto stamp = now + static_cast<std::int64_t>(random() % 12) - 8;
        world.write(seen[random() % 30], at_ms(stamp), random_pose(random), {});
      }
      if (round % 50 == 20) world.add_frame("http://x/other" + std::to_string(round));
      if (round == 200) world.remove(seen[35]);
      space.update(at_ms(now));
      std::size_t placed = 0;
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        PoseAnswer expected =
            world.prepare_pose({.of = hall, .with_respect_to = frames[i], .policy = policy})
                .latest(at_ms(now));
        expected.pose = invert(expected.pose);
        const PoseAnswer found = space.pose(bodies[i]);
        ASSERT_EQ(found.status, expected.status) << round << " " << i;
        ASSERT_EQ(space.is_placed(bodies[i]), expected.status == Status::kOk);
        if (!expected) continue;
        ++placed;
        ASSERT_EQ(difference(found.pose, expected.pose), 0) << round << " " << i;
        ASSERT_EQ(found.freshness.currency, expected.freshness.currency) << round << " " << i;
        ASSERT_EQ(found.freshness.timeliness, expected.freshness.timeliness);
        ASSERT_EQ(found.freshness.obsolescence, expected.freshness.obsolescence) << i;
        ASSERT_EQ(found.freshness.rate, expected.freshness.rate) << round << " " << i;
        ASSERT_EQ(found.freshness.expires, expected.freshness.expires);
      }
      const RegionAnswer all = space.within(hall, {{Sphere{1e6}, {}}}, Match::kInside);
      ASSERT_EQ(all.bodies.size(), placed);
      ASSERT_EQ(all.unplaced.size(), bodies.size() - placed);
    }
  }
}

TEST(SpaceUpdate, CountsWhatMoved) {
  World world;
  const FrameId hall = world.add_frame("http://x/hall");
  std::vector<MeasurementId> seen;
  Space space(world, hall);
  for (int i = 0; i < 10; ++i) {
    const std::string number = std::to_string(i);
    const FrameId frame = world.add_frame("http://x/frame" + number);
    seen.push_back(world.add_measurement(
        {.name = "http://x/seen" + number,
         .relation = world.add_relation(
             {.name = "http://x/r" + number, .of = frame, .with_respect_to = hall})}));
    space.add(frame, {{Box{{0.2, 0.2, 0.2}}, {}}});
    world.write(seen.back(), at_ms(1), Pose{{}, {1.0 * i, 0, 0}}, {});
  }
  EXPECT_EQ(space.update(at_ms(1)).moved, 10u);
  EXPECT_EQ(space.update(at_ms(2)).moved, 0u);
  world.write(seen[3], at_ms(3), Pose{{}, {3, 1, 0}}, {});
  world.write(seen[4], at_ms(3), Pose{{}, {4, 0, 0}}, {});  // where it was
  EXPECT_EQ(space.update(at_ms(3)).moved, 1u);
  {
    Writer writer = world.claim(seen[5], {"x"});
    writer.write(at_ms(4), Pose{{}, {5, 1, 0}});
    EXPECT_EQ(space.update(at_ms(4)).moved, 1u);
    writer.correct(at_ms(4), Pose{{}, {5, 2, 0}});
    EXPECT_EQ(space.update(at_ms(4)).moved, 1u);
  }
}

}  // namespace
}  // namespace sinew::world
