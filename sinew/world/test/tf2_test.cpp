// The same trees in tf2: where both have an answer it is the same one.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "random_poses.h"
#include "sinew/world/edit.h"
#include "sinew/world/world.h"
#ifdef SINEW_HAVE_TF2
#include "tf2_buffer.h"
#endif

namespace sinew::world {
namespace {

#ifndef SINEW_HAVE_TF2
TEST(Tf2, RandomTreesGiveTheSamePoses) { GTEST_SKIP() << "built without tf2 (libtf2-dev)"; }
#else

constexpr double kTolerance = 1e-12;

Tf2Numbers numbers(const Pose& X) { return {X.q.x, X.q.y, X.q.z, X.q.w, X.p.x, X.p.y, X.p.z}; }
Pose pose(const Tf2Numbers& n) { return {{n[0], n[1], n[2], n[3]}, {n[4], n[5], n[6]}}; }

// A random tree; every relation is written at its own stamps, some are static.
struct Trees {
  explicit Trees(unsigned seed) : random(seed) {
    std::uniform_int_distribution<int> count(2, 25), samples(1, 40), spacing(1, 50'000'000);
    const int frames_count = count(random);
    Edit edit = world.edit();
    for (int i = 0; i < frames_count; ++i) {
      names.push_back("http://tree/frame" + std::to_string(i));
      frames.push_back(edit.add_frame(names.back()));
      if (i == 0) continue;
      const auto parent = std::uniform_int_distribution<std::size_t>(0, frames.size() - 2)(random);
      const std::string relation_name = "http://tree/relation" + std::to_string(i);
      if (random() % 4 == 0) {
        const Pose X = random_pose(random);
        edit.add_static(relation_name, frames.back(), frames[parent], X, "x");
        buffer.set(names.back(), names[parent], 0, numbers(X), true);
        continue;
      }
      const RelationId relation = edit.add_relation(
          {.name = relation_name, .of = frames.back(), .with_respect_to = frames[parent]});
      measured.push_back({edit.add_measurement(
                              {.name = relation_name + "/m", .relation = relation, .capacity = 64}),
                          frames.size() - 1, parent});
    }
    edit.commit();
    for (const Measured& m : measured) {
      Stamp stamp = kStart + Duration(spacing(random));
      Pose X = random_pose(random);
      for (int n = samples(random); n > 0; --n) {
        EXPECT_EQ(world.write(m.measurement, stamp, X, {}), Status::kOk);
        buffer.set(names[m.of], names[m.with_respect_to], ns_of(stamp), numbers(X));
        stamp += Duration(spacing(random));
        // Small and large turns.
        X = random() % 2 == 0 ? random_pose(random)
                              : compose(X, exponential({{0.01, -0.02, 0.005}, {0.1, 0, 0}}, 1));
      }
    }
  }
  static constexpr Stamp kStart = Stamp(std::chrono::seconds(1000));
  struct Measured {
    MeasurementId measurement;
    std::size_t of, with_respect_to;
  };
  std::mt19937_64 random;
  World world;
  Tf2Buffer buffer{1000};
  std::vector<std::string> names;
  std::vector<FrameId> frames;
  std::vector<Measured> measured;
};

TEST(Tf2, RandomTreesGiveTheSamePosesLatestAndInterpolated) {
  int latest = 0, interpolated = 0, refused = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    Trees t(seed);
    std::uniform_int_distribution<std::size_t> any(0, t.frames.size() - 1);
    std::uniform_int_distribution<std::int64_t> time(0, 1'200'000'000);
    for (int i = 0; i < 60; ++i) {
      const std::size_t of = any(t.random), to = any(t.random);
      PreparedPose query =
          t.world.prepare_pose({.of = t.frames[of], .with_respect_to = t.frames[to]});
      Tf2Numbers theirs;
      const PoseAnswer common = query.latest_common();
      if (t.buffer.lookup(t.names[to], t.names[of], 0, &theirs)) {
        ASSERT_EQ(common.status, Status::kOk) << to_string(common.status);
        EXPECT_LT(difference(common.pose, pose(theirs)), kTolerance) << "seed " << seed;
        ++latest;
      } else {
        EXPECT_NE(common.status, Status::kOk);
      }
      const Stamp stamp = Trees::kStart + Duration(time(t.random));
      const PoseAnswer at = query.at(stamp);
      if (t.buffer.lookup(t.names[to], t.names[of], ns_of(stamp), &theirs)) {
        ASSERT_EQ(at.status, Status::kOk) << to_string(at.status);
        // tf2 takes its angle from acos, which loses half of the digits where rotations are close.
        EXPECT_LT(difference(at.pose, pose(theirs)), kTolerance) << "seed " << seed;
        ++interpolated;
      } else {
        EXPECT_TRUE(at.status == Status::kTooNew || at.status == Status::kTooOld);
        ++refused;
      }
    }
  }
  // Each kind was met often.
  EXPECT_GT(latest, 500);
  EXPECT_GT(interpolated, 500);
  EXPECT_GT(refused, 500);
}

#endif

}  // namespace
}  // namespace sinew::world
