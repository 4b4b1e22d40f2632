// Closures over chains of properties, which have a way of their own, against the walk of any path:
// that one is taken where the dataset is not the union of all graphs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "sinew/base/error.h"
#include "sinew/rdf/sparql/test/table.h"

namespace sinew::rdf::sparql {
namespace {

using Answers = std::vector<std::vector<graph::Id>>;

Answers rows(const Prepared& query, const graph::View& view, std::vector<graph::Id> parameters) {
  Answers found;
  query.select(view, parameters, [&](std::span<const graph::Id> row) {
    found.emplace_back(row.begin(), row.end());
    return true;
  });
  std::sort(found.begin(), found.end());
  return found;
}

class Graph {
 public:
  explicit Graph(unsigned seed) : random_(seed) {
    const unsigned nodes = 2 + below(12);
    for (unsigned i = 0; i < nodes; ++i) {
      nodes_.push_back(store.terms().iri("http://e/n" + std::to_string(i)));
    }
    graph::Transaction transaction = store.begin();
    for (unsigned i = below(40); i > 0; --i) {
      const graph::Id property = store.terms().iri("http://e/p" + std::to_string(below(3)));
      transaction.add({node(), property, node()});
    }
    transaction.commit();
  }
  unsigned below(unsigned limit) { return random_() % limit; }
  graph::Id node() { return nodes_[below(static_cast<unsigned>(nodes_.size()))]; }
  std::string chain() {
    std::string text = "(";
    for (unsigned i = 1 + below(9); i > 0; --i) {
      text += std::string(below(2) == 0 ? "^" : "") + ":p" + std::to_string(below(3)) +
              (i > 1 ? "/" : "");
    }
    return text + (below(2) == 0 ? ")+" : ")*");
  }
  graph::Store store;

