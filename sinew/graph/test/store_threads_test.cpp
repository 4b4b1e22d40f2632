// Readers of snapshots beside a writer. Meant to be run with -fsanitize=thread as well.
#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "sinew/graph/store.h"

namespace sinew::graph {
namespace {

// The invariant that every committed version keeps: the same number n of triples in each of the
// patterns, and `state` has exactly one value, n.
struct World {
  Store store;
  Id has, is, state, value;
  std::vector<Id> items, numbers;

  World() {
    Terms& terms = store.terms();
    has = terms.iri("http://x/has");
    is = terms.iri("http://x/is");
    state = terms.iri("http://x/state");
    value = terms.iri("http://x/value");
    for (int i = 0; i < 200; ++i) {
      items.push_back(terms.iri("http://x/item" + std::to_string(i)));
      numbers.push_back(terms.integer(i));
    }
    Transaction transaction = store.begin();
    transaction.add({state, value, numbers[0]});
    transaction.commit();
  }

  static std::size_t count(const View& view, Id s, Id p, Id o) {
    std::size_t n = 0;
    view.match(s, p, o, Dataset::kUnion, [&](const Quad&) { return ++n > 0; });
    return n;
  }

  void check(const View& view) const {
    const Id held = view.object(state, value);
    ASSERT_EQ(count(view, state, value, {}), 1u);
    const auto n = static_cast<std::size_t>(*view.terms().integer_value(held));
    EXPECT_EQ(count(view, state, has, {}), n);
    EXPECT_EQ(count(view, {}, is, state), n);
    EXPECT_EQ(count(view, {}, has, {}), n);
    EXPECT_EQ(count(view, {}, {}, {}), 2 * n + 1);
    EXPECT_EQ(view.size(), 2 * n + 1);
    std::size_t in_graph = 0;
    view.match_in({}, {}, {}, has, [&](const Quad&) { return ++in_graph > 0; });
    EXPECT_EQ(in_graph, n);
  }

  void grow_to(Transaction& transaction, std::size_t from, std::size_t to) const {
    for (; from < to; ++from) {
      transaction.add({state, has, items[from], has});
      transaction.add({items[from], is, state});
    }
    for (; from > to; --from) {
      transaction.remove({state, has, items[from - 1], has});
      transaction.remove({items[from - 1], is, state});
    }
  }
};

TEST(SnapshotThreads, TwoReadersSeeWholeVersionsOnlyWhileAWriterWrites) {
  World world;
  std::atomic<bool> done = false;
  std::atomic<int> checks = 0;
  const auto read = [&] {
    while (!done) {
      const Snapshot snapshot = world.store.snapshot();
      const Id before = snapshot.object(world.state, world.value);
      for (int i = 0; i < 3; ++i) world.check(snapshot);
      EXPECT_EQ(snapshot.object(world.state, world.value), before);
      ++checks;
    }
  };
  std::thread first(read), second(read);

  std::size_t n = 0;
  unsigned step = 12345;
  for (int round = 0; round < 1500 || checks < 20; ++round) {
    step = step * 1664525u + 1013904223u;
    const std::size_t next = step / 16u % world.items.size();
    Transaction transaction = world.store.begin();
    // A search that is given up: its records are used again.
    const auto mark = transaction.mark();
    world.grow_to(transaction, n, (next * 7) % world.items.size());
    transaction.undo_to(mark);
    // Terms are added meanwhile, too.
    transaction.add({world.store.terms().integer(1'000'000 + round), world.value, world.state});
    transaction.undo_to(mark);

    world.grow_to(transaction, n, next);
    if (n != next) {
      transaction.remove({world.state, world.value, world.numbers[n]});
      transaction.add({world.state, world.value, world.numbers[next]});
    }
    if (round % 5 == 0) continue;  // rolled back
    transaction.commit();
    n = next;
  }
  done = true;
  first.join();
  second.join();
  world.check(world.store.view());
  EXPECT_GE(checks, 20);
}

// Pairs of terms that become crowded while others look between them, also by what is taken back.
TEST(SnapshotThreads, WhatIsBetweenTwoTermsIsWholeWhileTheyBecomeCrowded) {
  constexpr std::size_t kPairs = 150, kLinks = 40;
  Store store;
  Terms& terms = store.terms();
  const Id value = terms.iri("http://x/value");
  std::vector<Id> from, to, links, numbers;
  for (std::size_t i = 0; i < kPairs; ++i) {
    from.push_back(terms.iri("http://x/from" + std::to_string(i)));
    to.push_back(terms.iri("http://x/to" + std::to_string(i)));
  }
  for (std::size_t i = 0; i <= kLinks; ++i) {
    links.push_back(terms.iri("http://x/link" + std::to_string(i)));
    numbers.push_back(terms.integer(static_cast<std::int64_t>(i)));
  }
  std::atomic<bool> done = false;
  std::atomic<int> checks = 0;
  const auto check = [&](const View& view) {
    for (std::size_t i = 0; i < kPairs; ++i) {
      const Id held = view.object(from[i], value);
      const auto n = held ? static_cast<std::size_t>(*view.terms().integer_value(held)) : 0;
      EXPECT_EQ(World::count(view, from[i], {}, to[i]), n);
      for (std::size_t link = 0; link < n; link += 7) {
        EXPECT_TRUE(view.contains(from[i], links[link], to[i]));
      }
    }
  };
  std::thread reader([&] {
    while (!done || checks == 0) {
      check(store.snapshot());
      ++checks;
    }
  });
  for (std::size_t round = 0; round < 3 * kPairs; ++round) {
    // Each pair comes three times: uncrowded, then crowded, then with more.
    const std::size_t i = round % kPairs;
    const std::size_t before = round / kPairs * 13, after = before + 13;
    Transaction transaction = store.begin();
    const auto mark = transaction.mark();
    for (std::size_t link = before; link < kLinks; ++link) {
      transaction.add({from[i], links[link], to[i]});
      transaction.add({from[i], links[link], value});
    }
    transaction.undo_to(mark);
    for (std::size_t link = before; link < after; ++link) {
      transaction.add({from[i], links[link], to[i]});
    }
    if (before > 0) transaction.remove({from[i], value, numbers[before]});
    transaction.add({from[i], value, numbers[after]});
    transaction.commit();
  }
  done = true;
  reader.join();
  check(store.view());
}

TEST(TransactionThreads, ASecondWriterWaitsForTheFirst) {
  Store store;
  const Id a = store.terms().iri("http://x/a");
  const Id b = store.terms().iri("http://x/b");
  Transaction first = store.begin();
  first.add({a, a, a});
  std::atomic<bool> began = false;
  std::thread other([&] {
    Transaction second = store.begin();
    began = true;
    EXPECT_TRUE(second.view().contains(a, a, a));
    second.add({b, b, b});
    second.commit();
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_FALSE(began);
  first.commit();
  other.join();
  EXPECT_EQ(store.view().size(), 2u);
}

}  // namespace
}  // namespace sinew::graph
