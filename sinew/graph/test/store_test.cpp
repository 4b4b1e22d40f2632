#include "sinew/graph/store.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sinew/base/error.h"

namespace sinew::graph {
namespace {

// A store with terms t(1), t(2), …
struct Fixture : ::testing::Test {
  Fixture() {
    for (int i = 0; i < 50; ++i)
      terms.push_back(store.terms().iri("http://x/" + std::to_string(i)));
  }
  Id t(int number) const { return terms[number]; }
  static std::vector<Quad> all(const View& view, Id s, Id p, Id o,
                               Dataset dataset = Dataset::kUnion) {
    std::vector<Quad> found;
    view.match(s, p, o, dataset, [&](const Quad& quad) {
      found.push_back(quad);
      return true;
    });
    return found;
  }
  Store store;
  std::vector<Id> terms;
};

using StoreTest = Fixture;
using TransactionTest = Fixture;
using SnapshotTest = Fixture;
using GraphTest = Fixture;

TEST_F(StoreTest, FindsByEveryPattern) {
  const Quad quad{t(1), t(2), t(3)};
  EXPECT_TRUE(store.add(quad));
  EXPECT_FALSE(store.add(quad));
  store.add({t(4), t(5), t(6)});
  const View view = store.view();
  for (int bound = 0; bound < 8; ++bound) {
    const Id s = bound & 1 ? t(1) : Id{}, p = bound & 2 ? t(2) : Id{}, o = bound & 4 ? t(3) : Id{};
    EXPECT_EQ(all(view, s, p, o).size(), bound == 0 ? 2u : 1u) << bound;
  }
  EXPECT_TRUE(all(view, t(3), {}, {}).empty());
  EXPECT_TRUE(all(view, t(1), t(5), {}).empty());
  EXPECT_EQ(view.object(t(1), t(2)), t(3));
  EXPECT_EQ(view.subject(t(2), t(3)), t(1));
  EXPECT_EQ(view.object(t(2), t(1)), Id{});
  EXPECT_EQ(view.size(), 2u);
}

TEST_F(StoreTest, GivesTriplesInTheOrderInWhichTheyWereAdded) {
  for (const int object : {7, 3, 9, 1}) store.add({t(0), t(1), t(object)});
  std::vector<Id> objects;
  for (const Quad& quad : all(store.view(), t(0), t(1), {})) objects.push_back(quad.object);
  EXPECT_EQ(objects, (std::vector<Id>{t(7), t(3), t(9), t(1)}));
}

TEST_F(StoreTest, StopsWhenTheVisitorSaysSo) {
  for (int i = 0; i < 5; ++i) store.add({t(0), t(1), t(10 + i)});
  int seen = 0;
  EXPECT_FALSE(
      store.view().match(t(0), {}, {}, Dataset::kUnion, [&](const Quad&) { return ++seen < 2; }));
  EXPECT_EQ(seen, 2);
}

TEST_F(StoreTest, CanBeWrittenToWhileItIsMatched) {
  for (int i = 0; i < 20; ++i) store.add({t(0), t(1), t(i)});
  int seen = 0;
  store.view().match(t(0), t(1), {}, Dataset::kUnion, [&](const Quad& quad) {
    // Far more writes than would lead to a copy of the store, were nobody matching.
    for (std::uint32_t i = 0; i < kWorthCompacting; ++i) {
      store.add({quad.object, t(2), t(30)});
      store.remove({quad.object, t(2), t(30)});
    }
    store.remove(quad);
    ++seen;
    return true;
  });
  EXPECT_EQ(seen, 20);
  EXPECT_EQ(store.view().size(), 0u);
}

TEST_F(StoreTest, RefusesIdsThatAreNoTerms) {
  EXPECT_THROW(store.add({Id{}, t(1), t(2)}), Error);
  EXPECT_THROW(store.add({t(1), t(2), Id{1'000'000}}), Error);
  EXPECT_THROW(store.add({t(1), t(2), t(3), Id{1'000'000}}), Error);
  EXPECT_EQ(store.view().size(), 0u);
}

TEST_F(StoreTest, RefusesToGrowBeyondItsLimitButGoesOnAfterRemovals) {
  Store small(StoreLimits{.terms = kMaxTerms, .quads = 10});
  std::vector<Id> ids;
  for (int i = 0; i < 30; ++i) ids.push_back(small.terms().integer(i));
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(small.add({ids[i], ids[0], ids[1]}));
  EXPECT_THROW(small.add({ids[10], ids[0], ids[1]}), Error);
  EXPECT_EQ(small.view().size(), 10u);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(small.remove({ids[i], ids[0], ids[1]}));
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(small.add({ids[20 + i], ids[0], ids[1]}));
  EXPECT_THROW(small.add({ids[10], ids[0], ids[1]}), Error);
  EXPECT_EQ(small.view().size(), 10u);
}

TEST_F(StoreTest, EstimatesAreUpperBoundsFromCounters) {
  for (int i = 0; i < 10; ++i) store.add({t(i), t(20), t(30 + i % 2)});
  store.add({t(0), t(20), t(40)});
  const View view = store.view();
  EXPECT_EQ(view.estimate({}, t(20), {}), 11u);
  EXPECT_EQ(view.estimate({}, t(20), t(30)), 5u);
  EXPECT_EQ(view.estimate(t(0), t(20), {}), 2u);
  EXPECT_EQ(view.estimate(t(0), t(20), t(40)), 1u);
  EXPECT_EQ(view.estimate(t(0), t(21), {}), 0u);
  EXPECT_EQ(view.estimate({}, {}, {}), 11u);
  EXPECT_EQ(view.distinct_subjects(t(20)), 10u);
  EXPECT_EQ(view.distinct_objects(t(20)), 3u);
  EXPECT_EQ(view.distinct_subjects(t(1)), 0u);
}

TEST_F(StoreTest, KeepsListsShortWhileValuesAreReplaced) {
  store.add({t(0), t(1), t(10)});
  for (int i = 0; i < 1000; ++i) {
    Transaction transaction = store.begin();
    transaction.remove({t(0), t(1), t(10 + i % 20)});
    transaction.add({t(0), t(1), t(10 + (i + 1) % 20)});
    transaction.commit();
  }
  EXPECT_LE(store.view().estimate(t(0), t(1), {}), 8u);
  EXPECT_LE(store.view().estimate({}, t(1), {}), 8u);
  EXPECT_LE(store.view().distinct_objects(t(1)), 21u);
  EXPECT_EQ(all(store.view(), t(0), {}, {}).size(), 1u);
}

TEST_F(StoreTest, CopiesHaveALifeOfTheirOwn) {
  store.add({t(0), t(1), t(2)});
  store.add({t(0), t(1), t(2), t(3)});
  store.add({t(4), t(1), t(2)});
  store.remove({t(4), t(1), t(2)});
  Store copy = store.clone();
  store.add({t(5), t(5), t(5)});
  copy.add({t(6), t(6), t(6)});
  EXPECT_EQ(copy.view().size(), 2u);
  EXPECT_TRUE(copy.view().contains_in({t(0), t(1), t(2), t(3)}));
  EXPECT_FALSE(copy.view().contains(t(5), t(5), t(5)));
  EXPECT_FALSE(store.view().contains(t(6), t(6), t(6)));
  EXPECT_EQ(copy.terms().iri("http://x/7"), t(7));
}

// ---- transactions ----

TEST_F(TransactionTest, ItsChangesAreSeenByOthersOnCommit) {
  Transaction transaction = store.begin();
  EXPECT_TRUE(transaction.add({t(0), t(1), t(2)}));
  EXPECT_TRUE(transaction.view().contains(t(0), t(1), t(2)));
  EXPECT_EQ(transaction.view().size(), 1u);
  EXPECT_FALSE(store.view().contains(t(0), t(1), t(2)));
  EXPECT_EQ(store.view().size(), 0u);
  transaction.commit();
  EXPECT_TRUE(store.view().contains(t(0), t(1), t(2)));
  EXPECT_THROW(transaction.add({t(0), t(1), t(3)}), Error);
}

TEST_F(TransactionTest, LeavesNoTraceWithoutCommit) {
  store.add({t(0), t(1), t(2)});
  {
    Transaction transaction = store.begin();
    transaction.remove({t(0), t(1), t(2)});
    transaction.add({t(0), t(1), t(3)});
    transaction.add({t(0), t(1), t(2), t(9)});
    transaction.create_graph(t(8));
    EXPECT_FALSE(transaction.view().contains_in({t(0), t(1), t(2)}));
  }
  EXPECT_EQ(all(store.view(), {}, {}, {}), (std::vector<Quad>{{t(0), t(1), t(2)}}));
  EXPECT_FALSE(store.view().has_graph(t(8)));
  EXPECT_FALSE(store.view().has_graph(t(9)));
  EXPECT_EQ(store.view().distinct_objects(t(1)), 1u);
  EXPECT_TRUE(store.add({t(0), t(1), t(3)}));
}

TEST_F(TransactionTest, TakesBackToAMark) {
  Transaction transaction = store.begin();
  transaction.add({t(0), t(1), t(2)});
  const auto outer = transaction.mark();
  transaction.add({t(0), t(1), t(3)});
  const auto inner = transaction.mark();
  transaction.remove({t(0), t(1), t(2)});
  transaction.add({t(0), t(1), t(4)});
  transaction.undo_to(inner);
  EXPECT_EQ(all(transaction.view(), t(0), t(1), {}),
            (std::vector<Quad>{{t(0), t(1), t(2)}, {t(0), t(1), t(3)}}));
  transaction.undo_to(outer);
  transaction.add({t(0), t(1), t(5)});
  transaction.commit();
  EXPECT_EQ(all(store.view(), t(0), t(1), {}),
            (std::vector<Quad>{{t(0), t(1), t(2)}, {t(0), t(1), t(5)}}));
}

// The tables of pairs grow meanwhile, and other triples take the records that are free again.
TEST_F(TransactionTest, TakesBackManyTriplesWhateverGrewMeanwhile) {
  const auto node = [&](int i) { return store.terms().iri("http://e/n" + std::to_string(i)); };
  const Id is = node(0);
  Transaction transaction = store.begin();
  for (int i = 1; i <= 50; ++i) transaction.add({node(i), is, node(i + 1)});
  for (const int count : {10, 3000, 100, 9000}) {
    const auto mark = transaction.mark();
    for (int i = 1; i <= count; ++i) {
      transaction.add({node(i), is, node(i + count)});
      transaction.add({node(i), node(i + 1), node(i % 7)});
    }
    EXPECT_EQ(transaction.view().size(), 50u + 2 * static_cast<std::size_t>(count));
    transaction.undo_to(mark);
    const View view = transaction.view();
    EXPECT_EQ(view.size(), 50u);
    EXPECT_EQ(view.distinct_subjects(is), 50u);
    EXPECT_EQ(view.distinct_objects(is), 50u);
    for (int i = 1; i <= count; ++i) {
      std::vector<Id> found;
      view.match(node(i), is, {}, Dataset::kUnion,
                 [&](const Quad& quad) { return found.push_back(quad.object), true; });
      EXPECT_EQ(found, i <= 50 ? std::vector<Id>{node(i + 1)} : std::vector<Id>{});
      EXPECT_FALSE(view.contains(node(i), node(i + 1), node(i % 7)));
    }
  }
}

TEST_F(TransactionTest, ASecondOneOfTheSameThreadIsAnErrorNotADeadlock) {
  Transaction transaction = store.begin();
  EXPECT_THROW(store.begin(), Error);
  EXPECT_THROW(store.add({t(0), t(1), t(2)}), Error);
  transaction.commit();
  EXPECT_TRUE(store.add({t(0), t(1), t(2)}));
}

// ---- snapshots ----

TEST_F(SnapshotTest, KeepsSeeingTheOldValueWhileAWriterCommits) {
  store.add({t(0), t(1), t(2)});
  const Snapshot before = store.snapshot();
  Transaction transaction = store.begin();
  transaction.remove({t(0), t(1), t(2)});
  transaction.add({t(0), t(1), t(3)});
  EXPECT_EQ(before.object(t(0), t(1)), t(2));
  transaction.commit();
  EXPECT_EQ(before.object(t(0), t(1)), t(2));
  EXPECT_EQ(before.size(), 1u);
  EXPECT_EQ(store.snapshot().object(t(0), t(1)), t(3));
}

TEST_F(SnapshotTest, SurvivesTheCopyThatFreesDeadRecordsAndTheStoreItself) {
  auto short_lived = std::make_unique<Store>();
  const Id a = short_lived->terms().iri("http://x/a"), b = short_lived->terms().iri("http://x/b");
  short_lived->add({a, a, b});
  Snapshot first = short_lived->snapshot();
  for (std::uint32_t i = 0; i < 3 * kWorthCompacting; ++i) {
    short_lived->remove({a, a, b});
    short_lived->add({a, a, b});
  }
  short_lived->remove({a, a, b});
  const Snapshot second = short_lived->snapshot();
  const Snapshot copy = first;
  first = second;
  EXPECT_FALSE(first.contains(a, a, b));
  EXPECT_TRUE(copy.contains(a, a, b));
  short_lived.reset();
  EXPECT_TRUE(copy.contains(a, a, b));
  EXPECT_EQ(copy.terms().text(a), "http://x/a");
}

TEST_F(SnapshotTest, AnOldOneDoesNotMakeRemovalsSlow) {
  // Every removal would walk everything that the snapshot keeps, were sweeping not patient.
  const Snapshot old = store.snapshot();
  for (int i = 0; i < 20'000; ++i) {
    store.add({t(0), t(1), t(2)});
    store.remove({t(0), t(1), t(2)});
  }
  EXPECT_EQ(old.size(), 0u);
  EXPECT_EQ(store.view().size(), 0u);
}

// ---- graphs ----

TEST_F(GraphTest, TheUnionHoldsATripleOnceWhicheverGraphsHoldIt) {
  for (const Id graph : {Id{}, t(10), t(11)}) EXPECT_TRUE(store.add({t(0), t(1), t(2), graph}));
  EXPECT_FALSE(store.add({t(0), t(1), t(2), t(11)}));
  const View view = store.view();
  EXPECT_EQ(all(view, {}, {}, {}).size(), 1u);
  EXPECT_EQ(view.size(), 1u);
  int named = 0;
  view.match_named({}, t(1), {}, [&](const Quad& quad) {
    EXPECT_TRUE(quad.graph == t(10) || quad.graph == t(11));
    ++named;
    return true;
  });
  EXPECT_EQ(named, 2);
  EXPECT_TRUE(store.remove({t(0), t(1), t(2)}));
  EXPECT_FALSE(store.remove({t(0), t(1), t(2)}));
  EXPECT_FALSE(view.contains(t(0), t(1), t(2), Dataset::kDefault));
  EXPECT_TRUE(view.contains(t(0), t(1), t(2), Dataset::kUnion));
  store.remove({t(0), t(1), t(2), t(10)});
  store.remove({t(0), t(1), t(2), t(11)});
  EXPECT_FALSE(view.contains(t(0), t(1), t(2)));
}

TEST_F(GraphTest, TheDefaultDatasetIsTheUnnamedGraphAlone) {
  store.add({t(0), t(1), t(2)});
  store.add({t(0), t(1), t(3), t(10)});
  const View view = store.view();
  EXPECT_EQ(all(view, t(0), {}, {}, Dataset::kDefault).size(), 1u);
  EXPECT_EQ(all(view, {}, {}, {}, Dataset::kDefault).size(), 1u);
  EXPECT_EQ(all(view, t(0), {}, {}, Dataset::kUnion).size(), 2u);
}

TEST_F(GraphTest, ExistsWhileItHoldsATripleOrWasCreated) {
  const auto graphs = [&] {
    std::vector<Id> found;
    store.view().named_graphs([&](Id graph) {
      found.push_back(graph);
      return true;
    });
    return found;
  };
  store.add({t(0), t(1), t(2), t(10)});
  {
    Transaction transaction = store.begin();
    transaction.create_graph(t(11));
    transaction.create_graph(t(11));
    transaction.commit();
  }
  EXPECT_EQ(graphs(), (std::vector<Id>{t(10), t(11)}));
  const Snapshot before = store.snapshot();
  {
    Transaction transaction = store.begin();
    transaction.clear(t(10));
    transaction.drop_graph(t(11));
    transaction.commit();
  }
  EXPECT_TRUE(graphs().empty());
  EXPECT_TRUE(before.has_graph(t(10)));
  EXPECT_TRUE(before.has_graph(t(11)));
  EXPECT_FALSE(before.has_graph(t(12)));
}

}  // namespace
}  // namespace sinew::graph
