// What real-time threads may call: no allocation, and answers that are whole while everybody
// writes. SINEW_WORLD_SOAK_S=60 runs the last test for a minute; built with SINEW_SANITIZE=thread
// it is the proof that nothing races.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <thread>
#include <vector>

#include "allocations.h"
#include "random_poses.h"
#include "sinew/world/edit.h"
#include "sinew/world/world.h"

namespace sinew::world {
namespace {

Stamp at_ns(std::int64_t ns) { return stamp_of_ns(ns); }
Pose at_x(double x) { return {{}, {x, 0, 0}}; }

// A chain whose relations are written in pairs, +k and -k, each pair as one: its ends are always at
// the same place, unless somebody sees half of a pair.
struct PairChain {
  explicit PairChain(int pairs) {
    Edit edit = world.edit();
    frames.push_back(edit.add_frame("http://x/f0"));
    for (int i = 0; i < 2 * pairs; ++i) {
      const std::string number = std::to_string(i + 1);
      frames.push_back(edit.add_frame("http://x/f" + number));
      const RelationId relation = edit.add_relation({.name = "http://x/r" + number,
                                                     .of = frames.back(),
                                                     .with_respect_to = frames[frames.size() - 2]});
      measurements.push_back(edit.add_measurement(
          {.name = "http://x/m" + number, .relation = relation, .capacity = 31}));
    }
    edit.commit();
  }
  PreparedPose query(const World& in) const {
    return in.prepare_pose({.of = frames.back(), .with_respect_to = frames.front()});
  }
  World world;
  std::vector<FrameId> frames;
  std::vector<MeasurementId> measurements;
};

void pair_values(double k, double (&values)[14]) {
  const double both[14] = {0, 0, 0, 1, k, 0, 0, 0, 0, 0, 1, -k, 0, 0};
  std::copy(both, both + 14, values);
}

TEST(Realtime, HandlesAllocateNothing) {
  PairChain chain(2);
  Writer single = chain.world.claim(chain.measurements[0], {"a"});
  Writer other = chain.world.claim(chain.measurements[1], {"a"});
  BatchWriter batch = chain.world.claim(
      std::vector<MeasurementId>{chain.measurements[2], chain.measurements[3]}, {"b"});
  PreparedPose query = chain.query(chain.world);
  PreparedMotion motion = chain.world.prepare_motion(
      {.of = chain.frames.back(), .with_respect_to = chain.frames.front()});
  double values[14];
  std::vector<World> clones;
  for (std::int64_t i = 1; i < 200; ++i) {
    if (i % 10 == 0) clones.push_back(chain.world.clone());
    const auto x = static_cast<double>(i);
    const std::size_t before = allocations();
    pair_values(x, values);
    ASSERT_EQ(single.write(at_ns(10 * i), at_x(x)), Status::kOk);
    ASSERT_EQ(other.write(at_ns(10 * i), at_x(-x)), Status::kOk);
    ASSERT_EQ(single.correct(at_ns(10 * i - 5), at_x(x)), Status::kOk);
    ASSERT_EQ(batch.write(at_ns(10 * i), values), Status::kOk);
    const PoseAnswer latest = query.latest_realtime(at_ns(10 * i));
    const PoseAnswer at = query.at_realtime(at_ns(10 * i));
    const PoseAnswer common = query.latest_common_realtime();
    const MotionAnswer moving = motion.latest_realtime(at_ns(10 * i));
    ASSERT_EQ(allocations(), before);
    ASSERT_EQ(latest.status, Status::kOk);
    ASSERT_EQ(at.status, Status::kOk);
    ASSERT_EQ(common.status, Status::kOk);
    ASSERT_EQ(moving.status, Status::kNoMotion);
    ASSERT_EQ(latest.pose.p.x, 0);
  }
}

TEST(Realtime, AMeasurementHasOneWriter) {
  PairChain chain(1);
  {
    Writer writer = chain.world.claim(chain.measurements[0], {"first"});
    EXPECT_THROW(chain.world.claim(chain.measurements[0], {"second"}), Error);
    EXPECT_THROW(chain.world.write(chain.measurements[0], at_ns(0), Pose{}, {"third"}), Error);
    EXPECT_EQ(writer.write(at_ns(5), Pose{}), Status::kOk);
    EXPECT_EQ(writer.write(at_ns(5), Pose{}), Status::kOutOfOrder);
    EXPECT_EQ(writer.write(at_ns(6), Pose{{0, 0, 0, 2}, {}}), Status::kNotANumber);
    EXPECT_EQ(writer.write(at_ns(6), Pose{{}, {0, NAN, 0}}), Status::kNotANumber);
  }
  EXPECT_EQ(chain.world.write(chain.measurements[0], at_ns(6), Pose{}, {"third"}), Status::kOk);
}

double soak_seconds() {
  const char* const asked = std::getenv("SINEW_WORLD_SOAK_S");
  return asked ? std::atof(asked) : 1.0;
}

// Eight threads: three real-time writers of pairs, one ordinary writer of a pair, three readers,
// and one that clones and changes the structure.
TEST(Realtime, AReaderNeverSeesHalfAnUpdate) {
  PairChain chain(4);
  double values[14];
  pair_values(0, values);
  for (std::size_t pair = 0; pair < 4; ++pair) {
    const std::size_t first = 2 * pair;
    const World::Value both[] = {
        {chain.measurements[first], std::span<const double>(values, 7)},
        {chain.measurements[first + 1], std::span<const double>(values + 7, 7)}};
    ASSERT_EQ(chain.world.write_together(at_ns(0), both, {}), Status::kOk);
  }
  std::atomic<bool> stop = false;
  std::atomic<std::uint64_t> answers = 0, busy = 0, wrong = 0, writes = 0, clones = 0;
  std::vector<std::thread> threads;
  for (std::size_t pair = 0; pair < 3; ++pair) {
    threads.emplace_back([&, pair] {
      const std::size_t first = 2 * pair;
      BatchWriter writer = chain.world.claim(
          std::vector<MeasurementId>{chain.measurements[first], chain.measurements[first + 1]},
          {"batch"});
      double both[14];
      for (std::int64_t i = 1; !stop; ++i) {
        pair_values(static_cast<double>(i), both);
        if (writer.write(at_ns(1000 * i), both) != Status::kOk) ++wrong;
        ++writes;
        if (i % 64 == 0) std::this_thread::yield();
      }
    });
  }
  threads.emplace_back([&] {
    double both[14];
    for (std::int64_t i = 1; !stop; ++i) {
      pair_values(static_cast<double>(i), both);
      const World::Value values_of_both[] = {
          {chain.measurements[6], std::span<const double>(both, 7)},
          {chain.measurements[7], std::span<const double>(both + 7, 7)}};
      if (chain.world.write_together(at_ns(1000 * i), values_of_both, {}) != Status::kOk) ++wrong;
      ++writes;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
  });
  for (int reader = 0; reader < 3; ++reader) {
    threads.emplace_back([&, reader] {
      PreparedPose query = chain.query(chain.world);
      while (!stop) {
        const PoseAnswer answer = reader == 0   ? query.latest(at_ns(0))
                                  : reader == 1 ? query.latest_realtime(at_ns(0))
                                                : query.at_realtime(at_ns(0));
        if (answer.status == Status::kOk) {
          ++answers;
          if (std::abs(answer.pose.p.x) > 1e-6) ++wrong;
        } else if (answer.status == Status::kBusy) {
          ++busy;
        } else if (answer.status != Status::kTooOld) {  // entries at 0 are overwritten in the end
          ++wrong;
        }
      }
    });
  }
  threads.emplace_back([&] {
    for (int i = 0; !stop; ++i) {
      World clone = chain.world.clone();
      PreparedPose query = chain.query(clone);
      const PoseAnswer first = query.latest(at_ns(0));
      if (first.status != Status::kOk || std::abs(first.pose.p.x) > 1e-6) ++wrong;
      const double x = clone.latest(chain.measurements[0], at_ns(0)).values[4];
      std::this_thread::sleep_for(std::chrono::microseconds(200));
      // What a clone once answered it answers again.
      if (clone.latest(chain.measurements[0], at_ns(0)).values[4] != x) ++wrong;
      if (std::abs(query.latest(at_ns(0)).pose.p.x) > 1e-6) ++wrong;
      ++clones;
      const FrameId frame = chain.world.add_frame("http://x/passing" + std::to_string(i));
      chain.world.remove(frame);
    }
  });
  std::this_thread::sleep_for(std::chrono::duration<double>(soak_seconds()));
  stop = true;
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(answers, 100u);
  EXPECT_GT(writes, 100u);
  EXPECT_GT(clones, 2u);
  RecordProperty("answers", std::to_string(answers));
  std::printf("%llu answers, %llu busy, %llu writes, %llu clones\n",
              static_cast<unsigned long long>(answers.load()),
              static_cast<unsigned long long>(busy.load()),
              static_cast<unsigned long long>(writes.load()),
              static_cast<unsigned long long>(clones.load()));
}

}  // namespace
}  // namespace sinew::world
