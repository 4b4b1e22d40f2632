// Transactions without a mark: of most that they add nothing is noted, yet all of it can be taken
// back, while others read.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <set>
#include <thread>
#include <vector>

#include "sinew/graph/store.h"

namespace sinew::graph {
namespace {

constexpr int kSubjects = 40, kPredicates = 4, kGraphs = 3, kOthers = 500;

// Few terms, so that lists are long, terms are crowded, and triples are in several graphs; and
// subjects with few triples, one after the other, as files have them. In a small store, and in one
// that is so large that lists are appended to later than triples are added.
struct Unmarked : ::testing::TestWithParam<int> {
  Unmarked() {
    for (int i = 0; i < 200 + kOthers; ++i) terms.push_back(store.terms().integer(i));
    Transaction transaction = store.begin();
    const Id predicate = store.terms().integer(-1);
    for (int i = 0; i < GetParam(); ++i) {
      transaction.add(
          {store.terms().integer(-2 - i / 7), predicate, store.terms().integer(-2 - i)});
    }
    transaction.commit();
  }
  int below(int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(random); }
  Quad any() {
    const int graph = below(kGraphs);
    if (left-- <= 0) {
      left = below(6);
      subject = below(2) == 0 ? terms[below(kSubjects)] : terms[200 + below(kOthers)];
    }
    return {subject, terms[100 + below(kPredicates)], terms[below(kSubjects)],
            graph == 0 ? Id{} : terms[120 + graph]};
  }
  // Each list that there is, in its order.
  std::vector<std::vector<Quad>> lists(const View& view) const {
    std::vector<std::vector<Quad>> found;
    const auto collect = [&] {
      return
          [&into = found.emplace_back()](const Quad& quad) { return into.push_back(quad), true; };
    };
    view.match({}, {}, {}, Dataset::kUnion, collect());
    for (int i = 0; i < kSubjects; ++i) {
      view.match(terms[i], {}, {}, Dataset::kUnion, collect());
      view.match({}, {}, terms[i], Dataset::kUnion, collect());
      view.match(terms[i], {}, terms[(i * 7) % kSubjects], Dataset::kUnion, collect());
      for (int p = 0; p < kPredicates; ++p) {
        view.match(terms[i], terms[100 + p], {}, Dataset::kUnion, collect());
        view.match({}, terms[100 + p], terms[i], Dataset::kUnion, collect());
      }
    }
    for (int i = 0; i < kOthers; ++i) {
      view.match(terms[200 + i], {}, {}, Dataset::kUnion, collect());
      view.match(terms[200 + i], terms[100], {}, Dataset::kUnion, collect());
    }
    for (int p = 0; p < kPredicates; ++p) {
      view.match({}, terms[100 + p], {}, Dataset::kUnion, collect());
      view.match_named({}, terms[100 + p], {}, collect());
    }
    view.match_in({}, {}, {}, {}, collect());
    for (int graph = 1; graph < kGraphs; ++graph) {
      view.match_in({}, {}, {}, terms[120 + graph], collect());
    }
    return found;
  }
  std::vector<std::size_t> counts(const View& view) const {
    std::vector<std::size_t> found = {view.size()};
    for (int p = 0; p < kPredicates; ++p) {
      found.push_back(view.distinct_subjects(terms[100 + p]));
      found.push_back(view.distinct_objects(terms[100 + p]));
    }
    return found;
  }
  // Mostly additions in runs; now and then another graph gets a triple, and one is removed.
  void change(Transaction& transaction, std::set<Quad>& model, int changes) {
    for (int i = 0; i < changes; ++i) {
      const int what = below(100);
      Quad quad = any();
      if (what < 5 && !model.empty()) {
        const auto victim = model.lower_bound(quad);
        if (victim != model.end()) quad = *victim;
        EXPECT_EQ(transaction.remove(quad), model.erase(quad) == 1);
        continue;
      }
      if (what < 10 && !model.empty()) {
        const auto other = model.lower_bound(quad);
        if (other != model.end()) quad = {other->subject, other->predicate, other->object, {}};
      }
      EXPECT_EQ(transaction.add(quad), model.insert(quad).second);
    }
  }
  std::mt19937 random{5};
  Id subject;
  int left = 0;  // quads of the subject
  Store store;
  std::vector<Id> terms;
};

INSTANTIATE_TEST_SUITE_P(Stores, Unmarked, testing::Values(0, 20'000));

TEST_P(Unmarked, WhatIsTakenBackLeavesAllListsAsTheyWere) {
  std::set<Quad> committed;
  for (int round = 0; round < 30; ++round) {
    SCOPED_TRACE(round);
    const auto lists_before = lists(store.view());
    const auto counts_before = counts(store.view());
    const int changes = 200 + below(1500);
    {
      Transaction gone = store.begin();
      std::set<Quad> model = committed;
      change(gone, model, changes);
      if (round % 3 == 0) {
        // A mark in between: what comes after it is taken back alone.
        const auto lists_at_mark = lists(gone.view());
        const auto mark = gone.mark();
        std::set<Quad> after = model;
        change(gone, after, 300);
        gone.undo_to(mark);
        EXPECT_EQ(lists(gone.view()), lists_at_mark);
      }
      std::set<Quad> held;
      for (const Id graph : {Id{}, terms[121], terms[122]}) {
        gone.view().match_in({}, {}, {}, graph, [&](const Quad& quad) {
          return quad.predicate.value < terms[100].value ||
                 quad.predicate.value > terms[104].value || held.insert(quad).second;
        });
      }
      EXPECT_EQ(held, model);
    }
    ASSERT_EQ(lists(store.view()), lists_before);
    ASSERT_EQ(counts(store.view()), counts_before);
    Transaction kept = store.begin();
    change(kept, committed, 20 + below(600));
    kept.commit();
  }
  EXPECT_GT(committed.size(), 1000u);
}

// The same lists, in the same order, as a transaction makes that somebody looks at all the time.
TEST_P(Unmarked, WhatIsAppendedToListsLaterComesInOrder) {
  std::set<Quad> model;
  for (int i = 0; i < 12'000; ++i) model.insert(any());
  std::vector<Quad> quads(model.begin(), model.end());
  std::shuffle(quads.begin(), quads.end(), random);
  for (std::size_t i = 0; i + 4 < quads.size(); i += 5) {  // some subjects' triples in a row
    std::sort(quads.begin() + static_cast<std::ptrdiff_t>(i),
              quads.begin() + static_cast<std::ptrdiff_t>(i + 5));
  }
  Store other = store.clone();
  Transaction seen = other.begin(), unseen = store.begin();
  EXPECT_EQ(seen.view().size(), other.view().size());
  for (std::size_t i = 0; i < quads.size(); ++i) {
    const Quad& again = quads[i / 2];
    EXPECT_TRUE(seen.add(quads[i]));
    EXPECT_TRUE(unseen.add(quads[i]));
    EXPECT_FALSE(seen.add(again));
    EXPECT_FALSE(unseen.add(again));
  }
  seen.commit();
  unseen.commit();
  EXPECT_EQ(lists(store.view()), lists(other.view()));
  EXPECT_EQ(counts(store.view()), counts(other.view()));
}

TEST_P(Unmarked, ReadersSeeNothingOfWhatComesAndGoes) {
  std::set<Quad> committed;
  Transaction first = store.begin();
  change(first, committed, 800);
  first.commit();
  const Snapshot snapshot = store.snapshot();
  const auto expected = lists(snapshot);
  std::atomic<bool> done = false;
  std::thread reader([&] {
    do {
      EXPECT_EQ(lists(snapshot), expected);
    } while (!done);
  });
  for (int round = 0; round < 20; ++round) {
    Transaction gone = store.begin();
    std::set<Quad> model = committed;
    change(gone, model, 1500);
  }
  done = true;
  reader.join();
  EXPECT_EQ(lists(store.view()), expected);
}

// A triple that its first graph gave up is still there in a further one, and may come back.
TEST_P(Unmarked, ATripleOutlivesTheGraphThatItWasAddedToFirst) {
  const Id s = terms[1], p = terms[100], o = terms[2], g = terms[121], h = terms[122];
  const std::size_t before = store.view().size();
  store.add({s, p, o, g});
  store.add({s, p, o, h});
  const Snapshot both = store.snapshot();
  EXPECT_TRUE(store.remove({s, p, o, g}));
  EXPECT_FALSE(store.remove({s, p, o, g}));
  const Snapshot one = store.snapshot();
  EXPECT_EQ(one.size(), before + 1);
  EXPECT_TRUE(one.contains(s, p, o));
  EXPECT_FALSE(one.contains_in({s, p, o, g}));
  EXPECT_TRUE(one.contains_in({s, p, o, h}));
  EXPECT_FALSE(one.has_graph(g));
  EXPECT_TRUE(store.add({s, p, o, g}));
  EXPECT_EQ(store.view().size(), before + 1);
  EXPECT_TRUE(store.remove({s, p, o, h}));
  EXPECT_TRUE(store.view().contains_in({s, p, o, g}));
  EXPECT_EQ(store.clone().view().size(), before + 1);
  EXPECT_TRUE(store.remove({s, p, o, g}));
  EXPECT_FALSE(store.view().contains(s, p, o));
  EXPECT_EQ(store.view().size(), before);
  EXPECT_TRUE(both.contains_in({s, p, o, g}));
  EXPECT_TRUE(one.contains(s, p, o));
  EXPECT_TRUE(store.add({s, p, o, h}));
  EXPECT_EQ(store.view().size(), before + 1);
}

}  // namespace
}  // namespace sinew::graph
