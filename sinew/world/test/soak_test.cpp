// Everything at once: real-time writing with data blocks and corrections, histories that are
// corrected and let go of, queries of the past, triggers with a slow listener, space, attaching and
// clones, each in its thread. SINEW_WORLD_SOAK_S=60 runs it for a minute; built with
// SINEW_SANITIZE=thread it is the proof that nothing races.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <thread>
#include <vector>

#include "sinew/blocks/elaborate.h"
#include "sinew/world/edit.h"
#include "sinew/world/reader.h"
#include "sinew/world/space.h"
#include "sinew/world/triggers.h"

namespace sinew::world {
namespace {

double soak_seconds() {
  const char* const asked = std::getenv("SINEW_WORLD_SOAK_S");
  return asked ? std::atof(asked) : 1.0;
}

Stamp at_us(std::int64_t us) { return stamp_of_ns(1000 * us); }
Pose at_x(double x) { return {{}, {x, 0, 0}}; }

// floor -(posed: real time, with blocks)-> cart; floor -(logged: with a history)-> crane;
// floor -(constant)-> shelf; a box that hangs on the cart or on the crane.
struct Hall {
  Hall() {
    // The library lives as long as the process, as blocks do.
    static const auto library = std::make_shared<const data::Library>(
        blocks::load_library(kCanonicalPrototypes, "soak_test.blocks"));
    floor = world.add_frame("http://x/floor");
    cart = world.add_frame("http://x/cart");
    crane = world.add_frame("http://x/crane");
    box = world.add_frame("http://x/box");
    shelf = world.add_frame("http://x/shelf");
    const auto relation = [&](const char* name, FrameId of) {
      return world.add_relation({.name = name, .of = of, .with_respect_to = floor});
    };
    posed = world.add_measurement({.name = "http://x/posed",
                                   .relation = relation("http://x/driving", cart),
                                   .capacity = 32,
                                   .blocks = {.library = library,
                                              .blocks = {{"http://x/posed/a", kPosePrototype, true},
                                                         {"http://x/posed/b", kPosePrototype}}}});
    logged = world.add_measurement(
        {.name = "http://x/logged",
         .relation = relation("http://x/lifting", crane),
         .model = {.provenance = "http://x/crane-driver", .used_by = {"http://x/logger"}},
         .capacity = 16,
         .keep_all = true});
    put = world.add_measurement(
        {.name = "http://x/put", .relation = relation("http://x/standing", box)});
    world.add_static("http://x/built-in", shelf, floor, at_x(100), "me");
    world.write(posed, at_us(0), at_x(0), {});
    world.write(logged, at_us(0), at_x(0), {"http://x/crane-driver"});
    world.write(put, at_us(0), at_x(1), {});
  }
  World world;
  FrameId floor, cart, crane, box, shelf;
  MeasurementId posed, logged, put;
};

// Everybody who is at work in the hall; each but the listener runs until `stop`.
struct Soak {
  // In real time, every value written once and corrected once; x goes with the stamp.
  void write_in_real_time() {
    Writer writer = hall.world.claim(hall.posed, {"cart"});
    for (std::int64_t i = 1; !stop; ++i) {
      const double x = static_cast<double>(i);
      wrong += writer.write(at_us(i), at_x(x - 0.5)) != Status::kOk;
      wrong += writer.correct(at_us(i), at_x(x)) != Status::kOk;
      writes += 2;
      if (i % 64 == 0) std::this_thread::yield();
    }
  }

