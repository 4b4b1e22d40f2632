// Measurements that keep every entry, written and read in real time: wait-free writing into a log
// that a collector empties, refused and counted when it does not come; and all that is kept, read
// without a lock or an allocation.
#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "allocations.h"
#include "random_poses.h"
#include "sinew/world/collector.h"
#include "sinew/world/edit.h"

namespace sinew::world {
namespace {

Stamp at_ms(std::int64_t ms) { return stamp_of_ns(1'000'000 * ms); }
Pose at_x(double x) { return {{}, {x, 0, 0}}; }

// floor -(logged)-> cart, in a ring of 16 slots: 15 entries can be read, 14 wait for the collector.
struct Track {
  explicit Track(std::vector<std::string> users = {}) {
    floor = world.add_frame("http://x/floor");
    cart = world.add_frame("http://x/cart");
    driving =
        world.add_relation({.name = "http://x/driving", .of = cart, .with_respect_to = floor});
    logged = world.add_measurement(
        {.name = "http://x/logged",
         .relation = driving,
         .model = {.provenance = "http://x/driver", .used_by = std::move(users)},
         .capacity = 15,
         .keep_all = true});
  }
  PreparedPose query() const { return world.prepare_pose({.of = cart, .with_respect_to = floor}); }
  World world;
  FrameId floor, cart;
  RelationId driving;
  MeasurementId logged;
};

TEST(RealtimeHistory, AWriteForWhichThereIsNoRoomIsRefusedAndCounted) {
  Track track;
  Writer writer = track.world.claim(track.logged, {"http://x/driver"});
  for (int i = 0; i < 14; ++i) ASSERT_EQ(writer.write(at_ms(i), at_x(i)), Status::kOk) << i;
  EXPECT_EQ(writer.write(at_ms(14), at_x(14)), Status::kNoRoom);
  EXPECT_EQ(writer.correct(at_ms(13), at_x(-1)), Status::kNoRoom);
  EXPECT_EQ(writer.refused(), 2u);
  // Nothing of it was done.
  EXPECT_EQ(track.world.latest(track.logged, at_ms(14)).values[4], 13);
  EXPECT_EQ(track.world.collect(), 14u);
  EXPECT_EQ(track.world.collect(), 0u);
  EXPECT_EQ(writer.write(at_ms(14), at_x(14)), Status::kOk);
  const History history = track.world.history(track.logged);  // collects what there is
  ASSERT_EQ(history.size(), 15u);
  EXPECT_EQ(history[14]->values[4], 14);
  EXPECT_EQ(history[14]->provenance, "http://x/driver");
}

TEST(RealtimeHistory, WhatAHandleWroteStaysWhenItIsLetGo) {
  Track track;
  {
    Writer writer = track.world.claim(track.logged, {"http://x/driver"});
    for (int i = 0; i < 10; ++i) ASSERT_EQ(writer.write(at_ms(i), at_x(i)), Status::kOk);
  }
  for (int i = 10; i < 40; ++i) {
    track.world.write(track.logged, at_ms(i), at_x(i), {"http://x/driver"});
  }
  Writer again = track.world.claim(track.logged, {"http://x/driver"});
  ASSERT_EQ(again.write(at_ms(40), at_x(40)), Status::kOk);
  EXPECT_EQ(track.world.history(track.logged).size(), 41u);
  const PreparedPose query = track.query();
  for (std::int64_t i = 0; i < 80; ++i) {
    const PoseAnswer answer = query.at_realtime(stamp_of_ns(500'000 * i));
    ASSERT_EQ(answer.status, Status::kOk) << i;
    EXPECT_NEAR(answer.pose.p.x, static_cast<double>(i) / 2, 1e-12);
  }
}

TEST(RealtimeHistory, WritingAndReadingAllocateNothing) {
  Track track;
  Writer writer = track.world.claim(track.logged, {"http://x/driver"});
  const PreparedPose query = track.query();
  for (int i = 0; i < 1000; ++i) {
    if (i % 10 == 0) track.world.collect();
    const std::size_t before = allocations();
    ASSERT_EQ(writer.write(at_ms(i), at_x(i)), Status::kOk);
    const PoseAnswer answer = query.at_realtime(at_ms(i / 2));
    const PoseAnswer too_old = query.at_realtime(at_ms(-1));
    ASSERT_EQ(allocations(), before);
    ASSERT_EQ(answer.status, Status::kOk);
    ASSERT_EQ(answer.pose.p.x, i / 2);
    ASSERT_EQ(too_old.status, Status::kTooOld);
    ASSERT_EQ(too_old.bounds.newest, at_ms(i));
  }
}

// With corrections, insertions and a collector that comes at any time, all that a ring that never
// forgets answers.
TEST(RealtimeHistory, AnswersWhatARingThatNeverForgetsWould) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 20; ++round) {
    Track track;
    const FrameId other = track.world.add_frame("http://x/other");
    const MeasurementId all = track.world.add_measurement(
        {.name = "http://x/all",
         .relation = track.world.add_relation(
             {.name = "http://x/r", .of = other, .with_respect_to = track.floor}),
         .capacity = 4000});
    Writer writer = track.world.claim(track.logged, {"d"});
    Writer reference = track.world.claim(all, {"d"});
    const PreparedPose by_history = track.query();
    const PreparedPose by_ring =
        track.world.prepare_pose({.of = other, .with_respect_to = track.floor});
    std::int64_t last = 0;
    std::uint64_t refused = 0, corrected = 0;
    for (int i = 0; i < 600; ++i) {
      if (random() % 8 == 0) track.world.collect();
      const bool correction = last > 200 && random() % 3 == 0;
      const std::int64_t at = correction ? last - static_cast<std::int64_t>(random() % 120)
                                         : last + 1 + static_cast<std::int64_t>(random() % 10);
      const Pose X = random_pose(random);
      const Status status = correction ? writer.correct(at_ms(at), X) : writer.write(at_ms(at), X);
      if (status == Status::kNoRoom) {
        ++refused;
      } else if (correction && status == Status::kTooLate) {
        continue;
      } else {
        ASSERT_EQ(status, Status::kOk);
        ASSERT_EQ(correction ? reference.correct(at_ms(at), X) : reference.write(at_ms(at), X),
                  Status::kOk);
        corrected += correction;
        if (!correction) last = at;
      }
      // At once, whether collected or not.
      for (int k = 0; k < 8; ++k) {
        const Stamp asked = stamp_of_ns(static_cast<std::int64_t>(random() % 1'000'000'000) %
                                        (1'000'000 * last + 1));
        const PoseAnswer expected = by_ring.at_realtime(asked);
        const PoseAnswer found = by_history.at_realtime(asked);
        ASSERT_EQ(found.status, expected.status) << i;
        if (expected.status != Status::kOk) continue;
        ASSERT_EQ(difference(found.pose, expected.pose), 0) << i;
      }
    }
    EXPECT_EQ(writer.refused(), refused);
    EXPECT_GT(refused, 0u);
    EXPECT_GT(corrected, 20u);
  }
}

TEST(RealtimeHistory, ABatchHasRoomForAllOrForNone) {
  Track track;
  const MeasurementId second = track.world.add_measurement(
      {.name = "http://x/second", .relation = track.driving, .capacity = 64, .keep_all = true});
  BatchWriter both = track.world.claim(std::vector{track.logged, second}, {"d"});
  double values[14] = {0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0};
  int written = 0;
  for (int i = 0; i < 30; ++i) {
    values[4] = values[11] = i;
    written += both.write(at_ms(i), values) == Status::kOk;
  }
  EXPECT_EQ(written, 14);
  EXPECT_EQ(both.refused(), 16u);
  EXPECT_EQ(track.world.history(track.logged).size(), 14u);
  EXPECT_EQ(track.world.history(second).size(), 14u);
}

TEST(RealtimeHistory, ACloneHasWhatTheCollectorHadNotYet) {
  Track track;
  Writer writer = track.world.claim(track.logged, {"http://x/driver"});
  for (int i = 0; i < 12; ++i) ASSERT_EQ(writer.write(at_ms(i), at_x(i)), Status::kOk);
  World clone = track.world.clone();
  EXPECT_EQ(clone.history(track.logged).size(), 12u);
  // Of its own from now on: what its ring loses its history has.
  for (int i = 100; i < 140; ++i) {
    clone.write(track.logged, at_ms(i), at_x(i), {"http://x/driver"});
  }
  const PreparedPose query = clone.prepare_pose({.of = track.cart, .with_respect_to = track.floor});
  EXPECT_EQ(query.at_realtime(at_ms(3)).pose.p.x, 3);
  EXPECT_EQ(query.at_realtime(at_ms(105)).pose.p.x, 105);
  EXPECT_EQ(writer.write(at_ms(12), at_x(12)), Status::kOk);
  EXPECT_EQ(track.world.history(track.logged).size(), 13u);
  EXPECT_EQ(clone.history(track.logged).size(), 52u);
}

// A writer, a collector, users that let go, and readers of the whole past. Under a sanitizer this
// is the proof that nothing races.
TEST(RealtimeHistory, WriterCollectorAndReadersAtOnce) {
  Track track({"http://x/logger"});
  std::atomic<bool> stop = false;
  std::atomic<std::int64_t> written_until = -1, kept_from = 0;
  std::atomic<std::uint64_t> wrong = 0, reads = 0, deep = 0, refused = 0;
  Collector collector(track.world, std::chrono::milliseconds(1));
  std::vector<std::thread> threads;
  threads.emplace_back([&] {
    Writer writer = track.world.claim(track.logged, {"http://x/driver"});
    for (std::int64_t i = 0; !stop;) {
      const Status status = writer.write(at_ms(i), at_x(static_cast<double>(i)));
      if (status == Status::kNoRoom) {
        ++refused;
        std::this_thread::yield();
        continue;
      }
      wrong += status != Status::kOk;
      written_until = i++;
    }
  });
  for (int k = 0; k < 2; ++k) {
    threads.emplace_back([&, k] {
      PreparedPose query = track.query();
      std::mt19937_64 random(static_cast<std::uint64_t>(k));
      while (!stop) {
        const std::int64_t from = kept_from, until = written_until;
        if (until <= from + 1) continue;
        const std::int64_t half =
            2 * from +
            static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(2 * (until - from)));
        const PoseAnswer answer = query.at_realtime(stamp_of_ns(500'000 * half));
        // What was let go of since is too old.
        if (answer.status == Status::kTooOld && half / 2 <= kept_from + 1) continue;
        if (answer.status == Status::kBusy) continue;
        wrong += answer.status != Status::kOk ||
                 std::abs(answer.pose.p.x - static_cast<double>(half) / 2) > 1e-6;
        ++reads;
        deep += half / 2 + 100 < until;
      }
    });
  }
  threads.emplace_back([&] {
    while (!stop) {
      const History history = track.world.history(track.logged);
      if (history.size() > 3000) {
        kept_from = ns_of(history[history.size() - 1000]->stamp) / 1'000'000 + 1;
        track.world.done(track.logged, "http://x/logger", history, history.size() - 1000);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  for (int i = 0; i < 200 && (deep < 100 || reads < 1000); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  stop = true;
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(deep, 0u);
  EXPECT_GT(reads, 0u);
}

}  // namespace
}  // namespace sinew::world
