// ASK, CONSTRUCT and DESCRIBE (SPARQL 1.1, section 16), and what EXPLAIN shows.
#include <gtest/gtest.h>

#include "sinew/rdf/sparql/test/table.h"

namespace sinew::rdf::sparql {
namespace {

constexpr std::string_view kData = ":a :p :b , :c . :b :q [ :r 1 ] . :c :q \"text\" .";

TEST(Ask, IsYesOrNo) {
  Table table(kData);
  EXPECT_TRUE(table.ask("ASK { :a :p :b }"));
  EXPECT_FALSE(table.ask("ASK { :b :p :a }"));
}

TEST(Construct, MakesEachTripleOnce) {
  Table table(kData);
  EXPECT_EQ(table.triples("CONSTRUCT { ?y :of ?x . :all :has :some } WHERE { ?x :p ?y }"),
            (Rows{{":all", ":has", ":some"}, {":b", ":of", ":a"}, {":c", ":of", ":a"}}));
}

TEST(Construct, MakesBlankNodesAnewForEachSolution) {
  Table table(kData);
  EXPECT_EQ(
      table.triples("CONSTRUCT { _:n :about ?y ; :is [] } WHERE { :a :p ?y }"),
      (Rows{{"_", ":about", ":b"}, {"_", ":about", ":c"}, {"_", ":is", "_"}, {"_", ":is", "_"}}));
}

TEST(Construct, LeavesOutWhatIsNoTriple) {
  Table table(kData);
  EXPECT_EQ(
      table.triples(
          "CONSTRUCT { ?o :of ?s . ?s :none ?unbound } WHERE { ?s :q ?o FILTER(isLiteral(?o)) }"),
      (Rows{}));
}

TEST(Construct, ShortFormTakesThePatternAsTemplate) {
  Table table(kData);
  EXPECT_EQ(table.triples("CONSTRUCT WHERE { ?x :p ?y }"),
            (Rows{{":a", ":p", ":b"}, {":a", ":p", ":c"}}));
}

TEST(Describe, FollowsBlankNodes) {
  Table table(kData);
  EXPECT_EQ(table.triples("DESCRIBE :b"), (Rows{{":b", ":q", "_"}, {"_", ":r", "1"}}));
  EXPECT_EQ(table.triples("DESCRIBE ?x WHERE { ?x :q ?o FILTER(isLiteral(?o)) }"),
            (Rows{{":c", ":q", "\"text\""}}));
}

TEST(Select, StarIsEveryVariableInScopeInTheOrderOfTheText) {
  Table table(kData);
  EXPECT_EQ(table.answer("SELECT * { ?x :p ?y . [] :q ?z MINUS { ?m :p ?y } }").results.columns,
            (std::vector<std::string>{"x", "y", "z"}));
}

TEST(Explain, ShowsTheOperatorsInTheirOrder) {
  Table table(":a :rare :b . :a :often 1 , 2 , 3 , 4 , 5 , 6 , 7 , 8 .");
  const std::string text = explain(
      table.store.view(), table.store.terms(),
      "PREFIX : <http://e/> SELECT ?y { ?x :often ?n . ?x :rare ?y FILTER(?n > 3) } ORDER BY ?y");
  EXPECT_LT(text.find("rare"), text.find("often")) << text;
  EXPECT_LT(text.find("often"), text.find("filter")) << text;
  EXPECT_NE(text.find("sort by 1 keys"), std::string::npos) << text;
}

}  // namespace
}  // namespace sinew::rdf::sparql
