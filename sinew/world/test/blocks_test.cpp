// Data blocks: one measurement in several prototypes that always agree.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <optional>
#include <random>
#include <thread>

#include "allocations.h"
#include "controller_pose.h"
#include "random_poses.h"
#include "sinew/blocks/elaborate.h"
#include "sinew/graph/store.h"
#include "sinew/world/edit.h"
#include "sinew/world/world.h"

namespace sinew::world {
namespace {

// A joint's position as an angle in radians or in degrees, and as no more than its cosine.
constexpr const char* kPrototypes = R"(
domain joint_space :: {
  semantic : JointPosition
  coord : absolute | approximate
  units, algebraic, dr
  coordinates absolute of JointPosition { q = rad }
  coordinates approximate of JointPosition { cosine = unitless }
  formula absolute -> approximate of JointPosition { cosine = cos(q) }
}
algebraic joint :: Scalar{q}
algebraic of_cosine :: Scalar{cosine}
dproto radians :: joint_space { semantic = JointPosition coord = absolute algebraic = joint
  ddr = :: c99 { double[1] } dr = { 0 = q } units = :: qudt, joint { RAD = q } }
dproto pendant :: joint_space { semantic = JointPosition coord = absolute algebraic = joint
  ddr = :: c99 { struct pendant { float angle; } } dr = { angle = q } units = :: qudt, joint { DEG = q } }
dproto display :: joint_space { semantic = JointPosition coord = approximate algebraic = of_cosine
  ddr = :: c99 { double[1] } dr = { 0 = cosine } units = :: qudt, of_cosine { unitless = cosine } }
)";

std::shared_ptr<const data::Library> library() {
  static const auto loaded = std::make_shared<const data::Library>(blocks::load_library(
      std::string(kControllerPose) + kPrototypes + kCanonicalPrototypes, "blocks_test.blocks"));
  return loaded;
}

Stamp at_ns(std::int64_t ns) { return stamp_of_ns(ns); }

struct Scene {
  World world;
  FrameId a = world.add_frame("http://x/a"), b = world.add_frame("http://x/b");
  RelationId relation = world.add_relation({.name = "http://x/r", .of = b, .with_respect_to = a});
  MeasurementId pose = world.add_measurement(
      {.name = "http://x/pose",
       .relation = relation,
       .blocks = {.library = library(),
                  .blocks = {{"http://x/pose/plain", kPosePrototype},
                             {"http://x/pose/controller", "controller_pose", true}}}});
  RelationId joint = world.add_relation(
      {.name = "http://x/j", .of = b, .with_respect_to = a, .kind = RelationKind::kRevolute});
  MeasurementId angle = world.add_measurement(
      {.name = "http://x/angle",
       .relation = joint,
       .quantity = Quantity::kJointPosition,
       .blocks = {.library = library(),
                  .canonical = "radians",
                  .blocks = {{"http://x/angle/pendant", "pendant", false, true},
                             {"http://x/angle/display", "display"}}}});
};

std::array<double, 16> in_millimetres(const Pose& X) {
  const auto M = to_matrix(X);
  return {M.R.xx, M.R.xy, M.R.xz, 1000 * M.p.x, M.R.yx, M.R.yy, M.R.yz, 1000 * M.p.y,
          M.R.zx, M.R.zy, M.R.zz, 1000 * M.p.z, 0,      0,      0,      1};
}

TEST(Blocks, WritingOneFormWritesAll) {
  Scene s;
  std::mt19937_64 random(3);
  const std::size_t controller = s.world.find_block(s.pose, "http://x/pose/controller");
  EXPECT_EQ(controller, 0u);  // real-time blocks come first
  for (int i = 1; i < 200; ++i) {
    const Pose X = random_pose(random);
    std::array<double, 16> matrix = in_millimetres(X);
    if (i % 2 == 0) {
      ASSERT_EQ(s.world.write(s.pose, at_ns(i), X, {}), Status::kOk);
    } else {
      ASSERT_EQ(s.world.write_block(s.pose, controller, at_ns(i), matrix.data(), sizeof matrix, {}),
                Status::kOk);
    }
    EXPECT_LT(
        difference(s.world.prepare_pose({.of = s.b, .with_respect_to = s.a, .avoid = {s.joint}})
                       .latest(at_ns(i))
                       .pose,
                   X),
        1e-14);
    std::array<double, 16> read;
    double plain[7];
    const World::BlockBuffer both[] = {{controller, read.data(), sizeof read},
                                       {1, plain, sizeof plain}};
    Stamp stamp;
    ASSERT_EQ(s.world.read_blocks(s.pose, both, &stamp), Status::kOk);
    EXPECT_EQ(stamp, at_ns(i));
    for (std::size_t k = 0; k < 16; ++k) EXPECT_NEAR(read[k], matrix[k], 1e-11) << k;
    EXPECT_NEAR(plain[4], X.p.x, 1e-15);
  }
}

TEST(Blocks, UnitsAreConvertedAndOneWayBlocksAreReadOnly) {
  Scene s;
  const std::size_t pendant = s.world.find_block(s.angle, "http://x/angle/pendant");
  const std::size_t display = s.world.find_block(s.angle, "http://x/angle/display");
  const float degrees = 60;
  ASSERT_EQ(s.world.write_block(s.angle, pendant, at_ns(1), &degrees, sizeof degrees, {}),
            Status::kOk);
  EXPECT_NEAR(s.world.latest(s.angle, at_ns(1)).values[0], M_PI / 3, 1e-15);
  double cosine = 0;
  const World::BlockBuffer shown[] = {{display, &cosine, sizeof cosine}};
  ASSERT_EQ(s.world.read_blocks(s.angle, shown), Status::kOk);
  EXPECT_NEAR(cosine, 0.5, 1e-15);
  EXPECT_EQ(s.world.write_block(s.angle, display, at_ns(2), &cosine, sizeof cosine, {}),
            Status::kReadOnly);
}

TEST(Blocks, RealtimeHandlesKeepThemConsistentAndAllocateNothing) {
  Scene s;
  Writer writer = s.world.claim(s.pose, {"robot"});
  std::mt19937_64 random(4);
  for (int i = 1; i < 100; ++i) {
    const Pose X = random_pose(random);
    const std::array<double, 16> matrix = in_millimetres(X);
    const std::size_t before = allocations();
    ASSERT_EQ(i % 2 == 0 ? writer.write(at_ns(i), X)
                         : writer.write_block(0, at_ns(i), matrix.data(), sizeof matrix),
              Status::kOk);
    EXPECT_EQ(allocations(), before);
    std::array<double, 16> read;
    const World::BlockBuffer controller[] = {{0, read.data(), sizeof read}};
    ASSERT_EQ(s.world.read_blocks(s.pose, controller), Status::kOk);
    for (std::size_t k = 0; k < 16; ++k) EXPECT_NEAR(read[k], matrix[k], 1e-11);
    if (i % 10 == 0) {
      const World clone = s.world.clone();
      ASSERT_EQ(writer.write(at_ns(1000 + i), Pose{}), Status::kOk);
      std::array<double, 16> kept;
      const World::BlockBuffer of_clone[] = {{0, kept.data(), sizeof kept}};
      ASSERT_EQ(clone.read_blocks(s.pose, of_clone), Status::kOk);
      EXPECT_EQ(kept, read);
      break;
    }
  }
}

// Whoever corrects the last value corrects all its forms, with a handle or without.
TEST(Blocks, AreCorrectedWithTheLastValue) {
  for (const bool by_handle : {false, true}) {
    Scene s;
    std::mt19937_64 random(5);
    std::optional<Writer> writer;
    if (by_handle) writer.emplace(s.world.claim(s.pose, {"robot"}));
    PreparedPose query =
        s.world.prepare_pose({.of = s.b, .with_respect_to = s.a, .avoid = {s.joint}});
    std::vector<Pose> history;
    for (std::int64_t i = 1; i < 60; ++i) {
      Pose X = random_pose(random);
      ASSERT_EQ(
          by_handle ? writer->write(at_ns(10 * i), X) : s.world.write(s.pose, at_ns(10 * i), X, {}),
          Status::kOk);
      const World before = s.world.clone();
      const Pose old = X;
      if (i % 3 != 0) {
        X = random_pose(random);
        const std::array<double, 16> matrix = in_millimetres(X);
        const std::size_t allocated = allocations();
        const Status status =
            i % 3 == 1
                ? (by_handle ? writer->correct(at_ns(10 * i), X)
                             : s.world.write(s.pose, at_ns(10 * i), X, {}))
                : (by_handle ? writer->correct_block(0, at_ns(10 * i), matrix.data(), sizeof matrix)
                             : s.world.write_block(s.pose, 0, at_ns(10 * i), matrix.data(),
                                                   sizeof matrix, {}));
        ASSERT_EQ(status, Status::kOk);
        if (by_handle) {
          EXPECT_EQ(allocations(), allocated);
        }
      }
      history.push_back(X);
      // One further back: its forms then are made from it, the blocks of now stay.
      if (i > 5) {
        history[static_cast<std::size_t>(i - 3)] = random_pose(random);
        const Pose& Y = history[static_cast<std::size_t>(i - 3)];
        ASSERT_EQ(by_handle ? writer->correct(at_ns(10 * (i - 2)), Y)
                            : s.world.write(s.pose, at_ns(10 * (i - 2)), Y, {}),
                  Status::kOk);
      }
      const auto shows = [&](const World& in, const Pose& expected) {
        std::array<double, 16> read;
        double plain[7];
        const World::BlockBuffer both[] = {{0, read.data(), sizeof read}, {1, plain, sizeof plain}};
        Stamp stamp;
        ASSERT_EQ(in.read_blocks(s.pose, both, &stamp), Status::kOk);
        EXPECT_EQ(stamp, at_ns(10 * i));
        const std::array<double, 16> matrix = in_millimetres(expected);
        for (std::size_t k = 0; k < 16; ++k) EXPECT_NEAR(read[k], matrix[k], 1e-10) << k;
        EXPECT_NEAR(plain[4], expected.p.x, 1e-12);
        EXPECT_NEAR(in.latest(s.pose, at_ns(10 * i)).values[4], expected.p.x, 1e-12);
      };
      shows(s.world, X);
      shows(before, old);  // the clone has what it had
      EXPECT_LT(difference(query.latest(at_ns(10 * i)).pose, X), 1e-12);
      const std::int64_t few = std::min<std::int64_t>(i, 10);
      for (std::int64_t back = 1; back <= few; ++back) {
        std::array<double, 16> then;
        const World::BlockBuffer one[] = {{0, then.data(), sizeof then}};
        ASSERT_EQ(s.world.read_blocks_at(s.pose, at_ns(10 * back + 10 * (i - few)), one),
                  Status::kOk);
        const std::array<double, 16> expected =
            in_millimetres(history[static_cast<std::size_t>(back + i - few - 1)]);
        for (std::size_t k = 0; k < 16; ++k) EXPECT_NEAR(then[k], expected[k], 1e-10);
      }
    }
    EXPECT_EQ(s.world.read_blocks_at(s.pose, at_ns(100000), {}), Status::kTooNew);
  }
}

// While the last value is corrected again and again, no reader sees one form of one value and
// another of the next.
TEST(Blocks, AgreeWhileTheLastValueIsCorrected) {
  Scene s;
  Writer writer = s.world.claim(s.pose, {"robot"});
  ASSERT_EQ(writer.write(at_ns(1), Pose{}), Status::kOk);
  std::atomic<bool> stop = false;
  std::thread correcting([&] {
    for (int i = 0; !stop; ++i) {
      writer.correct(at_ns(1), Pose{{}, {static_cast<double>(i), 0, 0}});
      if (i % 16 == 0) std::this_thread::yield();
    }
  });
  int read = 0, disagreed = 0, backwards = 0;
  const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(300);
  const auto at_last = until + std::chrono::seconds(20);  // on a busy machine
  while (std::chrono::steady_clock::now() < (read > 100 ? until : at_last)) {
    std::array<double, 16> matrix;
    double plain[7];
    const World::BlockBuffer both[] = {{0, matrix.data(), sizeof matrix}, {1, plain, sizeof plain}};
    const World::Sample before = s.world.latest(s.pose, at_ns(1));
    if (s.world.read_blocks(s.pose, both) != Status::kOk) continue;
    ++read;
    // What the measurement has shown, no block takes back, and the other way round.
    if (before.status == Status::kOk && before.values[4] > plain[4]) ++backwards;
    if (std::abs(matrix[3] - 1000 * plain[4]) > 1e-6) ++disagreed;
    const World::Sample own = s.world.latest(s.pose, at_ns(1));
    if (own.status == Status::kOk && own.values[4] < plain[4]) ++backwards;
  }
  stop = true;
  correcting.join();
  EXPECT_GT(read, 100);
  EXPECT_EQ(disagreed, 0);
  EXPECT_EQ(backwards, 0);
}

TEST(Blocks, AgreeAtEveryInstant) {
  Scene s;
  std::atomic<bool> stop = false;
  std::atomic<int> wrong = 0, answers = 0;
  s.world.write(s.pose, at_ns(0), Pose{}, {});
  std::thread reader([&] {
    while (!stop) {
      std::array<double, 16> matrix;
      double plain[7];
      const World::BlockBuffer both[] = {{0, matrix.data(), sizeof matrix},
                                         {1, plain, sizeof plain}};
      if (s.world.read_blocks(s.pose, both) != Status::kOk) continue;
      ++answers;
      if (std::abs(matrix[3] - 1000 * plain[4]) > 1e-9) ++wrong;
    }
  });
  Writer writer = s.world.claim(s.pose, {"robot"});
  // On a busy machine the reader may get its turn late.
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  for (int i = 1; i < 200'000 || answers <= 100; ++i) {
    writer.write(at_ns(i), {{}, {static_cast<double>(i), 0, 0}});
    if (i % 100'000 == 0 && std::chrono::steady_clock::now() > until) break;
  }
  stop = true;
  reader.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(answers, 100);
}

TEST(Blocks, FaultsAreNamed) {
  Scene s;
  const auto refused = [&](BlocksSpec blocks) -> std::string {
    try {
      s.world.add_measurement(
          {.name = "http://x/bad", .relation = s.relation, .blocks = std::move(blocks)});
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(refused({.library = library(), .blocks = {{"http://x/n", "nothing"}}})
                .find("http://x/n: there is no data prototype 'nothing'"),
            std::string::npos);
  EXPECT_NE(refused({.library = library(), .blocks = {{"http://x/p", "pendant"}}})
                .find("sinew_world_pose"),
            std::string::npos);
  EXPECT_NE(refused({.library = library(),
                     .canonical = "controller_pose",
                     .blocks = {{"http://x/c", "controller_pose"}}})
                .find("is not 7 doubles in a row"),
            std::string::npos);
  float value = 0;
  EXPECT_THROW(s.world.write_block(s.pose, 0, at_ns(1), &value, sizeof value, {}), Error);
}

TEST(Blocks, AreDescribedInTheGraph) {
  Scene s;
  graph::Store& store = s.world.graph();
  const auto id = [&](std::string_view iri) { return store.terms().find_iri(iri); };
  const auto w = [&](std::string_view term) {
    return id("https://w3id.org/sinew/world#" + std::string(term));
  };
  EXPECT_TRUE(store.view().contains(id("http://x/pose/controller"), w("consistency"),
                                    id("http://x/pose/data")));
  EXPECT_TRUE(store.view().contains(id("http://x/angle/display"), w("derived"),
                                    store.terms().boolean(true)));
  EXPECT_FALSE(store.view().object(id("http://x/angle/pendant"), w("derived")));
}

}  // namespace
}  // namespace sinew::world
