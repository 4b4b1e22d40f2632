// The world model, and tf2 beside it in the same run where it is installed: relative pose at a
// depth, latest and interpolated, alone and beside a 1 kHz writer, by one reader and three;
// writing, cloning.
//
// The chain of N links has N measured relations, each written with the same stamps in both systems:
// kSamples of them, kPeriod apart. "Latest" asks for the last entries, "interpolated" for a time
// between the last two, where tf2's linear search is shortest.
#include <benchmark/benchmark.h>

#include <atomic>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "controller_pose.h"
#include "sinew/blocks/elaborate.h"
#include "sinew/world/edit.h"
#include "sinew/world/world.h"
#ifdef SINEW_HAVE_TF2
#include "tf2_buffer.h"
#endif

namespace {

using namespace sinew::world;

constexpr int kSamples = 100;
constexpr Duration kPeriod = std::chrono::milliseconds(10);
constexpr Stamp kFirst = Stamp(std::chrono::seconds(1000));
constexpr Stamp kLast = kFirst + (kSamples - 1) * kPeriod;

// A chain of links that turn and move a little from sample to sample.
class Motion {
 public:
  explicit Motion(int links) {
    std::mt19937_64 random(11);
    std::normal_distribution<double> normal;
    for (int i = 0; i < links; ++i) {
      start_.push_back(exponential({{normal(random), normal(random), normal(random)},
                                    {normal(random), normal(random), normal(random)}},
                                   1));
      twist_.push_back({{normal(random), normal(random), normal(random)},
                        {normal(random), normal(random), normal(random)}});
    }
  }
  Pose at(int link, Stamp stamp) const {
    const auto i = static_cast<std::size_t>(link);
    return compose(start_[i], exponential(twist_[i], seconds_of(stamp - kFirst)));
  }

 private:
  std::vector<Pose> start_;
  std::vector<Twist> twist_;
};

struct Chain {
  explicit Chain(int links) : motion(links), links_(links) {
    Edit edit = world.edit();
    frames.push_back(edit.add_frame("http://bench/frame0"));
    for (int i = 0; i < links; ++i) {
      const std::string number = std::to_string(i + 1);
      frames.push_back(edit.add_frame("http://bench/frame" + number));
      const RelationId relation = edit.add_relation({.name = "http://bench/relation" + number,
                                                     .of = frames.back(),
                                                     .with_respect_to = frames[frames.size() - 2]});
      measurements.push_back(edit.add_measurement({.name = "http://bench/measurement" + number,
                                                   .relation = relation,
                                                   .capacity = kSamples + 20}));
    }
    edit.commit();
    for (int sample = 0; sample < kSamples; ++sample) {
      const Stamp stamp = kFirst + sample * kPeriod;
      for (int i = 0; i < links; ++i) {
        world.write(measurements[static_cast<std::size_t>(i)], stamp, motion.at(i, stamp), {});
      }
    }
  }
  PreparedPose query() const {
    return world.prepare_pose({.of = frames.back(), .with_respect_to = frames.front()});
  }
  World world;
  Motion motion;
  std::vector<FrameId> frames;
  std::vector<MeasurementId> measurements;
  int links() const { return links_; }

 private:
  int links_;
};

// Rounds that the writer has finished, in each of which every link has got an entry.
std::atomic<int> rounds_written = 0;
// Between the last two entries of every link.
Stamp between() { return kLast + rounds_written.load() * kPeriod - kPeriod / 3; }

// Writes every link at 1 kHz until it is destroyed.
template <typename Write>
class Background {
 public:
  Background(bool on, Write write) : on_(on), write_(std::move(write)) {
    if (on_) thread_ = std::thread([this] { run(); });
  }
  ~Background() {
    if (!thread_.joinable()) return;
    on_ = false;
    thread_.join();
    rounds_written = 0;
  }

