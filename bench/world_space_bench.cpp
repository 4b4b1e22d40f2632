// Regions among many objects: `objects` boxes spread over a hall of 100 m x 100 m x 10 m, each on a
// measured frame of its own. The region is a box, as wide as the row says and turned by 45 degrees.
// Beside it in the same run, where it is installed: FCL's dynamic tree of boxes with its own exact
// test of two boxes, on the same objects and regions. Before anything is measured, both must have
// found the same. Also: the same answer by looking at every object, and the update after which a
// share of them has moved.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "sinew/world/edit.h"
#include "sinew/world/space.h"
#ifdef SINEW_HAVE_FCL
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>
#endif

namespace {

using namespace sinew::world;

constexpr WriteContext kCamera{"http://bench/camera"};
constexpr Quaternion kTurned = {0, 0, 0.38268343236508978, 0.92387953251128674};
constexpr std::size_t kRegions = 256;  // that a row asks for in turn

// As wide and deep as `width`, and at most 2 m high.
Shape region_of(double width, const Vector3& at) {
  return {Box{{width, width, std::min(width, 2.0)}}, {kTurned, at}};
}

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
    places.resize(measured.size());
    for (std::size_t i = 0; i < measured.size(); ++i) move(i);
    space = std::make_unique<Space>(world, root);
    std::uniform_real_distribution<double> size(0.05, 0.5);
    for (const ObjectId object : this->objects) {
      boxes.push_back({{size(random), size(random), size(random)}});
      space->add(object, {{boxes.back(), {}}});
    }
    space->update(now);
  }
  Vector3 anywhere() {
    std::uniform_real_distribution<double> along(0, 100), up(0, 10);
    return {along(random), along(random), up(random)};
  }
  void move(std::size_t i) {
    places[i] = anywhere();
    world.write(measured[i], now, {{}, places[i]}, kCamera);
  }

  World world;
  std::mt19937_64 random{12};
  Stamp now = Stamp(std::chrono::seconds(1));
  FrameId root;
  std::vector<ObjectId> objects;
  std::vector<MeasurementId> measured;
  std::vector<Vector3> places;
  std::vector<Box> boxes;
  std::unique_ptr<Space> space;
};

std::vector<Shape> regions_in(Hall& hall, double width) {
  std::vector<Shape> regions;
  for (std::size_t i = 0; i < kRegions; ++i) regions.push_back(region_of(width, hall.anywhere()));
  return regions;
}

void count(benchmark::State& state, std::size_t found) {
  state.counters["found"] =
      benchmark::Counter(static_cast<double>(found), benchmark::Counter::kAvgIterations);
}

// Arguments: objects, and the width of the region in decimetres.
void ask(benchmark::State& state, Match match) {
  Hall hall(static_cast<int>(state.range(0)));
  const auto regions = regions_in(hall, 0.1 * static_cast<double>(state.range(1)));
  std::size_t found = 0, next = 0;
  for (auto _ : state) {
    const std::vector<Shape> region = {regions[next++ % kRegions]};
    const RegionAnswer answer = hall.space->within(hall.root, region, match);
    found += answer.bodies.size();
  }
  count(state, found);
}
void BM_region_query(benchmark::State& state) { ask(state, Match::kTouching); }
void BM_region_query_inside(benchmark::State& state) { ask(state, Match::kInside); }

