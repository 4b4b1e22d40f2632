// What held at a time: against clones that were made then, over random histories.
#include "sinew/world/fact_history.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "sinew/rdf/sparql/engine.h"
#include "sinew/world/edit.h"
#include "sinew/world/world.h"
#include "times_and_places.h"

namespace sinew::world {
namespace {

struct Facts {
  graph::Id iri(const std::string& name) { return store.terms().iri("http://x/" + name); }
  graph::Quad fact(const std::string& s, const std::string& p, const std::string& o,
                   const std::string& g = "") {
    return {iri(s), iri(p), iri(o), g.empty() ? graph::Id{} : iri(g)};
  }
  graph::Store store;
  FactHistory history;
};

// The rows of a query as text, sorted.
std::multiset<std::string> rows(graph::Store& store, const std::string& query) {
  const auto answer = rdf::sparql::query(store.view(), store.terms(), query);
  std::multiset<std::string> result;
  for (const auto& row : answer.results.rows) {
    std::string text;
    for (const graph::Id id : row) text += (id ? store.terms().to_string(id) : "-") + " ";
    result.insert(text);
  }
  return result;
}

TEST(FactHistory, KeepsIntervalsWithBeginAndEnd) {
  Facts x;
  const graph::Quad on = x.fact("bolt", "is-on", "table"), in = x.fact("bolt", "is-in", "gripper");
  x.store.add(on);
  x.history.observe(x.store, at_s(1));
  x.store.remove(on);
  x.store.add(in);
  x.history.observe(x.store, at_s(5));
  x.store.remove(in);
  x.store.add(on);
  x.history.observe(x.store, at_s(8));

  EXPECT_TRUE(x.history.held(on, at_s(1)));
  EXPECT_TRUE(x.history.held(on, at_s(5) - Duration(1)));
  EXPECT_FALSE(x.history.held(on, at_s(5)));  // ends where the other begins
  EXPECT_TRUE(x.history.held(in, at_s(5)));
  EXPECT_FALSE(x.history.held(in, at_s(8)));
  EXPECT_TRUE(x.history.held(on, at_s(8)));

  const auto all = x.history.intervals(x.iri("bolt"), {}, {});
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].begin, at_s(1));
  EXPECT_EQ(*all[0].end, at_s(5));
  EXPECT_EQ(all[1].fact, in);
  EXPECT_EQ(all[2].begin, at_s(8));
  EXPECT_FALSE(all[2].end);
  EXPECT_EQ(x.history.intervals({}, x.iri("is-on"), {}).size(), 2u);
}

// Everything that a clone made at a time answers, the history answers of that time.
TEST(FactHistory, AnswersAsTheCloneOfThatTimeDoes) {
  const std::string queries[] = {
      "SELECT * WHERE { ?s ?p ?o }", "SELECT * WHERE { GRAPH ?g { ?s ?p ?o } }",
      "SELECT ?s (COUNT(?o) AS ?n) WHERE { ?s <http://x/p0> ?o } GROUP BY ?s",
      "SELECT ?s WHERE { ?s <http://x/p0> ?o FILTER NOT EXISTS { ?s <http://x/p1> ?o } }"};
  std::mt19937_64 random(1);
  for (int round = 0; round < 5; ++round) {
    Facts x;
    std::map<int, graph::Store> clones;
    for (int second = 0; second < 40; ++second) {
      for (int change = 0; change < 6; ++change) {
        const auto pick = [&](const char* kind, unsigned of) {
          return kind + std::to_string(random() % of);
        };
        const graph::Quad fact =
            x.fact(pick("s", 4), pick("p", 2), pick("o", 3), random() % 3 ? "" : pick("g", 2));
        random() % 2 ? x.store.add(fact) : x.store.remove(fact);
      }
      x.history.observe(x.store, at_s(10 * second));
      clones.emplace(second, x.store.clone());
    }
    for (int second = 0; second < 40; ++second) {
      for (const int later : {0, 4, 9}) {
        if (second == 39 && later > 0) continue;
        graph::Store then = x.history.at(x.store, at_s(10 * second + later));
        for (const std::string& query : queries) {
          ASSERT_EQ(rows(then, query), rows(clones.at(second), query)) << second << " " << query;
        }
      }
    }
  }
}

