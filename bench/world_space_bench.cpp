// Regions among many objects: `objects` boxes spread over a hall of 100 m x 100 m x 10 m, each on a
// measured frame of its own. The region is 5 m x 5 m x 2 m and turned. Beside it, the same answer
// by looking at every object, and the update after which a share of them has moved.
#include <benchmark/benchmark.h>

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "sinew/world/edit.h"
#include "sinew/world/space.h"

namespace {

using namespace sinew::world;

constexpr WriteContext kCamera{"http://bench/camera"};
const Shape kRegion = {Box{{5, 5, 2}}, {{0, 0, 0.38268343236508978, 0.92387953251128674}, {}}};

struct Hall {
  explicit Hall(int objects) {
    Edit edit = world.edit();
    root = edit.add_frame("http://bench/hall");
    for (int i = 0; i < objects; ++i) {
      const std::string number = std::to_string(i);
      const FrameId frame = edit.add_frame("http://bench/frame" + number);
      this->objects.push_back(edit.add_object("http://bench/object" + number, frame));
      const RelationId pose = edit.add_relation(
          {.name = "http://bench/pose" + number, .of = frame, .with_respect_to = root});
      measured.push_back(edit.add_measurement({.name = "http://bench/seen" + number,
                                               .relation = pose,
                                               .model = {.provenance = "http://bench/camera"},
                                               .capacity = 2}));
    }
    edit.commit();
    for (const MeasurementId measurement : measured) move(measurement);
    space = std::make_unique<Space>(world, root);
    std::uniform_real_distribution<double> size(0.05, 0.5);
    for (const ObjectId object : this->objects) {
      space->add(object, {{Box{{size(random), size(random), size(random)}}, {}}});
    }
    space->update(now);
  }
  Vector3 anywhere() {
    std::uniform_real_distribution<double> along(0, 100), up(0, 10);
    return {along(random), along(random), up(random)};
  }
  void move(MeasurementId measurement) { world.write(measurement, now, {{}, anywhere()}, kCamera); }

  World world;
  std::mt19937_64 random{12};
  Stamp now = Stamp(std::chrono::seconds(1));
  FrameId root;
  std::vector<ObjectId> objects;
  std::vector<MeasurementId> measured;
  std::unique_ptr<Space> space;
};

void BM_region_query(benchmark::State& state) {
  Hall hall(static_cast<int>(state.range(0)));
  std::size_t found = 0;
  for (auto _ : state) {
    Shape region = kRegion;
    region.placement.p = hall.anywhere();
    const RegionAnswer answer = hall.space->within(hall.root, {region}, Match::kTouching);
    found += answer.bodies.size();
  }
  state.counters["found"] =
      benchmark::Counter(static_cast<double>(found), benchmark::Counter::kAvgIterations);
}
BENCHMARK(BM_region_query)->Arg(100)->Arg(10'000);

void BM_region_query_without_index(benchmark::State& state) {
  Hall hall(static_cast<int>(state.range(0)));
  const std::vector<BodyId> bodies = hall.space->bodies();
  for (auto _ : state) {
    Shape region = kRegion;
    region.placement.p = hall.anywhere();
    std::size_t found = 0;
    for (const BodyId body : bodies) found += touch(hall.space->shapes(body)[0], region);
    benchmark::DoNotOptimize(found);
  }
}
BENCHMARK(BM_region_query_without_index)->Arg(10'000);

// Arguments: objects, and how many of them have moved (anywhere) since the last update.
void BM_space_update(benchmark::State& state) {
  Hall hall(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    state.PauseTiming();
    hall.now += std::chrono::milliseconds(1);
    for (std::int64_t i = 0; i < state.range(1); ++i) {
      hall.move(hall.measured[hall.random() % hall.measured.size()]);
    }
    state.ResumeTiming();
    benchmark::DoNotOptimize(hall.space->update(hall.now));
  }
}
BENCHMARK(BM_space_update)->Args({10'000, 0})->Args({10'000, 100})->Args({10'000, 10'000});

}  // namespace