void volumes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Args({100, 50});
  for (const int width : {5, 50, 200, 500}) benchmark->Args({10'000, width});
}
BENCHMARK(BM_region_query)->Apply(volumes);
BENCHMARK(BM_region_query_inside)->Apply(volumes);

#ifdef SINEW_HAVE_FCL
// ---- FCL ----

struct FclHall {
  explicit FclHall(const Hall& hall) {
    for (std::size_t i = 0; i < hall.boxes.size(); ++i) {
      objects.push_back(object_of({hall.boxes[i], {{}, hall.places[i]}}));
      objects.back()->setUserData(reinterpret_cast<void*>(i));
      tree.registerObject(objects.back().get());
    }
    tree.setup();
  }
  static std::unique_ptr<fcl::CollisionObjectd> object_of(const Shape& shape) {
    const Vector3 size = std::get<Box>(shape.geometry).size;
    const auto& [q, p] = shape.placement;
    fcl::Transform3d at = fcl::Transform3d::Identity();
    at.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
    at.translation() = Eigen::Vector3d(p.x, p.y, p.z);
    return std::make_unique<fcl::CollisionObjectd>(
        std::make_shared<fcl::Boxd>(size.x, size.y, size.z), at);
  }
  // The numbers of the objects that collide with the region.
  void within(fcl::CollisionObjectd& region, std::vector<std::size_t>& found) const {
    found.clear();
    tree.collide(&region, &found,
                 [](fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
                   static const fcl::CollisionRequestd kRequest;
                   fcl::CollisionResultd result;
                   fcl::collide(a, b, kRequest, result);
                   // Which of the two is the region's is not said; that one's user data is zero.
                   if (result.isCollision()) {
                     const auto number = reinterpret_cast<std::size_t>(a->getUserData()) +
                                         reinterpret_cast<std::size_t>(b->getUserData());
                     static_cast<std::vector<std::size_t>*>(data)->push_back(number);
                   }
                   return false;
                 });
  }
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
  fcl::DynamicAABBTreeCollisionManagerd tree;
};

void BM_fcl_region_query(benchmark::State& state) {
  Hall hall(static_cast<int>(state.range(0)));
  const auto regions = regions_in(hall, 0.1 * static_cast<double>(state.range(1)));
  FclHall peer(hall);
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
  std::vector<std::size_t> numbers;
  for (const Shape& region : regions) {
    objects.push_back(FclHall::object_of(region));
    objects.back()->computeAABB();
    objects.back()->setUserData(nullptr);
    peer.within(*objects.back(), numbers);
    std::sort(numbers.begin(), numbers.end());
    std::vector<std::size_t> ours;
    for (const BodyId body : hall.space->within(hall.root, {region}, Match::kTouching).bodies) {
      ours.push_back(body.index);
    }
    // FCL says what overlaps; Sinew also what is nearer than kTouchingDistance.
    std::vector<std::size_t> differing;
    std::set_symmetric_difference(ours.begin(), ours.end(), numbers.begin(), numbers.end(),
                                  std::back_inserter(differing));
    for (const std::size_t number : differing) {
      const BodyId body{static_cast<Index>(number)};
      const double apart = distance(hall.space->shapes(body)[0], region);
      if (apart > 0 && apart <= kTouchingDistance) continue;
      state.SkipWithError("FCL and Sinew do not find the same");
      return;
    }
  }
  std::size_t found = 0, next = 0;
  for (auto _ : state) {
    peer.within(*objects[next++ % kRegions], numbers);
    found += numbers.size();
  }
  count(state, found);
}
BENCHMARK(BM_fcl_region_query)->Apply(volumes);
#endif

void BM_region_query_without_index(benchmark::State& state) {
  Hall hall(static_cast<int>(state.range(0)));
  const auto regions = regions_in(hall, 5);
  const std::vector<BodyId> bodies = hall.space->bodies();
  std::size_t next = 0;
  for (auto _ : state) {
    const Shape& region = regions[next++ % kRegions];
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
      hall.move(hall.random() % hall.measured.size());
    }
    state.ResumeTiming();
    benchmark::DoNotOptimize(hall.space->update(hall.now));
  }
}
BENCHMARK(BM_space_update)->Args({10'000, 0})->Args({10'000, 100})->Args({10'000, 10'000});

#ifdef SINEW_HAVE_FCL
// The same motions, without the world's part: the poses are there.
void BM_fcl_update(benchmark::State& state) {
  Hall hall(static_cast<int>(state.range(0)));
  FclHall peer(hall);
  std::vector<fcl::CollisionObjectd*> moved;
  for (auto _ : state) {
    state.PauseTiming();
    moved.clear();
    for (std::int64_t i = 0; i < state.range(1); ++i) {
      moved.push_back(peer.objects[hall.random() % peer.objects.size()].get());
      const Vector3 p = hall.anywhere();
      moved.back()->setTranslation(Eigen::Vector3d(p.x, p.y, p.z));
    }
    state.ResumeTiming();
    for (fcl::CollisionObjectd* object : moved) object->computeAABB();
    peer.tree.update(moved);
  }
}
BENCHMARK(BM_fcl_update)->Args({10'000, 100})->Args({10'000, 10'000});
#endif

}  // namespace