TEST(FactHistory, OutsideOfItIsAnErrorWithBothBounds) {
  Facts x;
  EXPECT_THROW(x.history.at(x.store, at_s(0)), Error);  // nothing was observed
  x.history.observe(x.store, at_s(3));
  x.history.observe(x.store, at_s(7));
  for (const int asked : {2, 8}) {
    try {
      x.history.at(x.store, at_s(asked));
      ADD_FAILURE() << "answered for " << asked;
    } catch (const OutsideHistory& error) {
      EXPECT_EQ(error.asked, at_s(asked));
      EXPECT_EQ(error.oldest, at_s(3));
      EXPECT_EQ(error.newest, at_s(7));
    }
  }
  EXPECT_NO_THROW(x.history.at(x.store, at_s(3)));
  EXPECT_NO_THROW(x.history.at(x.store, at_s(7)));
  EXPECT_THROW(x.history.observe(x.store, at_s(6)), Error);  // time does not go back
  EXPECT_THROW(FactHistory(0), Error);
  EXPECT_THROW(FactHistory(kMaximumFactIntervals + 1), Error);
}

// What no longer fits is let go from the old end, and asking for it is an error, never a state
// from which something is missing.
TEST(FactHistory, IsBoundedAndLetsGoOfTheOldest) {
  Facts x;
  FactHistory small(10);
  std::map<int, graph::Store> clones;
  for (int second = 0; second < 50; ++second) {
    // Two facts begin in each second and hold for one.
    for (const char* name : {"a", "b"}) {
      x.store.remove(x.fact(name, "at", std::to_string(second - 1)));
      x.store.add(x.fact(name, "at", std::to_string(second)));
    }
    small.observe(x.store, at_s(second));
    clones.emplace(second, x.store.clone());
    EXPECT_LE(small.ended(), 10u);
  }
  EXPECT_EQ(small.ended() + small.dropped(), 2u * 49u);
  EXPECT_EQ(small.oldest(), at_s(44));
  int answered = 0;
  for (int second = 0; second < 50; ++second) {
    try {
      graph::Store then = small.at(x.store, at_s(second));
      ++answered;
      EXPECT_EQ(rows(then, "SELECT * WHERE { ?s ?p ?o }"),
                rows(clones.at(second), "SELECT * WHERE { ?s ?p ?o }"));
    } catch (const OutsideHistory& error) {
      EXPECT_LT(at_s(second), error.oldest);
    }
  }
  EXPECT_EQ(answered, 6);
}

TEST(FactHistory, ObservedTwiceAtOneStampTheLaterCounts) {
  Facts x;
  const graph::Quad a = x.fact("a", "p", "b"), b = x.fact("b", "p", "c");
  x.store.add(a);
  x.history.observe(x.store, at_s(1));
  x.store.remove(a);
  x.store.add(b);
  x.history.observe(x.store, at_s(2));
  x.store.add(a);
  x.store.remove(b);
  x.history.observe(x.store, at_s(2));
  // `a` went on without a gap, and `b` held at no time.
  ASSERT_EQ(x.history.intervals(x.iri("a"), {}, {}).size(), 1u);
  EXPECT_EQ(x.history.intervals(x.iri("a"), {}, {})[0].begin, at_s(1));
  EXPECT_TRUE(x.history.intervals(x.iri("b"), {}, {}).empty());
}

// The world's own description is part of it: who was attached to whom, and when.
TEST(FactHistory, FollowsTheStructureOfAWorld) {
  World world;
  const FrameId table = world.add_frame("http://x/table"), tool = world.add_frame("http://x/tool"),
                part = world.add_frame("http://x/part");
  world.add_static("http://x/tool-on-table", tool, table, {{}, {0, 0, 1}}, "me");
  const RelationId lying =
      world.add_relation({.name = "http://x/lying", .of = part, .with_respect_to = table});
  const MeasurementId seen = world.add_measurement({.name = "http://x/seen", .relation = lying});
  world.write(seen, at_s(0), Pose{}, {"me"});
  FactHistory history;
  history.observe(world.graph(), at_s(0));
  world.attach(part, tool, at_s(1), "me");
  history.observe(world.graph(), at_s(1));
  World during = world.clone();
  world.detach(part, table, at_s(2), "me");
  history.observe(world.graph(), at_s(2));
  const std::string query =
      "PREFIX w: <https://w3id.org/sinew/world#> PREFIX rel: "
      "<https://comp-rob2b.github.io/metamodels/geometry/spatial-relations#> "
      "SELECT ?what ?parent WHERE { ?r rel:of ?what ; rel:with-respect-to ?parent . "
      "FILTER NOT EXISTS { ?r w:suspended true } }";
  graph::Store then = history.at(world.graph(), at_s(1));
  EXPECT_EQ(rows(then, query), rows(during.graph(), query));
  EXPECT_NE(rows(then, query), rows(world.graph(), query));
}

}  // namespace
}  // namespace sinew::world
