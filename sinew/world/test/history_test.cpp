// Immutable entries that users hold and let go; the graph of a clone.
#include <gtest/gtest.h>

#include "random_poses.h"
#include "sinew/graph/store.h"
#include "sinew/world/edit.h"

namespace sinew::world {
namespace {

Stamp at_s(double seconds) { return Stamp(duration_of_seconds(seconds)); }

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

TEST(History, IsTheClonesOwnAfterItWasMade) {
  Kept k;
  k.write(0, 10);
  World clone = k.world.clone();
  k.write(10, 20);
  clone.write(k.m, at_s(100), Pose{}, {});
  EXPECT_EQ(clone.history(k.m).size(), 11u);
  EXPECT_EQ(k.world.history(k.m).size(), 20u);
}

TEST(History, HasNoRealtimeWriter) {
  Kept k;
  EXPECT_THROW(k.world.claim(k.m, {"robot"}), Error);
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
