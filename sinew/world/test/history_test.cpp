// Immutable entries that users hold and let go; the graph of a clone.
#include <gtest/gtest.h>

#include "random_poses.h"
#include "sinew/graph/store.h"
#include "sinew/world/edit.h"
#include "times_and_places.h"

namespace sinew::world {
namespace {

struct Kept {
  World world;
  FrameId a = world.add_frame("http://x/a"), b = world.add_frame("http://x/b");
  RelationId r = world.add_relation({.name = "http://x/r", .of = b, .with_respect_to = a});
  MeasurementId m =
      world.add_measurement({.name = "http://x/m",
                             .relation = r,
                             .model = {.used_by = {"http://x/logger", "http://x/learner"}},
                             .capacity = 4,
                             .keep_all = true});
  void write(int from, int to) {
    for (int i = from; i < to; ++i) {
      world.write(m, at_s(i), Pose{{}, {static_cast<double>(i), 0, 0}}, {"http://x/camera"});
    }
  }
};

TEST(History, HoldsEveryEntryAndNeverChangesOne) {
  Kept k;
  k.write(0, 100);
  const History first = k.world.history(k.m);
  ASSERT_EQ(first.size(), 100u);
  EXPECT_EQ(first[42]->values[4], 42);
  EXPECT_EQ(first[42]->provenance, "http://x/camera");
  k.world.write(k.m, at_s(99), Pose{{}, {-1, 0, 0}}, {});  // a correction is one more entry
  EXPECT_EQ(first.size(), 100u);
  EXPECT_EQ(first[99]->values[4], 99);
  EXPECT_EQ(k.world.history(k.m)[100]->values[4], -1);
}

TEST(History, LetsGoOfWhatEveryUserIsDoneWith) {
  Kept k;
  k.write(0, 50);
  const History taken = k.world.history(k.m);
  const std::weak_ptr<const HistoryEntry> early = taken[3], held = taken[5];
  const HistoryEntryPointer mine = taken[5];
  k.world.done(k.m, "http://x/logger", taken, 20);
  EXPECT_EQ(k.world.history(k.m).size(), 50u);  // the learner may still want them
  k.world.done(k.m, "http://x/learner", taken, 10);
  EXPECT_EQ(k.world.history(k.m).size(), 40u);
  EXPECT_EQ(k.world.history(k.m)[0]->values[4], 10);
  EXPECT_FALSE(early.expired());  // `taken` is a version that still has it
  EXPECT_EQ(mine, held.lock());
  EXPECT_THROW(k.world.done(k.m, "http://x/stranger", taken, 1), Error);
}

TEST(History, EntriesEndWithTheirLastHolder) {
  Kept k;
  k.write(0, 50);
  std::weak_ptr<const HistoryEntry> early;
  HistoryEntryPointer mine;
  {
    const History taken = k.world.history(k.m);
    early = taken[3];
    mine = taken[5];
    k.world.done(k.m, "http://x/logger", taken, 20);
    k.world.done(k.m, "http://x/learner", taken, 20);
  }
  EXPECT_TRUE(early.expired());
  EXPECT_EQ(mine->values[4], 5);
}

// ---- queries of the past ----

// What a ring that never overwrites answers, a small ring with a history answers, whatever was
// corrected meanwhile.
TEST(History, AnswersQueriesOfThePastBeyondTheRing) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 5; ++round) {
    World world;
    const FrameId a = world.add_frame("http://x/a"), b = world.add_frame("http://x/b");
    const auto relation = [&](const char* name) {
      return world.add_relation({.name = name, .of = b, .with_respect_to = a});
    };
    const RelationId kept_in = relation("http://x/r1"), all_in = relation("http://x/r2");
    const MeasurementId kept = world.add_measurement(
        {.name = "http://x/kept", .relation = kept_in, .capacity = 4, .keep_all = true});
    const MeasurementId all =
        world.add_measurement({.name = "http://x/all", .relation = all_in, .capacity = 1000});
    PreparedPose by_history =
        world.prepare_pose({.of = b, .with_respect_to = a, .avoid = {all_in}});
    PreparedPose by_ring = world.prepare_pose({.of = b, .with_respect_to = a, .avoid = {kept_in}});
    int last = 0;
    for (int i = 0; i < 300; ++i) {
      // One in four corrects the past, now and then one that the small ring has long forgotten.
      const int at = i > 10 && random() % 4 == 0
                         ? static_cast<int>(random() % static_cast<unsigned>(10 * i))
                         : last += 10;
      const Pose X = random_pose(random);
      ASSERT_EQ(world.write(kept, at_s(at), X, {}), Status::kOk);
      ASSERT_EQ(world.write(all, at_s(at), X, {}), Status::kOk);
    }
    for (int i = 0; i < 400; ++i) {
      const Stamp at = at_s(static_cast<double>(random() % static_cast<unsigned>(10 * last)) / 10);
      const PoseAnswer expected = by_ring.at(at), found = by_history.at(at);
      ASSERT_EQ(found.status, expected.status);
      const World::Sample sample = world.at(kept, at), same = world.at(all, at);
      ASSERT_EQ(sample.status, same.status);
      if (expected.status != Status::kOk) continue;
      ASSERT_EQ(difference(found.pose, expected.pose), 0);
      ASSERT_EQ(sample.values, same.values);
      ASSERT_EQ(sample.stamp, same.stamp);
      ASSERT_EQ(found.freshness.currency, expected.freshness.currency);
    }
    // In real time too, and a copy has its own place among the readers.
    const PreparedPose copy = by_history;
    EXPECT_EQ(difference(by_history.at_realtime(at_s(30)).pose, by_ring.at(at_s(30)).pose), 0);
    EXPECT_EQ(difference(copy.at_realtime(at_s(30)).pose, by_ring.at(at_s(30)).pose), 0);
  }
}

