// Packed edges, and steps from node to node, against the view that they are of.
#include "sinew/graph/packed.h"

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "sinew/graph/store.h"

namespace sinew::graph {
namespace {

struct Random {
  explicit Random(unsigned seed) : engine(seed) {
    for (int i = 0; i < 40; ++i) terms.push_back(store.terms().integer(i));
  }
  Id any(unsigned among) { return terms[engine() % among]; }
  void change(int count) {
    Transaction transaction = store.begin();
    for (; count > 0; --count) {
      const Quad quad{any(40), any(4), any(40), engine() % 3 == 0 ? any(2) : Id{}};
      if (engine() % 4 == 0) {
        transaction.remove(quad);
      } else {
        transaction.add(quad);
      }
    }
    transaction.commit();
  }
  std::mt19937 engine;
  Store store;
  std::vector<Id> terms;
};

std::vector<Id> listed(std::span<const Id> ids) { return {ids.begin(), ids.end()}; }

TEST(Packed, HoldsEachNodesEdgesInTheOrderInWhichTheyWereAdded) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    Random random(seed);
    random.change(300);
    const Snapshot snapshot = random.store.snapshot();
    random.change(300);
    for (int p = 0; p <= 4; ++p) {
      const Id predicate = p == 4 ? Id{} : random.terms[p];
      const Adjacency out(snapshot, predicate, Direction::kOut);
      const Adjacency in(snapshot, predicate, Direction::kIn);
      EXPECT_EQ(out.size(), in.size());
      std::size_t nodes = 0;
      for (const Id node : random.terms) {
        std::vector<Id> objects, subjects;
        snapshot.match(node, predicate, {}, Dataset::kUnion,
                       [&](const Quad& quad) { return objects.push_back(quad.object), true; });
        snapshot.match({}, predicate, node, Dataset::kUnion,
                       [&](const Quad& quad) { return subjects.push_back(quad.subject), true; });
        EXPECT_EQ(listed(out.of(node)), objects);
        EXPECT_EQ(listed(in.of(node)), subjects);
        if (!objects.empty()) ++nodes;
      }
      std::size_t visited = 0, edges = 0;
      Id before;
      out.visit([&](Id node, std::span<const Id> objects) {
        EXPECT_LT(before, node);
        before = node;
        EXPECT_EQ(listed(objects), listed(out.of(node)));
        ++visited;
        edges += objects.size();
      });
      EXPECT_EQ(visited, nodes);
      EXPECT_EQ(edges, out.size());
    }
  }
}

TEST(Packed, KnowsNothingOfOtherNodes) {
  Random random(1);
  const Id a = random.terms[10], b = random.terms[20], p = random.terms[0];
  random.store.add({a, p, b});
  const auto out = random.store.edges(p, Direction::kOut);
  EXPECT_EQ(listed(out->of(a)), std::vector<Id>{b});
  for (const std::uint32_t id : {0u, 1u, a.value - 1, a.value + 1, b.value, UINT32_MAX}) {
    EXPECT_TRUE(out->of(Id{id}).empty()) << id;
  }
  EXPECT_TRUE(random.store.edges(random.terms[1], Direction::kIn)->of(a).empty());
  EXPECT_TRUE(Adjacency().of(a).empty());
}

TEST(Packed, AStoreKeepsThemAsLongAsNothingElseIsCommitted) {
  Random random(1);
  const Id a = random.terms[10], b = random.terms[20], p = random.terms[0];
  random.store.add({a, p, b});
  const auto out = random.store.edges(p, Direction::kOut),
             in = random.store.edges(p, Direction::kIn);
  EXPECT_EQ(random.store.edges(p, Direction::kOut), out);
  EXPECT_EQ(listed(in->of(b)), std::vector<Id>{a});
  {
    Transaction transaction = random.store.begin();
    transaction.add({b, p, a});
    EXPECT_EQ(random.store.edges(p, Direction::kOut), out);
  }
  EXPECT_EQ(random.store.edges(p, Direction::kOut), out);
  random.store.add({b, p, a});
  EXPECT_EQ(listed(random.store.edges(p, Direction::kOut)->of(b)), std::vector<Id>{a});
  EXPECT_TRUE(out->of(b).empty());
  EXPECT_EQ(listed(random.store.edges({}, Direction::kIn)->of(a)), std::vector<Id>{b});
  random.store.remove({a, p, b});
  EXPECT_TRUE(random.store.edges(p, Direction::kIn)->of(b).empty());
  // A copy without dead records has the same version.
  const auto last = random.store.edges(p, Direction::kOut);
  const auto of_clone = random.store.clone().edges(p, Direction::kOut);
  EXPECT_EQ(listed(of_clone->of(b)), listed(last->of(b)));
}

TEST(Packed, AreAskedForByManyThreadsBesideAWriter) {
  Random random(2);
  random.change(200);
  std::atomic<bool> done = false;
  std::vector<std::thread> readers;
  for (int i = 0; i < 3; ++i) {
    readers.emplace_back([&] {
      do {
        const auto out = random.store.edges(random.terms[0], Direction::kOut);
        std::size_t seen = 0;
        out->visit([&](Id, std::span<const Id> linked) { seen += linked.size(); });
        EXPECT_EQ(seen, out->size());
      } while (!done);
    });
  }
  for (int i = 0; i < 200; ++i) random.change(10);
  done = true;
  for (std::thread& reader : readers) reader.join();
}

TEST(Steps, LeadWhereTheViewLeads) {
  Random random(2);
  random.change(300);
  const Snapshot old = random.store.snapshot();
  random.change(300);
  for (const View& view : {View(old), random.store.view()}) {
    const Steps steps(view);
    for (const Id node : random.terms) {
      for (int p = 0; p < 4; ++p) {
        std::vector<Id> objects, subjects, expected_objects, expected_subjects;
        steps.objects(node, random.terms[p], [&](Id id) { return objects.push_back(id), true; });
        steps.subjects(random.terms[p], node, [&](Id id) { return subjects.push_back(id), true; });
        view.match(node, random.terms[p], {}, Dataset::kUnion,
                   [&](const Quad& quad) { return expected_objects.push_back(quad.object), true; });
        view.match({}, random.terms[p], node, Dataset::kUnion, [&](const Quad& quad) {
          return expected_subjects.push_back(quad.subject), true;
        });
        EXPECT_EQ(objects, expected_objects);
        EXPECT_EQ(subjects, expected_subjects);
      }
    }
  }
}

}  // namespace
}  // namespace sinew::graph