  // With a history; corrects the past, and lets go of what is old.
  void write_with_history() {
    const WriteContext driver{"http://x/crane-driver"};
    for (std::int64_t i = 1; !stop; ++i) {
      const double x = static_cast<double>(10 * i);
      wrong += hall.world.write(hall.logged, at_us(10 * i), at_x(x), driver) != Status::kOk;
      if (i > 100) {
        const std::int64_t back = 10 * (i - 60) + 5;
        wrong += hall.world.write(hall.logged, at_us(back), at_x(static_cast<double>(back)),
                                  driver) != Status::kOk;
      }
      logged_until = 10 * i;
      ++writes;
      if (i % 500 == 0) {
        const History history = hall.world.history(hall.logged);
        if (history.size() > 400) {
          hall.world.done(hall.logged, "http://x/logger", history, history.size() - 400);
        }
      }
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
  }

  // Blocks agree with each other and with the measurement, read before and after them.
  void read_blocks() {
    while (!stop) {
      double a[7], b[7];
      const World::BlockBuffer both[] = {{0, a, sizeof a}, {1, b, sizeof b}};
      Stamp stamp;
      const World::Sample before = hall.world.latest(hall.posed, at_us(0));
      const Status status = hall.world.read_blocks(hall.posed, both, &stamp);
      if (status == Status::kBusy) continue;
      wrong += status != Status::kOk || a[4] != b[4];
      wrong += before.status == Status::kOk && before.values[4] > a[4];
      const World::Sample own = hall.world.latest(hall.posed, at_us(0));
      wrong += own.status == Status::kOk && own.values[4] < a[4];
      ++block_reads;
    }
  }

  // The past, through a reader that may; whatever was corrected, x is the stamp.
  void read_the_past() {
    const Reader reader(hall.world, Rights(), "http://x/logger");
    const PoseQuery query{.of = hall.crane, .with_respect_to = hall.floor};
    PreparedPose prepared = reader.prepare_pose(query);
    for (std::uint64_t i = 0; !stop; ++i) {
      const std::int64_t until = logged_until;
      const std::int64_t at =
          std::max<std::int64_t>(0, until - static_cast<std::int64_t>(i % 3000));
      const PoseAnswer answer = prepared.at(at_us(at));
      if (answer.status == Status::kBusy) continue;
      if (answer.status == Status::kTooOld) continue;  // let go of
      wrong += answer.status != Status::kOk ||
               std::abs(answer.pose.p.x - static_cast<double>(at)) > 1e-6;
      ++past;
    }
  }

  // Where the box is: on the cart, under the crane or on the floor, but in one place.
  void look() {
    Space space(hall.world, hall.floor);
    const BodyId body = space.add(hall.box, {{Box{{0.2, 0.2, 0.2}}, {}}});
    const BodyId area = space.add_area("http://x/area", hall.shelf, {{Box{{1, 1, 1}}, {}}});
    while (!stop) {
      space.update(at_us(0));
      const RegionAnswer all = space.within(hall.floor, {{Box{{2e9, 2, 2}}, {}}}, Match::kTouching);
      wrong += all.status != Status::kOk || all.bodies.size() + all.unplaced.size() != 1 ||
               (all.bodies.empty() ? all.unplaced[0] : all.bodies[0]) != body;
      wrong += space.within(area, Match::kInside).status != Status::kOk;
      ++looked;
    }
  }

  // Clones, attaches, detaches; what a clone once said it says again.
  void clone_and_attach() {
    for (std::int64_t i = 0; !stop; ++i) {
      World clone = hall.world.clone();
      const double x = clone.latest(hall.posed, at_us(0)).values[4];
      const std::size_t kept = clone.history(hall.logged).size();
      hall.world.attach(hall.box, i % 2 ? hall.cart : hall.crane, at_us(i), "me");
      double a[7];
      const World::BlockBuffer one[] = {{0, a, sizeof a}};
      wrong += clone.read_blocks(hall.posed, one) != Status::kOk || a[4] != x;
      clone.write(hall.posed, at_us(1'000'000'000), at_x(-1), {});
      clone.write(hall.logged, at_us(1'000'000'000), at_x(-1), {"http://x/crane-driver"});
      wrong += clone.latest(hall.posed, at_us(0)).values[4] != -1;
      wrong += clone.history(hall.logged).size() != kept + 1;
      hall.world.detach(hall.box, hall.floor, at_us(i), "me");
      ++edits;
      std::this_thread::sleep_for(std::chrono::microseconds(300));
    }
  }

  Hall hall;
  std::atomic<bool> stop = false;
  std::atomic<std::uint64_t> wrong = 0, writes = 0, block_reads = 0, past = 0, heard = 0,
                             looked = 0, edits = 0;
  std::atomic<std::int64_t> logged_until = 0;
};

// Listeners, of which one is slower than what happens.
void listen(Soak& soak, Triggers& triggers, const std::shared_ptr<EventQueue>& queue) {
  const auto hear = [&soak](const Event&) { ++soak.heard; };
  triggers.add({.when = OnChange{soak.hall.posed}, .callback = hear}, queue);
  triggers.add({.when = OnChange{soak.hall.logged}, .callback = hear}, queue);
  triggers.add({.when = OnStructure{},
                .priority = 3,
                .callback =
                    [&soak](const Event&) {
                      ++soak.heard;
                      std::this_thread::sleep_for(std::chrono::milliseconds(1));
                    }},
               queue);
  triggers.add(
      {.when = OnCondition{[](const World& world, Stamp) {
         return world.latest(world.find_measurement("http://x/logged"), at_us(0)).values[4] > 100;
       }},
       .priority = 9,
       .callback = hear},
      queue);
}

TEST(Soak, EverythingAtOnceStaysConsistent) {
  Soak soak;
  std::vector<std::thread> threads;
  for (void (Soak::*work)() :
       {&Soak::write_in_real_time, &Soak::write_with_history, &Soak::read_blocks,
        &Soak::read_the_past, &Soak::look, &Soak::clone_and_attach})
    threads.emplace_back([&soak, work] { (soak.*work)(); });
  const auto queue = std::make_shared<EventQueue>(16);
  Triggers triggers(soak.hall.world);
  listen(soak, triggers, queue);
  auto watch = std::make_unique<Watch>(triggers, std::chrono::microseconds(100));
  threads.emplace_back([&] {
    while (!soak.stop) queue->run_one_within(std::chrono::milliseconds(2));
  });

  std::this_thread::sleep_for(std::chrono::duration<double>(soak_seconds()));
  // On a busy machine somebody may get its turn late.
  for (int i = 0; i < 300 && (soak.writes <= 100 || soak.block_reads <= 10 || soak.past <= 10 ||
                              soak.heard <= 5 || soak.looked <= 5 || soak.edits <= 2);
       ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  soak.stop = true;
  for (std::thread& thread : threads) thread.join();
  watch.reset();
  EXPECT_EQ(soak.wrong, 0u);
  EXPECT_GT(soak.writes, 100u);
  EXPECT_GT(soak.block_reads, 10u);
  EXPECT_GT(soak.past, 10u);
  EXPECT_GT(soak.heard, 5u);
  EXPECT_GT(soak.looked, 5u);
  EXPECT_GT(soak.edits, 2u);
  std::printf(
      "%llu writes, %llu block reads, %llu of the past, %llu heard (%llu dropped), %llu "
      "looks at space, %llu attached and detached\n",
      static_cast<unsigned long long>(soak.writes.load()),
      static_cast<unsigned long long>(soak.block_reads.load()),
      static_cast<unsigned long long>(soak.past.load()),
      static_cast<unsigned long long>(soak.heard.load()),
      static_cast<unsigned long long>(queue->dropped()),
      static_cast<unsigned long long>(soak.looked.load()),
      static_cast<unsigned long long>(soak.edits.load()));
}

}  // namespace
}  // namespace sinew::world
