// The store against the simplest model of it: a std::set of quads for each version.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sinew/graph/store.h"

namespace sinew::graph {
namespace {

struct Model {
  std::set<Quad> quads;
  std::set<Id> created;
  bool operator==(const Model&) const = default;
};

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  int below(int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(engine_); }
  // Few terms, so that quads meet; now and then the null id, where it is allowed.
  Id term(const std::vector<Id>& terms, bool or_none) {
    return or_none && below(2) == 0 ? Id{} : terms[below(static_cast<int>(terms.size()))];
  }

 private:
  std::mt19937 engine_;
};

bool matches(const Quad& quad, Id s, Id p, Id o) {
  return (!s || quad.subject == s) && (!p || quad.predicate == p) && (!o || quad.object == o);
}

std::set<Quad> collect(auto&& match) {
  std::set<Quad> found;
  match([&](const Quad& quad) {
    EXPECT_TRUE(found.insert(quad).second) << "a match came twice";
    return true;
  });
  return found;
}

void expect_same(const View& view, const Model& model, const std::vector<Id>& terms,
                 Random& random) {
  for (int i = 0; i < 6; ++i) {
    const Id s = random.term(terms, true), p = random.term(terms, true),
             o = random.term(terms, true);
    const Id g = random.term(terms, true);
    std::set<Quad> in_union, in_default, in_graph, named;
    for (const Quad& quad : model.quads) {
      if (!matches(quad, s, p, o)) continue;
      in_union.insert({quad.subject, quad.predicate, quad.object});
      if (!quad.graph) in_default.insert(quad);
      if (quad.graph == g) in_graph.insert(quad);
      if (quad.graph) named.insert(quad);
    }
    EXPECT_EQ(collect([&](auto visit) { view.match(s, p, o, Dataset::kUnion, visit); }), in_union);
    EXPECT_EQ(collect([&](auto visit) { view.match(s, p, o, Dataset::kDefault, visit); }),
              in_default);
    EXPECT_EQ(collect([&](auto visit) { view.match_in(s, p, o, g, visit); }), in_graph);
    EXPECT_EQ(collect([&](auto visit) { view.match_named(s, p, o, visit); }), named);
    EXPECT_GE(view.estimate(s, p, o), in_union.size());
    EXPECT_EQ(view.contains(s, p, o), !in_union.empty());
    EXPECT_EQ(view.contains_in({s, p, o, g}), !in_graph.empty());
    if (p) {
      std::set<Id> subjects, objects;
      for (const Quad& quad : model.quads) {
        if (quad.predicate == p) subjects.insert(quad.subject), objects.insert(quad.object);
      }
      EXPECT_GE(view.distinct_subjects(p), subjects.size());
      EXPECT_GE(view.distinct_objects(p), objects.size());
    }
  }
  std::set<Quad> triples;
  std::set<Id> graphs = model.created, found;
  for (const Quad& quad : model.quads) {
    triples.insert({quad.subject, quad.predicate, quad.object});
    if (quad.graph) graphs.insert(quad.graph);
  }
  EXPECT_EQ(view.size(), triples.size());
  view.named_graphs([&](Id graph) { return found.insert(graph).second; });
  EXPECT_EQ(found, graphs);
}

// One random change, the same to the transaction and to the model.
void change(Transaction& transaction, Model& model, const std::vector<Id>& terms, Random& random) {
  const Quad quad{random.term(terms, false), random.term(terms, false), random.term(terms, false),
                  random.term(terms, true)};
  const int what = random.below(100);
  if (what < 55) {
    EXPECT_EQ(transaction.add(quad), model.quads.insert(quad).second);
  } else if (what < 95) {
    // Mostly one that is there.
    const auto found = model.quads.lower_bound(quad);
    const Quad victim = found == model.quads.end() ? quad : *found;
    EXPECT_EQ(transaction.remove(victim), model.quads.erase(victim) == 1);
  } else if (what < 97) {
    if (quad.graph) {
      transaction.create_graph(quad.graph);
      model.created.insert(quad.graph);
    }
  } else {
    transaction.drop_graph(quad.graph);
    std::erase_if(model.quads, [&](const Quad& other) { return other.graph == quad.graph; });
    model.created.erase(quad.graph);
  }
}

void run(unsigned seed, int rounds, int universe) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  Store store;
  std::vector<Id> terms;
  for (int i = 0; i < universe; ++i) terms.push_back(store.terms().integer(i));
  Model present;
  std::vector<std::pair<Snapshot, Model>> snapshots;

  for (int round = 0; round < rounds && !::testing::Test::HasFailure(); ++round) {
    Transaction transaction = store.begin();
    Model changed = present;
    std::vector<std::pair<Transaction::Mark, Model>> marks;
    for (int step = random.below(30); step > 0; --step) {
      change(transaction, changed, terms, random);
      if (random.below(6) == 0) marks.emplace_back(transaction.mark(), changed);
      if (random.below(8) == 0 && !marks.empty()) {
        const auto keep = static_cast<std::size_t>(random.below(static_cast<int>(marks.size())));
        transaction.undo_to(marks[keep].first);
        changed = marks[keep].second;
        marks.resize(keep + 1);
      }
    }
    expect_same(transaction.view(), changed, terms, random);
    expect_same(store.view(), present, terms, random);
    if (random.below(4) != 0) {
      transaction.commit();
      present = changed;
    } else {
      const Transaction rolled_back = std::move(transaction);
    }
    expect_same(store.view(), present, terms, random);

    if (random.below(5) == 0) snapshots.emplace_back(store.snapshot(), present);
    if (random.below(6) == 0 && !snapshots.empty()) {
      snapshots.erase(snapshots.begin() + random.below(static_cast<int>(snapshots.size())));
    }
    if (!snapshots.empty()) {
      const auto& [snapshot, then] = snapshots[random.below(static_cast<int>(snapshots.size()))];
      expect_same(snapshot, then, terms, random);
    }
    if (random.below(50) == 0) expect_same(store.clone().view(), present, terms, random);
  }
}

TEST(StoreModel, AgreesOnRandomHistoriesOfFewTerms) {
  for (unsigned seed = 0; seed < 20; ++seed) run(seed, 150, 5);
}

TEST(StoreModel, AgreesOnRandomHistoriesOfMoreTerms) {
  for (unsigned seed = 100; seed < 110; ++seed) run(seed, 150, 12);
}

TEST(StoreModel, AgreesOnALongHistoryThatIsCompacted) { run(1000, 3000, 6); }

}  // namespace
}  // namespace sinew::graph