 private:
  void run() {
    auto next = std::chrono::steady_clock::now();
    for (int round = 1; on_; ++round) {
      write_(round);
      rounds_written = round;
      next += std::chrono::milliseconds(1);
      std::this_thread::sleep_until(next);
    }
  }
  std::atomic<bool> on_;
  Write write_;
  std::thread thread_;
};

// ---- ours ----

// Shared by the threads of one run.
std::unique_ptr<Chain> the_chain;

template <typename Ask>
void ask_ours(benchmark::State& state, bool writer, Ask&& ask) {
  if (state.thread_index() == 0)
    the_chain = std::make_unique<Chain>(static_cast<int>(state.range(0)));
  std::unique_ptr<PreparedPose> query;
  std::vector<Writer> writers;
  if (writer && state.thread_index() == 0) {
    for (const MeasurementId m : the_chain->measurements) {
      writers.push_back(the_chain->world.claim(m, {"bench"}));
    }
  }
  Background background(writer && state.thread_index() == 0, [&](int round) {
    const Stamp stamp = kLast + round * kPeriod;
    for (std::size_t i = 0; i < writers.size(); ++i) {
      writers[i].write(stamp, the_chain->motion.at(static_cast<int>(i), stamp));
    }
  });
  for (auto _ : state) {
    if (!query) query = std::make_unique<PreparedPose>(the_chain->query());
    const PoseAnswer answer = ask(*query);
    if (answer.status != Status::kOk) state.SkipWithError("no answer");
    benchmark::DoNotOptimize(answer.pose);
  }
  state.SetItemsProcessed(state.iterations());
}

void latest(benchmark::State& state, bool writer) {
  ask_ours(state, writer, [](PreparedPose& query) { return query.latest_realtime(kLast); });
}
void interpolated(benchmark::State& state, bool writer) {
  ask_ours(state, writer, [](PreparedPose& query) { return query.at_realtime(between()); });
}
void latest_common(benchmark::State& state, bool writer) {
  ask_ours(state, writer, [](PreparedPose& query) { return query.latest_common_realtime(); });
}

void BM_pose_latest(benchmark::State& state) { latest(state, false); }
void BM_pose_latest_common(benchmark::State& state) { latest_common(state, false); }
void BM_pose_interpolated(benchmark::State& state) { interpolated(state, false); }
void BM_pose_latest_beside_writer(benchmark::State& state) { latest(state, true); }
void BM_pose_interpolated_beside_writer(benchmark::State& state) { interpolated(state, true); }

#ifdef SINEW_HAVE_TF2
// ---- tf2 ----

Tf2Numbers numbers(const Pose& X) { return {X.q.x, X.q.y, X.q.z, X.q.w, X.p.x, X.p.y, X.p.z}; }

struct Tf2Chain {
  explicit Tf2Chain(int links) : motion(links) {
    for (int i = 0; i <= links; ++i) names.push_back("frame" + std::to_string(i));
    for (int sample = 0; sample < kSamples; ++sample) write(kFirst + sample * kPeriod);
  }
  void write(Stamp stamp) {
    for (std::size_t i = 0; i + 1 < names.size(); ++i) {
      buffer.set(names[i + 1], names[i], ns_of(stamp),
                 numbers(motion.at(static_cast<int>(i), stamp)));
    }
  }
  Tf2Buffer buffer;
  Motion motion;
  std::vector<std::string> names;
};
std::unique_ptr<Tf2Chain> the_tf2_chain;

template <typename When>
void ask_tf2(benchmark::State& state, bool writer, When&& stamp_ns) {
  if (state.thread_index() == 0) {
    the_tf2_chain = std::make_unique<Tf2Chain>(static_cast<int>(state.range(0)));
  }
  Background background(writer && state.thread_index() == 0,
                        [](int round) { the_tf2_chain->write(kLast + round * kPeriod); });
  Tf2Numbers pose;
  for (auto _ : state) {
    if (!the_tf2_chain->buffer.lookup(the_tf2_chain->names.front(), the_tf2_chain->names.back(),
                                      stamp_ns(), &pose)) {
      state.SkipWithError("no answer");
    }
    benchmark::DoNotOptimize(pose);
  }
  state.SetItemsProcessed(state.iterations());
}

std::int64_t the_latest() { return 0; }
std::int64_t between_ns() { return ns_of(between()); }
void BM_tf2_pose_latest(benchmark::State& state) { ask_tf2(state, false, the_latest); }
void BM_tf2_pose_interpolated(benchmark::State& state) { ask_tf2(state, false, between_ns); }
void BM_tf2_pose_latest_beside_writer(benchmark::State& state) { ask_tf2(state, true, the_latest); }
void BM_tf2_pose_interpolated_beside_writer(benchmark::State& state) {
  ask_tf2(state, true, between_ns);
}
#endif

void depths(benchmark::internal::Benchmark* benchmark) {
  for (const int depth : {3, 10, 30}) benchmark->Arg(depth);
}
void readers(benchmark::internal::Benchmark* benchmark) {
  depths(benchmark);
  benchmark->Threads(1)->Threads(3)->UseRealTime();
}

void three_readers(benchmark::internal::Benchmark* benchmark) {
  depths(benchmark);
  benchmark->Threads(3)->UseRealTime();
}

BENCHMARK(BM_pose_latest)->Apply(depths);
BENCHMARK(BM_pose_latest)->Apply(three_readers);
BENCHMARK(BM_pose_latest_common)->Apply(depths);
BENCHMARK(BM_pose_interpolated)->Apply(depths);
BENCHMARK(BM_pose_interpolated)->Apply(three_readers);
#ifdef SINEW_HAVE_TF2
BENCHMARK(BM_tf2_pose_latest)->Apply(depths);
BENCHMARK(BM_tf2_pose_latest)->Apply(three_readers);
BENCHMARK(BM_tf2_pose_interpolated)->Apply(depths);
BENCHMARK(BM_tf2_pose_interpolated)->Apply(three_readers);
#endif
BENCHMARK(BM_pose_latest_beside_writer)->Apply(readers);
BENCHMARK(BM_pose_interpolated_beside_writer)->Apply(readers);
#ifdef SINEW_HAVE_TF2
BENCHMARK(BM_tf2_pose_latest_beside_writer)->Apply(readers);
BENCHMARK(BM_tf2_pose_interpolated_beside_writer)->Apply(readers);
#endif

// ---- writing and cloning ----

void BM_write_realtime(benchmark::State& state) {
  Chain chain(1);
  Writer writer = chain.world.claim(chain.measurements[0], {"bench"});
  const Pose X = chain.motion.at(0, kLast);
  Stamp stamp = kLast;
  for (auto _ : state) {
    stamp += Duration(1);
    benchmark::DoNotOptimize(writer.write(stamp, X));
  }
}
BENCHMARK(BM_write_realtime);

void BM_write(benchmark::State& state) {
  Chain chain(1);
  const Pose X = chain.motion.at(0, kLast);
  Stamp stamp = kLast;
  for (auto _ : state) {
    stamp += Duration(1);
    benchmark::DoNotOptimize(chain.world.write(chain.measurements[0], stamp, X, {"bench"}));
  }
}
BENCHMARK(BM_write);

// With the same value as a controller has it, a matrix in millimetres: the conversion is part of
// the write.
void BM_write_realtime_with_a_block(benchmark::State& state) {
  World world;
  const FrameId a = world.add_frame("http://bench/a"), b = world.add_frame("http://bench/b");
  const RelationId relation =
      world.add_relation({.name = "http://bench/r", .of = b, .with_respect_to = a});
  const MeasurementId measured = world.add_measurement(
      {.name = "http://bench/m",
       .relation = relation,
       .blocks = {
           .library = std::make_shared<const sinew::data::Library>(sinew::blocks::load_library(
               std::string(kControllerPose) + kCanonicalPrototypes, "bench.blocks")),
           .blocks = {{"http://bench/m/controller", "controller_pose", true}}}});
  Writer writer = world.claim(measured, {"bench"});
  const Pose X = Motion(1).at(0, kLast);
  Stamp stamp = kLast;
  for (auto _ : state) {
    stamp += Duration(1);
    benchmark::DoNotOptimize(writer.write(stamp, X));
  }
}
BENCHMARK(BM_write_realtime_with_a_block);

// A robot's seven joints as one.
void BM_write_batch_of_seven(benchmark::State& state) {
  World world;
  std::vector<MeasurementId> joints;
  FrameId last = world.add_frame("http://bench/base");
  for (int i = 0; i < 7; ++i) {
    const std::string number = std::to_string(i);
    const FrameId next = world.add_frame("http://bench/link" + number);
    const RelationId joint = world.add_relation({.name = "http://bench/joint" + number,
                                                 .of = next,
                                                 .with_respect_to = last,
                                                 .kind = RelationKind::kRevolute});
    joints.push_back(world.add_measurement({.name = "http://bench/position" + number,
                                            .relation = joint,
                                            .quantity = Quantity::kJointPosition}));
    last = next;
  }
  BatchWriter writer = world.claim(joints, {"bench"});
  const double positions[7] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
  Stamp stamp = kFirst;
  for (auto _ : state) {
    stamp += Duration(1);
    benchmark::DoNotOptimize(writer.write(stamp, positions));
  }
}
BENCHMARK(BM_write_batch_of_seven);

// Frames, relations and measurements together: a node has one of each.
std::unique_ptr<World> world_of(int nodes) {
  auto world = std::make_unique<World>();
  Edit edit = world->edit();
  const FrameId root = edit.add_frame("http://bench/root");
  for (int i = 0; i < nodes; ++i) {
    const std::string number = std::to_string(i);
    const FrameId frame = edit.add_frame("http://bench/frame" + number);
    edit.add_static("http://bench/pose" + number, frame, root, Pose{}, "bench");
  }
  edit.commit();
  return world;
}

void BM_clone(benchmark::State& state) {
  const auto world = world_of(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    World clone = world->clone();
    benchmark::DoNotOptimize(clone);
  }
}
BENCHMARK(BM_clone)->Arg(100)->Arg(10'000);

}  // namespace
