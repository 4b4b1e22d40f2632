// Graph patterns: what they match, and in which scope (SPARQL 1.1, sections 5 to 13).
#include <gtest/gtest.h>

#include "sinew/rdf/sparql/test/table.h"

namespace sinew::rdf::sparql {
namespace {

constexpr std::string_view kData = R"(
  :base :joint :shoulder . :shoulder :joint :elbow . :elbow :joint :wrist .
  :shoulder :limit 2.5 . :elbow :limit 1.5 , 3 .
  :base a :Link . :shoulder a :Joint . :elbow a :Joint . :wrist a :Joint .
  :wrist :label "wrist"@en .
)";

using Case = QueryCase;

class Patterns : public testing::TestWithParam<Case> {};

TEST_P(Patterns, Match) {
  Table table(kData);
  EXPECT_EQ(table.rows(GetParam().query), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Basic, Patterns,
    testing::Values(Case{"OneTriple", "SELECT ?x { ?x :joint :elbow }", {{":shoulder"}}},
                    Case{"AJoin",
                         "SELECT ?x ?z { ?x :joint ?y . ?y :joint ?z }",
                         {{":base", ":elbow"}, {":shoulder", ":wrist"}}},
                    Case{"TheSameVariableTwice", "SELECT ?x { ?x :joint ?x }", {}},
                    Case{"AVariablePredicate",
                         "SELECT ?p { :wrist ?p ?o }",
                         {{":label"}, {"<http://www.w3.org/1999/02/22-rdf-syntax-ns#type>"}}},
                    Case{"BlankNodesAreVariables",
                         "SELECT ?x { ?x :joint _:any . _:any :joint [] }",
                         {{":base"}, {":shoulder"}}},
                    Case{"NoPatternAtAll", "SELECT (1 AS ?one) {}", {{"1"}}},
                    Case{"AnAbsentTerm", "SELECT ?x { ?x :joint :nowhere }", {}}),
    [](const auto& info) { return std::string(info.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Optional, Patterns,
    testing::Values(
        Case{"LeavesUnbound",
             "SELECT ?x ?l { ?x a :Joint OPTIONAL { ?x :limit ?l } }",
             {{":elbow", "1.5"}, {":elbow", "3"}, {":shoulder", "2.5"}, {":wrist", "-"}}},
        Case{
            "ItsFilterSeesBothSides",
            "SELECT ?x ?l { ?x a :Joint OPTIONAL { ?x :limit ?l FILTER(?l > 2 && ?x != :elbow) } }",
            {{":elbow", "-"}, {":shoulder", "2.5"}, {":wrist", "-"}}},
        Case{"Nested",
             "SELECT ?x ?y ?l { ?x a :Link OPTIONAL { ?x :joint ?y OPTIONAL { ?y :limit ?l } } }",
             {{":base", ":shoulder", "2.5"}}},
        // Bottom-up, the inner group knows nothing of ?x: its ?x is the limit of :elbow, which is
        // no joint, so nothing fits.
        Case{"DoesNotSeeWhatOnlyTheOuterGroupBinds",
             "SELECT ?x ?l { ?x :label ?n { :elbow :joint ?w OPTIONAL { ?x :limit ?l } } }",
             {}},
        Case{"AfterAnOptionalThatBindsNothing",
             "SELECT ?l ?y { :wrist a ?t OPTIONAL { :wrist :limit ?l } ?y :limit ?l FILTER(?l < 2) "
             "}",
             {{"1.5", ":elbow"}}}),
    [](const auto& info) { return std::string(info.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Scope, Patterns,
    testing::Values(
        Case{"AFilterSeesItsOwnGroupOnly", "SELECT ?x { ?x :joint ?y { FILTER(BOUND(?y)) } }", {}},
        Case{"AFilterSeesAllOfItsGroup",
             "SELECT ?x { FILTER(?l > 2) ?x :limit ?l }",
             {{":elbow"}, {":shoulder"}}},
        Case{"BindSeesWhatIsBeforeIt",
             "SELECT ?x ?twice { ?x :limit ?l BIND(?l * 2 AS ?twice) FILTER(?twice = 3) }",
             {{":elbow", "3"}}},
        Case{"BindThatFailsLeavesUnbound",
             "SELECT ?x ?n { ?x :label ?l BIND(?l + 1 AS ?n) }",
             {{":wrist", "-"}}},
        Case{"ASubSelectHidesWhatItDoesNotProject",
             "SELECT ?x ?y { ?x a :Link { SELECT ?y { ?x :limit ?y FILTER(?y < 2) } } }",
             {{":base", "1.5"}}},
        Case{"ASubSelectsLimitCountsAlone",
             "SELECT ?x { ?x a :Joint { SELECT ?x { ?x :limit ?l } ORDER BY ?l LIMIT 1 } }",
             {{":elbow"}}},
        Case{"ExistsSeesTheSolution",
             "SELECT ?x { ?x a :Joint FILTER EXISTS { ?x :limit ?l FILTER(?l > 2.9) } }",
             {{":elbow"}}},
        Case{"NotExists",
             "SELECT ?x { ?x a :Joint FILTER NOT EXISTS { ?x :joint ?y } }",
             {{":wrist"}}},
        Case{"ExistsWithinAnExpression",
             "SELECT ?x { ?x a :Joint FILTER(?x = :elbow || !EXISTS { ?x :joint ?y }) }",
             {{":elbow"}, {":wrist"}}}),
    [](const auto& info) { return std::string(info.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Sets, Patterns,
    testing::Values(
        Case{"UnionKeepsDuplicates",
             "SELECT ?x { { ?x :limit 3 } UNION { ?x :limit 3 } }",
             {{":elbow"}, {":elbow"}}},
        Case{"DistinctDoesNot",
             "SELECT DISTINCT ?x { { ?x :limit 3 } UNION { ?x :limit 3 } }",
             {{":elbow"}}},
        Case{"Minus", "SELECT ?x { ?x a :Joint MINUS { ?x :limit ?l } }", {{":wrist"}}},
        Case{"MinusWithoutACommonVariableRemovesNothing",
             "SELECT ?x { ?x a :Link MINUS { ?y :limit ?l } }",
             {{":base"}}},
        Case{"MinusOfWhatIsOnlyPerhapsBound",
             "SELECT ?x { ?x a :Joint OPTIONAL { ?x :label ?n } MINUS { ?y :label ?n } }",
             {{":elbow"}, {":shoulder"}}},
        Case{"ValuesJoin",
             "SELECT ?x ?l { VALUES (?x ?l) { (:elbow UNDEF) (:shoulder 1) } ?x :limit ?l }",
             {{":elbow", "1.5"}, {":elbow", "3"}}},
        Case{"ValuesBehindTheQuery",
             "SELECT ?x { ?x :limit ?l } VALUES ?l { 3 2.5 }",
             {{":elbow"}, {":shoulder"}}}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(Patterns, NamedGraphs) {
  Table table(R"(:a :p 1 . :g1 { :a :p 2 . :a :q 3 } :g2 { :a :p 2 })");
  const auto rows = [&](const char* text) {
    QueryOptions options;
    options.dataset = graph::Dataset::kDefault;
    return table.rows(text, options);
  };
  EXPECT_EQ(rows("SELECT ?o { :a :p ?o }"), (Rows{{"1"}}));
  EXPECT_EQ(rows("SELECT ?g ?o { GRAPH ?g { :a :p ?o } }"), (Rows{{":g1", "2"}, {":g2", "2"}}));
  EXPECT_EQ(rows("SELECT ?o { GRAPH :g1 { ?s ?p ?o } }"), (Rows{{"2"}, {"3"}}));
  EXPECT_EQ(rows("SELECT ?g { GRAPH ?g {} }"), (Rows{{":g1"}, {":g2"}}));
  EXPECT_EQ(rows("SELECT * { GRAPH :nowhere {} }"), (Rows{}));
  EXPECT_EQ(rows("SELECT ?g ?n { GRAPH ?g { SELECT (COUNT(*) AS ?n) { ?s ?p ?o } } }"),
            (Rows{{":g1", "2"}, {":g2", "1"}}));
  EXPECT_EQ(rows("SELECT ?g { GRAPH ?g { :a :p ?o OPTIONAL { :a :q ?q } FILTER(BOUND(?q)) } }"),
            (Rows{{":g1"}}));
  // The group of GRAPH does not see the graph's variable (section 18.6).
  EXPECT_EQ(rows("SELECT ?g { GRAPH ?g { :a :p ?o FILTER(BOUND(?g)) } }"), (Rows{}));
}

TEST(Patterns, TheUnionOfAllGraphsHoldsEachTripleOnce) {
  Table table(R"(:a :p 1 . :g1 { :a :p 1 , 2 } :g2 { :a :p 2 })");
  EXPECT_EQ(table.rows("SELECT ?o { :a :p ?o }"), (Rows{{"1"}, {"2"}}));
}

TEST(Patterns, FromChoosesTheDataset) {
  Table table(R"(:a :p 1 . :g1 { :a :p 2 , 3 } :g2 { :a :p 3 })");
  EXPECT_EQ(table.rows("SELECT ?o FROM :g1 FROM :g2 { :a :p ?o }"), (Rows{{"2"}, {"3"}}));
  EXPECT_EQ(table.rows("SELECT ?o FROM :g1 { GRAPH ?g { :a :p ?o } }"), (Rows{}));
  EXPECT_EQ(table.rows("SELECT ?g FROM NAMED :g2 { GRAPH ?g { :a :p 3 } }"), (Rows{{":g2"}}));
  EXPECT_EQ(table.rows("SELECT ?o FROM NAMED :g2 { :a :p ?o }"), (Rows{}));
}

TEST(Patterns, OrderIsThatOfTheTermsKinds) {
  Table table(R"(:a :p 10 , 9.5 , "b" , "a" , :iri , _:blank , true .)");
  EXPECT_EQ(table.ordered_rows("SELECT ?o { :a :p ?o OPTIONAL { ?o :none ?n } } ORDER BY ?n ?o"),
            (Rows{{"_"}, {":iri"}, {"\"a\""}, {"\"b\""}, {"true"}, {"9.5"}, {"10"}}));
  EXPECT_EQ(table.ordered_rows("SELECT ?o { :a :p ?o FILTER(isNumeric(?o)) } ORDER BY DESC(?o)"),
            (Rows{{"10"}, {"9.5"}}));
  EXPECT_EQ(table.ordered_rows("SELECT ?o { :a :p ?o } ORDER BY ?o OFFSET 2 LIMIT 2"),
            (Rows{{"\"a\""}, {"\"b\""}}));
}

}  // namespace
}  // namespace sinew::rdf::sparql
