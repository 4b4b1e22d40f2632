// What is refused, where, and with which advice.
#include <gtest/gtest.h>

#include "sinew/rdf/sparql/test/table.h"

namespace sinew::rdf::sparql {
namespace {

struct Case {
  const char* text;
  const char* says;  // a part of the message
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.text; }

class Queries : public testing::TestWithParam<Case> {};
TEST_P(Queries, AreRefused) {
  Table table;
  const std::string message = table.refusal(GetParam().text);
  EXPECT_NE(message.find(GetParam().says), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Grammar, Queries,
    testing::Values(Case{"SELECT ?x", "the end of the text stands where '{' should open a group"},
                    Case{"SELECT { ?x ?p ?o }", "stands where the selected variables should"},
                    Case{"SELECT * { ?x ?p }", "'}' stands where an object should"},
                    Case{"SELECT * { ?x ?p ?o ", "should close the group"},
                    Case{"SELECT * { \"a\" }", "'}' stands where a predicate should"},
                    Case{"SELECT * { ?s ?p ?o } nonsense", "'nonsense' stands behind the query"},
                    Case{"SELECT * { ?s none:p ?o }", "the prefix 'none:' is not declared"},
                    Case{"SELECT * { ?s <relative> ?o }",
                         "<relative> is relative and there is no base"},
                    Case{"SELECT * { ?s ?p 'open }", "does not end"},
                    Case{"SELECT * { ?s ?p \"\\z\" }", "no such escape"},
                    Case{"SELECT * { FILTER(FOO(1)) }", "there is no function of this name"},
                    Case{"SELECT * { FILTER(STRLEN(1, 2)) }", "STRLEN has 2 arguments; give it 1"},
                    Case{"SELECT * { FILTER(:iri) ?x :p (1 2 }", "stands in a list"}));

INSTANTIATE_TEST_SUITE_P(
    Scope, Queries,
    testing::Values(
        Case{"SELECT * { ?x :p ?y BIND(1 AS ?y) }", "?y, which the group has used before"},
        Case{"SELECT (1 AS ?x) { ?x :p ?y }", "?x has a value already"},
        Case{"SELECT (1 AS ?x) (2 AS ?x) {}", "?x has a value already"},
        Case{"SELECT ?y (COUNT(*) AS ?n) { ?x :p ?y }", "?y is neither a group key nor inside"},
        Case{"SELECT (?y + 1 AS ?z) { ?x :p ?y } GROUP BY ?x", "?y is neither a group key"},
        Case{"SELECT * { ?x :p ?y } GROUP BY ?x", "SELECT * stands with GROUP BY"},
        Case{"SELECT * { FILTER(COUNT(?x) > 1) }", "the aggregate COUNT cannot stand here"},
        Case{"SELECT (SUM(COUNT(?x)) AS ?y) {}", "COUNT stands inside another aggregate"},
        Case{"SELECT * { _:a :p 1 OPTIONAL { _:a :q 2 } }", "_:a stands in two patterns"},
        Case{"SELECT * { VALUES (?x ?y) { (1) } }", "1 values for 2 variables"},
        Case{"SELECT * { VALUES (?x ?x) { (1 2) } }", "stands twice"}));

INSTANTIATE_TEST_SUITE_P(
    Evaluation, Queries,
    testing::Values(Case{"SELECT * { SERVICE :there { ?s ?p ?o } }",
                         "which this engine never does"},
                    Case{"SELECT (:f(1) AS ?x) {}", "there is no function <http://e/f>"},
                    Case{"SELECT (xsd:integer(1, 2) AS ?x) {}", "takes one argument"}));

class Updates : public testing::TestWithParam<Case> {};
TEST_P(Updates, AreRefused) {
  Table table;
  const std::string message = table.update_refusal(GetParam().text);
  EXPECT_NE(message.find(GetParam().says), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    All, Updates,
    testing::Values(
        Case{"INSERT DATA { ?x :p 1 }", "a variable stands in data"},
        Case{"DELETE DATA { _:a :p 1 }", "DELETE DATA names a blank node"},
        Case{"DELETE { _:a :p ?x } WHERE { ?x :p 1 }", "the template of DELETE names a blank node"},
        Case{"DELETE WHERE { _:a :p ?x }", "DELETE WHERE names a blank node"},
        Case{"INSERT DATA { _:a :p 1 } ; INSERT DATA { _:a :p 2 }", "_:a stands in two"},
        Case{"INSERT { :a :p/:q 1 } WHERE {}", "stands where an object should"},
        Case{"SELECT * {}", "stands where an operation should begin"},
        Case{"DROP GRAPH :g", "there is no graph"}));

TEST(Refusals, SayLineAndColumnInCharacters) {
  Table table;
  QueryOptions options;
  options.name = "arm.rq";
  const std::string message = table.refusal("SELECT *\nWHERE { ?größe :p }", options);
  EXPECT_EQ(message.substr(0, 22), "arm.rq:2: column 19: '") << message;
}

TEST(Refusals, SilentServiceGivesNothingToJoinWith) {
  Table table(":a :p 1 .");
  EXPECT_EQ(table.rows("SELECT ?x { ?x :p 1 SERVICE SILENT :there { ?x ?p ?o } }"), (Rows{{":a"}}));
}

TEST(UnicodeEscapes, AreReplacedBeforeAnythingElse) {
  Table table(":größe :p 1 .");
  EXPECT_EQ(table.rows("SELECT ?\\u0061 { :gr\\u00F6\\U000000DFe :p ?\\u0061 }"), (Rows{{"1"}}));
  EXPECT_NE(table.refusal("SELECT * { ?x :p \"\\uD800\" }").find("stands for no character"),
            std::string::npos);
}

}  // namespace
}  // namespace sinew::rdf::sparql
