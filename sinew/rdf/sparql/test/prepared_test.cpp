#include "sinew/rdf/sparql/prepared.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sinew/base/error.h"
#include "sinew/rdf/sparql/test/table.h"

namespace sinew::rdf::sparql {
namespace {

// A chain of three links: frames on links (simplices), links in joints (between-attachments).
constexpr std::string_view kChain = R"(
  @prefix : <http://e/> .
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
  EXPECT_FALSE(leaf->ask(table.store.view(), {table.id(":f1a")}));
  EXPECT_TRUE(leaf->ask(table.store.view(), {table.id(":f3a")}));
}

TEST(Prepared, PathsReachEverythingOnce) {
  Table table(kChain);
  const auto query = prepare(table.store, R"(PREFIX : <http://e/>
      SELECT ?f WHERE { ?node (^:simplices/:simplices|^:between-attachments/:between-attachments)+ ?f }
      )",
                             {"node"});
  EXPECT_EQ(table.rows(*query, {table.id(":f1a")}),
            (Rows{{":f1a"}, {":f1b"}, {":f2a"}, {":f2b"}, {":f3a"}}));
}

TEST(Prepared, OptionalLeavesUnbound) {
  Table table(kChain);
  const auto query = prepare(table.store, R"(PREFIX : <http://e/>
      SELECT ?f ?label WHERE { :link1 :simplices ?f OPTIONAL { ?f :label ?label } })");
  EXPECT_EQ(table.rows(*query, {}), (Rows{{":f1a", "\"base\""}, {":f1b", "-"}}));
}

TEST(Prepared, UnionValuesAndBind) {
  Table table(kChain);
  const auto query = prepare(table.store, R"(PREFIX : <http://e/>
      SELECT ?f ?from WHERE { VALUES ?from { :link2 :link3 }
        { ?from :simplices ?f } UNION { BIND(:f1a AS ?f) } })");
  EXPECT_EQ(table.rows(*query, {}), (Rows{{":f1a", ":link2"},
                                          {":f1a", ":link3"},
                                          {":f2a", ":link2"},
                                          {":f2b", ":link2"},
                                          {":f3a", ":link3"}}));
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
