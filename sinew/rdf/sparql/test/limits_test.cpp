// Every limit is a number, and has its own error.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <tuple>

#include "sinew/rdf/sparql/test/table.h"

namespace sinew::rdf::sparql {
namespace {

// A ring of `size` nodes.
std::string ring(int size) {
  std::string text;
  for (int i = 0; i < size; ++i) text += fmt::format(":n{} :p :n{} .\n", i, (i + 1) % size);
  return text;
}

std::string repeated(std::string_view text, int count) {
  std::string result;
  for (int i = 0; i < count; ++i) result += text;
  return result;
}

std::string refusal(std::string_view text, const Limits& limits) {
  Table table(ring(50));
  QueryOptions options;
  options.limits = limits;
  return table.refusal(text, options);
}

#define EXPECT_SAYS(message, part) EXPECT_NE((message).find(part), std::string::npos) << (message)

TEST(Limits, LengthOfTheText) {
  Limits limits;
  limits.text_bytes = 200;
  EXPECT_SAYS(refusal("SELECT * { ?s ?p ?o }" + repeated(" ", 200), limits),
              "more than the limit of 200");
}

TEST(Limits, Nesting) {
  Limits limits;
  limits.nesting = 10;
  EXPECT_EQ(refusal("SELECT * " + repeated("{", 9) + repeated("}", 9), limits), "accepted");
  EXPECT_SAYS(refusal("SELECT * " + repeated("{", 11) + repeated("}", 11), limits),
              "nested deeper than 10 levels");
  // A caller cannot ask for more than the stack bears.
  limits.nesting = 1'000'000;
  for (const auto& [before, open, close] :
       {std::tuple("", "{", "}"), {"?s :p ", "(", ")"}, {"?s :p ", "[ :p ", "]"}}) {
    EXPECT_SAYS(refusal("SELECT * { " + std::string(before) + repeated(open, 300) +
                            repeated(close, 300) + "}",
                        limits),
                "nested deeper than 200 levels");
  }
  EXPECT_SAYS(
      refusal("SELECT (" + repeated("(", 300) + "1" + repeated(")", 300) + " AS ?x) {}", limits),
      "nested deeper than 200 levels");
  EXPECT_SAYS(
      refusal("SELECT * { ?s " + repeated("(", 300) + ":p" + repeated(")", 300) + " ?o }", limits),
      "nested deeper than 200 levels");
  EXPECT_SAYS(refusal("SELECT (1" + repeated("+1", 300) + " AS ?x) {}", limits), "sums in a row");
}

TEST(Limits, LengthOfAChain) {
  EXPECT_SAYS(refusal("SELECT * { " + repeated("?s :p ?o . ", 5000) + "}", {}),
              fmt::format("more than {} operators", kMaximumChain));
  EXPECT_SAYS(refusal("SELECT * { " + repeated("OPTIONAL { ?s :p ?o } ", 1100) + "}", {}),
              fmt::format("more than {} OPTIONAL", kMaximumGroupChain));
}

TEST(Limits, AChainOfTheGreatestLengthRuns) {
  EXPECT_EQ(refusal("SELECT * { " + repeated(":n0 :p :n1 . ", kMaximumChain - 1) + "}", {}),
            "accepted");
  EXPECT_EQ(
      refusal("SELECT * { " + repeated("OPTIONAL { ?s :p :n1 } ", kMaximumGroupChain / 2) + "}",
              {}),
      "accepted");
}

TEST(Limits, Rows) {
  Limits limits;
  limits.rows = 49;
  EXPECT_SAYS(refusal("SELECT * { ?s ?p ?o }", limits), "more than 49 solutions");
  EXPECT_SAYS(refusal("SELECT * { ?s ?p ?o } ORDER BY ?s", limits),
              "more than 49 solutions are to be sorted");
  EXPECT_SAYS(refusal("SELECT ?s (COUNT(*) AS ?n) { ?s ?p ?o } GROUP BY ?s", limits),
              "more than 49 groups");
  EXPECT_EQ(refusal("SELECT * { ?s ?p ?o } LIMIT 49", limits), "accepted");
}

TEST(Limits, PathSteps) {
  Limits limits;
  limits.path_steps = 60;
  EXPECT_EQ(refusal("SELECT * { :n0 :p+ ?x }", limits), "accepted");
  EXPECT_SAYS(refusal("SELECT * { ?x :p+ ?y }", limits), "paths reach more than 60 nodes");
}

TEST(Limits, Time) {
  Limits limits;
  limits.time = std::chrono::milliseconds(20);
  EXPECT_SAYS(
      refusal("SELECT (COUNT(*) AS ?n) { ?a ?b ?c . ?d ?e ?f . ?g ?h ?i . ?j ?k ?l . ?m ?n1 ?o }",
              limits),
      "takes longer than 20 ms");
}

TEST(Limits, ComputedText) {
  Limits limits;
  limits.computed_bytes = 2000;
  EXPECT_SAYS(refusal("SELECT (CONCAT(STR(?s), STR(?o)) AS ?t) { ?s ?p ?o }", limits),
              "computes more than 2000 bytes of terms");
  EXPECT_SAYS(refusal("SELECT (GROUP_CONCAT(?s) AS ?t) { ?s ?p ?o . ?a ?b ?c }", limits),
              "a text of more than 2000 bytes");
}

TEST(Limits, StepsOfARegularExpression) {
  EXPECT_SAYS(refusal("SELECT (REGEX(\"" + repeated("a", 40) + "c\", \"(a+)+$\") AS ?x) {}", {}),
              "takes more than 10000000 steps");
}

}  // namespace
}  // namespace sinew::rdf::sparql
