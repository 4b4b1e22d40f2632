// GROUP BY, HAVING and aggregates (SPARQL 1.1, section 11).
#include <gtest/gtest.h>

#include "sinew/rdf/sparql/test/table.h"

namespace sinew::rdf::sparql {
namespace {

constexpr std::string_view kData = R"(
  :arm :link :l1 , :l2 , :l3 . :leg :link :l4 .
  :l1 :mass 1.5 . :l2 :mass 2 . :l3 :mass 2.5 . :l4 :mass "heavy" .
  :l1 :name "one" . :l2 :name "two" .
)";

using Case = QueryCase;

class Aggregates : public testing::TestWithParam<Case> {};

TEST_P(Aggregates, Give) {
  Table table(kData);
  EXPECT_EQ(table.rows(GetParam().query), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    All, Aggregates,
    testing::Values(
        Case{"CountByGroup",
             "SELECT ?r (COUNT(?l) AS ?n) { ?r :link ?l } GROUP BY ?r",
             {{":arm", "3"}, {":leg", "1"}}},
        Case{"CountOfEverything", "SELECT (COUNT(*) AS ?n) { ?r :link ?l }", {{"4"}}},
        Case{"CountOfNothing", "SELECT (COUNT(*) AS ?n) { ?r :nothing ?l }", {{"0"}}},
        Case{"NoGroupsOfNothing", "SELECT ?r (COUNT(*) AS ?n) { ?r :nothing ?l } GROUP BY ?r", {}},
        Case{"CountDistinct", "SELECT (COUNT(DISTINCT ?r) AS ?n) { ?r :link ?l }", {{"2"}}},
        Case{"CountDistinctSolutions",
             "SELECT (COUNT(DISTINCT *) AS ?n) { { :arm :link ?l } UNION { :arm :link ?l } }",
             {{"3"}}},
        Case{"CountLeavesOutTheUnbound",
             "SELECT (COUNT(?n) AS ?c) { ?r :link ?l OPTIONAL { ?l :name ?n } }",
             {{"2"}}},
        Case{"SumAvgMinMax",
             "SELECT (SUM(?m) AS ?s) (AVG(?m) AS ?a) (MIN(?m) AS ?i) (MAX(?m) AS ?x) "
             "{ :arm :link/:mass ?m }",
             {{"6", "2", "1.5", "2.5"}}},
        Case{"SumOfNothingIsZero",
             "SELECT (SUM(?m) AS ?s) (AVG(?m) AS ?a) (MIN(?m) AS ?i) { :x :mass ?m }",
             {{"0", "0", "-"}}},
        Case{"AnErrorSpoilsTheSum",
             "SELECT ?r (SUM(?m) AS ?s) { ?r :link/:mass ?m } GROUP BY ?r",
             {{":arm", "6"}, {":leg", "-"}}},
        Case{"GroupConcat",
             "SELECT (GROUP_CONCAT(?n; SEPARATOR=\"+\") AS ?t) { { SELECT ?n { ?l :name ?n } ORDER "
             "BY ?n } }",
             {{"\"one+two\""}}},
        Case{"Having", "SELECT ?r { ?r :link ?l } GROUP BY ?r HAVING (COUNT(?l) > 1)", {{":arm"}}},
        Case{"ArithmeticOfAggregates",
             "SELECT (MAX(?m) - MIN(?m) AS ?range) { :arm :link/:mass ?m }",
             {{"1"}}},
        Case{"KeysMayBeExpressions",
             "SELECT ?heavy (COUNT(*) AS ?n) { :arm :link/:mass ?m } GROUP BY (?m >= 2 AS ?heavy)",
             {{"false", "1"}, {"true", "2"}}},
        Case{"OrderByAnAggregate",
             "SELECT ?r { ?r :link ?l } GROUP BY ?r ORDER BY DESC(COUNT(?l)) LIMIT 1",
             {{":arm"}}},
        Case{"InASubSelect",
             "SELECT ?l { :arm :link ?l . ?l :mass ?m { SELECT (MAX(?x) AS ?m) { :arm :link/:mass "
             "?x } } }",
             {{":l3"}}},
        Case{"ValuesBehindGroups",
             "SELECT ?r (COUNT(*) AS ?n) { ?r :link ?l } GROUP BY ?r VALUES ?r { :leg }",
             {{":leg", "1"}}}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(Aggregates, SampleIsOneOfThem) {
  Table table(kData);
  const Rows rows = table.rows("SELECT (SAMPLE(?n) AS ?s) { ?l :name ?n }");
  EXPECT_TRUE(rows == (Rows{{"\"one\""}}) || rows == (Rows{{"\"two\""}}));
}

}  // namespace
}  // namespace sinew::rdf::sparql
