// Prepared queries: parameters, plans, and running from visitors and threads.
#include "sinew/rdf/sparql/prepared.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "sinew/base/error.h"
#include "sinew/rdf/sparql/test/table.h"

namespace sinew::rdf::sparql {
namespace {

// A chain of three links: frames on links (simplices), links in joints (between-attachments).
constexpr std::string_view kChain = R"(
  :link1 :simplices :f1a , :f1b .
  :link2 :simplices :f2a , :f2b .
  :link3 :simplices :f3a .
  :joint1 :between-attachments :f1b , :f2a .
  :joint2 :between-attachments :f2b , :f3a .
  :f1a :label "base" .
)";

TEST(Prepared, WalksFromABoundParameter) {
  Table table(kChain);
  const auto query = prepare(table.store, R"(PREFIX : <http://e/>
      SELECT ?child WHERE {
        ?node ^:simplices/:simplices ?near . ?joint :between-attachments ?near, ?child .
        FILTER(?near != ?child) FILTER(?node != ?near)
      })",
                             {"node"});
  EXPECT_EQ(query->columns(), std::vector<std::string>{"child"});
  EXPECT_EQ(table.rows(*query, {table.id(":f1a")}), (Rows{{":f2a"}}));
  EXPECT_EQ(table.rows(*query, {table.id(":f2a")}), (Rows{{":f3a"}}));
  EXPECT_EQ(table.rows(*query, {table.id(":f3a")}), (Rows{}));
}

TEST(Prepared, AskStopsAtTheFirst) {
  Table table(kChain);
  const auto leaf = prepare(table.store, R"(PREFIX : <http://e/>
      ASK { FILTER NOT EXISTS { ?node ^:simplices/:simplices ?x . ?j :between-attachments ?x, ?y
                                FILTER(?x != ?y && ?x != ?node) } })",
                            {"node"});
  EXPECT_TRUE(leaf->is_ask());
  EXPECT_FALSE(leaf->ask(table.store.view(), {table.id(":f1a")}));
  EXPECT_TRUE(leaf->ask(table.store.view(), {table.id(":f3a")}));
}

TEST(Prepared, ParametersKeepTheirValueEverywhere) {
  Table table(kChain);
  const std::vector<graph::Id> frame = {table.id(":f1a")};
  const auto rows = [&](const char* where) {
    return table.rows(*prepare(table.store, std::string("PREFIX : <http://e/> ") + where, {"f"}),
                      frame);
  };
  EXPECT_EQ(rows("SELECT ?f ?l { ?l :simplices ?f }"), (Rows{{":f1a", ":link1"}}));
  EXPECT_EQ(rows("SELECT ?l { { ?l :simplices ?x FILTER(?x = ?f) } }"), (Rows{{":link1"}}));
  EXPECT_EQ(rows("SELECT ?n { { SELECT (COUNT(?x) AS ?n) { ?l :simplices ?f , ?x } } }"),
            (Rows{{"2"}}));
  EXPECT_EQ(rows("SELECT ?x { :link1 :simplices ?x FILTER NOT EXISTS { FILTER(?x = ?f) } }"),
            (Rows{{":f1b"}}));
  EXPECT_EQ(rows("SELECT ?f (COUNT(*) AS ?n) { ?l :simplices ?f , ?x } GROUP BY ?f"),
            (Rows{{":f1a", "2"}}));
  // A parameter that the query does not mention is allowed.
  EXPECT_EQ(rows("SELECT ?x { :link3 :simplices ?x }"), (Rows{{":f3a"}}));
}

TEST(Prepared, ParametersMustBeGiven) {
  Table table(kChain);
  const auto query = prepare(table.store, "SELECT ?x { ?a ?b ?x }", {"a", "b"});
  EXPECT_THROW(query->select(table.store.view(), {table.id(":a")}, [](auto) { return true; }),
               Error);
}

TEST(Prepared, TheVisitorStopsTheQuery) {
  Table table(kChain);
  const auto query = prepare(table.store, "SELECT ?s { ?s ?p ?o }");
  std::size_t visited = 0;
  EXPECT_EQ(query->select(table.store.view(), {}, [&](auto) { return ++visited < 3; }), 3u);
  EXPECT_EQ(visited, 3u);
}

