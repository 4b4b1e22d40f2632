// Property paths (SPARQL 1.1, section 9).
#include <gtest/gtest.h>

#include "sinew/rdf/sparql/test/table.h"

namespace sinew::rdf::sparql {
namespace {

// A loop a -> b -> c -> a by :p, a way out of it by :q.
constexpr std::string_view kData = ":a :p :b . :b :p :c . :c :p :a . :c :q :d . :a :r :b .";

struct Case {
  const char* path;
  Rows from_a;  // what :a reaches
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.path; }

class Paths : public testing::TestWithParam<Case> {};

TEST_P(Paths, ReachFromASubject) {
  Table table(kData);
  const std::string path = GetParam().path;
  EXPECT_EQ(table.rows("SELECT ?x { :a " + path + " ?x }"), GetParam().from_a);
}

// The same path from its other end, and with both ends given, finds the same.
TEST_P(Paths, ReachFromAnObjectAndBetweenTwo) {
  Table table(kData);
  const std::string path = GetParam().path;
  EXPECT_EQ(table.rows("SELECT ?x { ?x ^(" + path + ") :a }"), GetParam().from_a);
  EXPECT_EQ(table.rows("SELECT ?x { VALUES ?x { :a :b :c :d } :a " + path + " ?x }"),
            GetParam().from_a);
  EXPECT_EQ(table.rows("SELECT ?x { ?s " + path + " ?x FILTER(?s = :a) }"), GetParam().from_a);
}

INSTANTIATE_TEST_SUITE_P(
    All, Paths,
    testing::Values(Case{":p", {{":b"}}}, Case{"^:p", {{":c"}}}, Case{":p/:p", {{":c"}}},
                    Case{":p/:p/:q", {{":d"}}}, Case{":p|:r", {{":b"}, {":b"}}},
                    Case{":p+", {{":a"}, {":b"}, {":c"}}}, Case{":p*", {{":a"}, {":b"}, {":c"}}},
                    Case{":q*", {{":a"}}}, Case{":p?", {{":a"}, {":b"}}},
                    Case{"(:p|:q)+", {{":a"}, {":b"}, {":c"}, {":d"}}},
                    Case{"(:p/:p)+", {{":a"}, {":b"}, {":c"}}}, Case{"!:p", {{":b"}}},
                    Case{"!(:p|:r)", {}}, Case{"!^:q", {{":c"}}}, Case{"!(:p|^:p)", {{":b"}}},
                    Case{"^(:p/:p)", {{":b"}}}, Case{"(:p*)/:q", {{":d"}}},
                    Case{"((:p|^:p)/:q?)+", {{":a"}, {":b"}, {":c"}, {":d"}}},
                    Case{"(:p/(:p|:q))+", {{":a"}, {":b"}, {":c"}, {":d"}}},
                    Case{"((:p/:p)|(:p/:p/:q))+", {{":a"}, {":b"}, {":c"}, {":d"}}},
                    Case{"(:p/(:p/:r)?)+", {{":a"}, {":b"}, {":c"}}},
                    Case{"((:p/:p)/:q?)?", {{":a"}, {":c"}, {":d"}}}));

TEST(PathsOfNoSteps, MatchTermsThatAreGivenEvenWhereTheyAreInNoTriple) {
  Table table(kData);
  EXPECT_EQ(table.rows("SELECT ?x { :nowhere :p* ?x }"), (Rows{{":nowhere"}}));
  EXPECT_EQ(table.rows("SELECT ?x { ?x :p? 7 }"), (Rows{{"7"}}));
  EXPECT_TRUE(table.ask("ASK { :nowhere :p* :nowhere }"));
}

TEST(PathsOfNoSteps, DoNotMatchTermsThatOnlyAnotherPatternBinds) {
  Table table(kData);
  EXPECT_EQ(table.rows("SELECT ?x { VALUES ?x { :nowhere :d } ?x :p* ?y }"), (Rows{{":d"}}));
}

TEST(PathsOfNoSteps, MatchEveryNodeWhereNothingIsGiven) {
  Table table(":a :p :b . :c :q 1 .");
  EXPECT_EQ(table.rows("SELECT ?x ?y { ?x :none* ?y }"),
            (Rows{{"1", "1"}, {":a", ":a"}, {":b", ":b"}, {":c", ":c"}}));
}

TEST(PathsInGraphs, StayInOneGraph) {
  Table table(":g { :a :p :b } :h { :b :p :c }");
  EXPECT_EQ(table.rows("SELECT ?g ?x { GRAPH ?g { :a :p+ ?x } }"), (Rows{{":g", ":b"}}));
  EXPECT_EQ(table.rows("SELECT ?x { :a :p+ ?x }"), (Rows{{":b"}, {":c"}}));
}

}  // namespace
}  // namespace sinew::rdf::sparql