 private:
  std::mt19937 random_;
  std::vector<graph::Id> nodes_;
};

// In their order.
Answers listed(const Prepared& query, const graph::View& view, std::vector<graph::Id> parameters) {
  Answers found;
  query.select(view, parameters, [&](std::span<const graph::Id> row) {
    found.emplace_back(row.begin(), row.end());
    return true;
  });
  return found;
}

TEST(Chains, ReachWhatTheWalkOfAnyPathReachesEachTimeInTheSameOrder) {
  std::size_t found = 0;
  for (unsigned seed = 1; seed <= 400 && !testing::Test::HasFailure(); ++seed) {
    Graph graph(seed);
    const std::string text = "PREFIX : <http://e/> SELECT ?x ?y { ?x " + graph.chain() + " ?y }";
    SCOPED_TRACE("seed " + std::to_string(seed) + " " + text);
    const std::vector<std::vector<std::string_view>> cases = {{"x"}, {"y"}, {"x", "y"}, {}};
    for (const auto& parameters : cases) {
      const auto chain = prepare(graph.store, text, parameters, graph::Dataset::kUnion);
      const auto walk = prepare(graph.store, text, parameters, graph::Dataset::kDefault);
      for (int anchor = 0; anchor < 4; ++anchor) {
        std::vector<graph::Id> given;
        for (std::size_t i = 0; i < parameters.size(); ++i) given.push_back(graph.node());
        const Answers expected = rows(*walk, graph.store.view(), given);
        EXPECT_EQ(rows(*chain, graph.store.view(), given), expected);
        // Now it is remembered; a transaction's view remembers nothing.
        const Answers again = listed(*chain, graph.store.view(), given);
        EXPECT_EQ(listed(*chain, graph.store.begin().view(), given), again);
        EXPECT_EQ(again.size(), expected.size());
        found += expected.size();
      }
    }
  }
  EXPECT_GT(found, 5000u);
}

TEST(Chains, StopWhenTheVisitorSaysSo) {
  Table table(":a :p :b . :b :p :c . :c :p :d .");
  const auto query = prepare(table.store, "PREFIX : <http://e/> SELECT ?y { :a :p+ ?y }");
  int seen = 0;
  query->select(table.store.view(), {}, [&](std::span<const graph::Id>) { return ++seen < 2; });
  EXPECT_EQ(seen, 2);
}

TEST(Chains, KeepTheirLimit) {
  Table table(":a :p :b . :b :p :c . :c :p :d .");
  Limits limits;
  limits.path_steps = 2;
  const auto query = prepare(table.store, "PREFIX : <http://e/> SELECT ?y { :a (:p/:p)* ?y }",
                             std::span<const std::string_view>(), graph::Dataset::kUnion, limits);
  EXPECT_THROW(rows(*query, table.store.view(), {}), Error);
}

// The visitor adds terms that the walk then comes to.
TEST(Chains, MayBeAddedToWhileTheyAreWalked) {
  Table table(":a :p :n0 .");
  const graph::Id p = table.id(":p");
  graph::Transaction transaction = table.store.begin();
  const auto query = prepare(table.store, "PREFIX : <http://e/> SELECT ?y { :a :p+ ?y }");
  std::size_t count = 0;
  query->select(transaction.view(), {}, [&](std::span<const graph::Id> row) {
    const graph::Id next = table.store.terms().iri("http://e/m" + std::to_string(count));
    if (++count < 300) transaction.add({row[0], p, next});
    return true;
  });
  EXPECT_GE(count, 1u);
  EXPECT_LE(count, 300u);
}

TEST(Chains, WhatIsRememberedIsOfOneVersionOfOneStore) {
  Table table(":a :p :b .");
  const auto query = prepare(table.store, "PREFIX : <http://e/> SELECT ?y { :a :p+ ?y }");
  const graph::Snapshot before = table.store.snapshot();
  for (int i = 0; i < 2; ++i) EXPECT_EQ(rows(*query, before, {}).size(), 1u);
  const graph::Quad more{table.id(":b"), table.id(":p"), table.id(":c")};
  {
    graph::Transaction gone = table.store.begin();
    gone.add(more);
    EXPECT_EQ(rows(*query, gone.view(), {}).size(), 2u);
    EXPECT_EQ(rows(*query, before, {}).size(), 1u);
  }
  EXPECT_EQ(rows(*query, table.store.view(), {}).size(), 1u);
  table.store.add(more);
  graph::Store clone = table.store.clone();
  clone.add({table.id(":c"), table.id(":p"), clone.terms().iri("http://e/d")});
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(rows(*query, before, {}).size(), 1u);
    EXPECT_EQ(rows(*query, table.store.view(), {}).size(), 2u);
    EXPECT_EQ(rows(*query, clone.view(), {}).size(), 3u);
  }
  table.store.remove(more);
  EXPECT_EQ(rows(*query, table.store.view(), {}).size(), 1u);
}

// Beyond ChainLists::kMostNodes, kMostWays and kRoom.
TEST(Chains, NodesThatLeadToManyAreWalkedAnew) {
  std::string text;
  const auto link = [&](std::string_view from, std::string_view property, std::string_view to) {
    text += fmt::format(":{} :{} :{} . ", from, property, to);
  };
  for (int i = 0; i < 300; ++i) {
    link("hub", "p", fmt::format("m{}", i % 20));
    link(fmt::format("m{}", i % 20), "q", fmt::format("e{}", i));
    link(fmt::format("e{}", i), "p", fmt::format("m{}", i % 7));
  }
  Table table(text);
  const std::string query = "PREFIX : <http://e/> SELECT ?y { ?x (:p/:q)+ ?y }";
  const auto chain = prepare(table.store, query, {"x"}, graph::Dataset::kUnion);
  const auto walk = prepare(table.store, query, {"x"}, graph::Dataset::kDefault);
  for (const char* const start : {":hub", ":e5", ":e19", ":m3"}) {
    const Answers expected = rows(*walk, table.store.view(), {table.id(start)});
    EXPECT_EQ(expected.empty(), std::string_view(start) == ":m3");
    const Answers first = listed(*chain, table.store.view(), {table.id(start)});
    EXPECT_EQ(rows(*chain, table.store.view(), {table.id(start)}), expected);
    EXPECT_EQ(listed(*chain, table.store.view(), {table.id(start)}), first);
  }
}

TEST(Chains, RememberNoMoreThanThereIsRoomFor) {
  std::string text;
  constexpr int kNodes = 5000, kEach = 20;  // 100,000 ids
  for (int i = 0; i < kNodes; ++i) {
    for (int k = 1; k <= kEach; ++k) {
      text += fmt::format(":n{} :p :n{} . ", i, (i + k) % kNodes);
    }
  }
  Table table(text);
  const auto query = prepare(table.store, "PREFIX : <http://e/> SELECT ?y { ?x :p+ ?y }", {"x"});
  const Answers first = listed(*query, table.store.view(), {table.id(":n0")});
  EXPECT_EQ(first.size(), static_cast<std::size_t>(kNodes));
  EXPECT_EQ(listed(*query, table.store.view(), {table.id(":n0")}), first);
  EXPECT_EQ(listed(*query, table.store.view(), {table.id(":n4000")}).size(), first.size());
}

}  // namespace
}  // namespace sinew::rdf::sparql