TEST(Prepared, TheVisitorMayRunTheSameQueryAndAddToTheStore) {
  Table table(kChain);
  const auto next = prepare(table.store, R"(PREFIX : <http://e/>
      SELECT ?child { ?l :simplices ?node , ?near . ?j :between-attachments ?near , ?child .
                      FILTER(?near != ?child && ?node != ?near) })",
                            {"node"});
  std::vector<std::string> reached;
  graph::Transaction transaction = table.store.begin();
  const std::function<void(graph::Id)> walk = [&](graph::Id node) {
    next->select(transaction.view(), {node}, [&](std::span<const graph::Id> row) {
      const graph::Id child = row[0];
      reached.push_back(table.name(child));
      transaction.add({node, table.id(":leads-to"), child});
      walk(child);
      return true;
    });
  };
  walk(table.id(":f1a"));
  transaction.commit();
  EXPECT_EQ(reached, (std::vector<std::string>{":f2a", ":f3a"}));
  EXPECT_EQ(table.rows("SELECT ?x { :f1a :leads-to+ ?x }"), (Rows{{":f2a"}, {":f3a"}}));
}

TEST(Prepared, ComputedTermsInRowsAreTermsOfTheStore) {
  Table table(kChain);
  const auto query =
      prepare(table.store, "SELECT (STRLEN(STR(?x)) AS ?n) (CONCAT(\"a\", \"b\") AS ?t) {}", {"x"});
  EXPECT_EQ(table.rows(*query, {table.id(":f1a")}), (Rows{{"12", "\"ab\""}}));
}

TEST(Prepared, PlansAnewWhenTheGraphHasGrown) {
  Table table;
  const auto query = prepare(
      table.store, "PREFIX : <http://e/> SELECT ?x { ?x :often ?n . ?x :rare 1 . ?x :common ?c }");
  graph::Terms& terms = table.store.terms();
  graph::Transaction transaction = table.store.begin();
  for (int i = 0; i < 2000; ++i) {
    const graph::Id node = terms.iri("http://e/n" + std::to_string(i));
    transaction.add({node, table.id(":often"), terms.integer(i)});
    transaction.add({node, table.id(":common"), terms.integer(i)});
    if (i == 7) transaction.add({node, table.id(":rare"), terms.integer(1)});
  }
  transaction.commit();
  EXPECT_EQ(table.rows(*query, {}), (Rows{{":n7"}}));
  const std::string plan = query->explain(terms);
  EXPECT_LT(plan.find("rare"), plan.find("often")) << plan;
}

TEST(Prepared, RunsInManyThreadsAtOnce) {
  Table table(kChain);
  const auto query = prepare(
      table.store, "PREFIX : <http://e/> SELECT ?x { ?f (^:simplices/:simplices)+ ?x }", {"f"});
  const graph::Snapshot snapshot = table.store.snapshot();
  std::atomic<std::size_t> rows = 0;
  std::vector<std::thread> threads;
  const graph::Id start = table.id(":f2a");
  for (int i = 0; i < 12; ++i) {
    threads.emplace_back([&] {
      for (int k = 0; k < 200; ++k) {
        rows += query->select(snapshot, {start}, [](auto) { return true; });
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(rows, 12u * 200 * 2);
}

TEST(Prepared, OnlySelectAndAsk) {
  Table table;
  EXPECT_THROW(prepare(table.store, "CONSTRUCT WHERE { ?s ?p ?o }"), Error);
}

TEST(QueryCache, PreparesATextOnce) {
  Table table(kChain);
  QueryCache cache(table.store);
  const auto first = cache.prepare("SELECT ?x { ?f ?p ?x }", {"f"});
  EXPECT_EQ(cache.prepare("SELECT ?x { ?f ?p ?x }", {"f"}), first);
  EXPECT_NE(cache.prepare("SELECT ?x { ?f ?p ?x }", {"f", "p"}), first);
  EXPECT_NE(cache.prepare("SELECT ?x { ?f ?p ?x }", {"f"}, graph::Dataset::kDefault), first);
  EXPECT_EQ(cache.size(), 3u);
}

TEST(Prepared, ErrorsSayLineAndColumn) {
  Table table("");
  try {
    prepare(table.store, "SELECT ?x WHERE {\n  ?x <http://e/p> }");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.problems()[0].place.line, 2u);
    EXPECT_EQ(error.problems()[0].place.column, 19u);
    EXPECT_FALSE(error.problems()[0].remedy.empty());
  }
}

}  // namespace
}  // namespace sinew::rdf::sparql