TEST(History, OfThePastEndsWithWhatWasLetGo) {
  Kept k;
  k.write(0, 100);
  PreparedPose query = k.world.prepare_pose({.of = k.b, .with_respect_to = k.a});
  EXPECT_NEAR(query.at(at_s(3.5)).pose.p.x, 3.5, 1e-12);
  for (const char* user : {"http://x/logger", "http://x/learner"}) {
    k.world.done(k.m, user, k.world.history(k.m), 20);
  }
  // 19 is gone, and nothing is guessed about what came after it.
  for (const double gone : {3.5, 19.0, 19.5}) {
    const PoseAnswer answer = query.at(at_s(gone));
    EXPECT_EQ(answer.status, Status::kTooOld) << gone;
    EXPECT_EQ(answer.bounds.oldest, at_s(20));
    EXPECT_EQ(answer.bounds.newest, at_s(99));
  }
  EXPECT_NEAR(query.at(at_s(20.5)).pose.p.x, 20.5, 1e-12);
  // A correction among what was let go comes too late; one later does not.
  EXPECT_EQ(k.world.write(k.m, at_s(3), Pose{}, {}), Status::kTooLate);
  EXPECT_EQ(query.at(at_s(10)).status, Status::kTooOld);
  EXPECT_EQ(k.world.write(k.m, at_s(30), Pose{}, {}), Status::kOk);
  EXPECT_EQ(query.at(at_s(30)).pose.p.x, 0);
}

TEST(History, AnswersThroughSeveralMeasurementsAndTheirMotion) {
  World world;
  const FrameId a = world.add_frame("http://x/a"), b = world.add_frame("http://x/b"),
                c = world.add_frame("http://x/c");
  const RelationId first =
      world.add_relation({.name = "http://x/r1", .of = b, .with_respect_to = a});
  const RelationId second =
      world.add_relation({.name = "http://x/r2", .of = c, .with_respect_to = b});
  std::vector<MeasurementId> poses, twists;
  for (const RelationId relation : {first, second}) {
    const std::string name = world.name(relation);
    poses.push_back(world.add_measurement(
        {.name = name + "/pose", .relation = relation, .capacity = 4, .keep_all = true}));
    twists.push_back(world.add_measurement({.name = name + "/twist",
                                            .relation = relation,
                                            .quantity = Quantity::kTwist,
                                            .capacity = 4,
                                            .keep_all = true}));
  }
  // The first moves at 1 m/s, the second at 2 m/s; the second has a ring that is enough.
  for (int i = 0; i < 60; ++i) {
    const double x = i;
    world.write(poses[0], at_s(i), Pose{{}, {x, 0, 0}}, {});
    world.write(poses[1], at_s(i), Pose{{}, {2 * x, 0, 0}}, {});
    for (std::size_t k = 0; k < 2; ++k) {
      const double twist[] = {0, 0, 0, static_cast<double>(k) + 1, 0, 0};
      world.write(twists[k], at_s(i), twist, {});
    }
  }
  PreparedMotion motion = world.prepare_motion({.of = c, .with_respect_to = a});
  const MotionAnswer answer = motion.at(at_s(7.25));
  ASSERT_EQ(answer.status, Status::kOk);
  EXPECT_NEAR(answer.pose.p.x, 3 * 7.25, 1e-12);
  EXPECT_NEAR(answer.twist.linear.x, 3, 1e-12);
  EXPECT_NEAR(motion.at_realtime(at_s(7.25)).twist.linear.x, 3, 1e-12);
}

TEST(History, IsTheClonesOwnAfterItWasMade) {
  Kept k;
  k.write(0, 10);
  World clone = k.world.clone();
  k.write(10, 20);
  clone.write(k.m, at_s(100), Pose{}, {});
  EXPECT_EQ(clone.history(k.m).size(), 11u);
  EXPECT_EQ(k.world.history(k.m).size(), 20u);
}

TEST(Graph, OfACloneHasTheUsersFactsAndItsOwnDescription) {
  Kept k;
  graph::Store& store = k.world.graph();
  graph::Terms& terms = store.terms();
  store.add({terms.iri("http://x/part"), terms.iri("http://x/colour"), terms.literal("red"), {}});
  World clone = k.world.clone();
  store.add({terms.iri("http://x/part"), terms.iri("http://x/colour"), terms.literal("blue"), {}});
  clone.add_frame("http://x/c");
  k.world.remove(k.b);
  graph::Store& of_clone = clone.graph();
  const auto has = [](graph::Store& in, const char* subject, const char* predicate,
                      graph::Id object) {
    return in.view().contains(in.terms().find_iri(subject), in.terms().find_iri(predicate), object);
  };
  EXPECT_TRUE(has(of_clone, "http://x/part", "http://x/colour", of_clone.terms().literal("red")));
  EXPECT_FALSE(has(of_clone, "http://x/part", "http://x/colour", of_clone.terms().literal("blue")));
  const char* const type = "http://www.w3.org/1999/02/22-rdf-syntax-ns#type";
  const char* const frame =
      "https://comp-rob2b.github.io/metamodels/geometry/structural-entities#Frame";
  EXPECT_TRUE(has(of_clone, "http://x/b", type, of_clone.terms().iri(frame)));
  EXPECT_TRUE(has(of_clone, "http://x/c", type, of_clone.terms().iri(frame)));
  EXPECT_FALSE(has(store, "http://x/b", type, terms.iri(frame)));
}

}  // namespace
}  // namespace sinew::world
