// Clones: isolated in both directions, at any depth, whoever writes.
#include <gtest/gtest.h>

#include <random>

#include "random_poses.h"
#include "sinew/world/edit.h"
#include "sinew/world/world.h"
#include "times_and_places.h"

namespace sinew::world {
namespace {

Pose at_x(double x) { return {{}, {x, 0, 0}}; }

struct Scene {
  World world;
  FrameId a = world.add_frame("http://x/a"), b = world.add_frame("http://x/b");
  RelationId relation = world.add_relation({.name = "http://x/r", .of = b, .with_respect_to = a});
  MeasurementId m = world.add_measurement({.name = "http://x/m", .relation = relation});
};

double x_of(const World& world, const Scene& s, double now) {
  return world.pose(s.b, s.a, at_s(now)).pose.p.x;
}

TEST(Clone, SeesNothingOfWhatIsWrittenLaterOnEitherSide) {
  Scene s;
  s.world.write(s.m, at_s(1), at_x(1), {});
  World clone = s.world.clone();
  s.world.write(s.m, at_s(2), at_x(2), {});
  EXPECT_EQ(x_of(clone, s, 2), 1);
  EXPECT_EQ(x_of(s.world, s, 2), 2);
  clone.write(s.m, at_s(2), at_x(-2), {});
  EXPECT_EQ(x_of(clone, s, 2), -2);
  EXPECT_EQ(x_of(s.world, s, 2), 2);
  // The past is shared until it is corrected.
  clone.write(s.m, at_s(1), at_x(-1), {});
  EXPECT_EQ(clone.at(s.m, at_s(1)).values[4], -1);
  EXPECT_EQ(s.world.at(s.m, at_s(1)).values[4], 1);
  s.world.write(s.m, at_s(1), at_x(10), {});
  EXPECT_EQ(clone.at(s.m, at_s(1)).values[4], -1);
  EXPECT_EQ(s.world.at(s.m, at_s(1)).values[4], 10);
}

TEST(Clone, HasAStructureOfItsOwn) {
  Scene s;
  s.world.write(s.m, at_s(1), at_x(1), {});
  World clone = s.world.clone();
  const FrameId c = clone.add_frame("http://x/c");
  clone.attach(s.b, s.a, at_s(1), "planner");
  clone.add_static("http://x/c-in-b", c, s.b, at_x(5), "planner");
  EXPECT_EQ(clone.pose(c, s.a, at_s(1)).pose.p.x, 6);
  EXPECT_FALSE(s.world.find_frame("http://x/c"));
  EXPECT_FALSE(s.world.state().relations[s.relation.index].suspended);
  s.world.remove(s.b);
  EXPECT_EQ(clone.pose(c, s.a, at_s(1)).pose.p.x, 6);
}

TEST(Clone, OutlivesItsOriginal) {
  auto s = std::make_unique<Scene>();
  s->world.write(s->m, at_s(1), at_x(1), {});
  World clone = s->world.clone();
  const FrameId a = s->a, b = s->b;
  const MeasurementId m = s->m;
  s.reset();
  EXPECT_EQ(clone.pose(b, a, at_s(1)).pose.p.x, 1);
  clone.write(m, at_s(2), at_x(2), {});
  EXPECT_EQ(clone.pose(b, a, at_s(2)).pose.p.x, 2);
}

TEST(Clone, OfAHandlesMeasurementKeepsItsHistory) {
  Scene s;
  Writer writer = s.world.claim(s.m, {"robot"});
  std::vector<World> clones;
  // Every clone sees the entries from before it, whatever comes after; handles never allocate for
  // it.
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < 3; ++i) {
      const double t = 3 * round + i;
      ASSERT_EQ(writer.write(at_s(t), at_x(t)), Status::kOk);
    }
    clones.push_back(s.world.clone());
  }
  for (int round = 0; round < 20; ++round) {
    const World& clone = clones[static_cast<std::size_t>(round)];
    EXPECT_EQ(x_of(clone, s, 1000), 3 * round + 2) << round;
    EXPECT_EQ(clone.at(s.m, at_s(1.5)).values[4], 1.5);
    EXPECT_EQ(clone.at(s.m, at_s(3 * round + 2.5)).status, Status::kTooNew);
  }
}

TEST(Clone, RingsAreUsedAgainWhenNobodySeesThemAnyMore) {
  Scene s;
  Writer writer = s.world.claim(s.m, {"robot"});
  for (int i = 0; i < 1000; ++i) {
    const World clone = s.world.clone();
    writer.write(at_s(i), at_x(i));
    if (i > 0) {
      EXPECT_EQ(x_of(clone, s, i), i - 1);
    }
  }
  EXPECT_LT(s.world.state().measurements[s.m.index].cell->rings(), 8u);
}

// Random writes, corrections, clones of clones and their ends, against plain copies.
TEST(Clone, RandomHistoriesStayApart) {
  std::mt19937_64 random(9);
  for (int run = 0; run < 30; ++run) {
    Scene s;
    struct Copy {
      World world;
      double expected;
      double last;
    };
    std::vector<Copy> worlds;
    worlds.push_back({std::move(s.world), 0, 0});
    worlds[0].world.write(s.m, at_s(0), at_x(0), {});
    for (int step = 0; step < 200; ++step) {
      Copy& copy = worlds[random() % worlds.size()];
      switch (random() % 4) {
        case 0:
        case 1: {
          const double value = static_cast<double>(random() % 1000);
          copy.last += 1;
          ASSERT_EQ(copy.world.write(s.m, at_s(copy.last), at_x(value), {}), Status::kOk);
          copy.expected = value;
          break;
        }
        case 2:
          if (worlds.size() < 12) worlds.push_back({copy.world.clone(), copy.expected, copy.last});
          break;
        default:
          if (worlds.size() > 1)
            worlds.erase(worlds.begin() + static_cast<std::ptrdiff_t>(random() % worlds.size()));
          break;
      }
      for (const Copy& each : worlds) {
        ASSERT_EQ(x_of(each.world, s, 1e6), each.expected) << run << " " << step;
      }
    }
  }
}

}  // namespace
}  // namespace sinew::world
