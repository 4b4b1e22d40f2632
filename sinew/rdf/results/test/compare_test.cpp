#include "sinew/rdf/results/compare.h"

#include <gtest/gtest.h>

namespace sinew::rdf {
namespace {

using graph::Id;

class CompareResults : public testing::Test {
 protected:
  graph::Terms terms;
  const Id one = terms.integer(1), two = terms.integer(2);
};

TEST_F(CompareResults, IgnoresTheOrderUnlessTold) {
  const ResultSet left = {{"a"}, {{one}, {two}}, {}}, right = {{"a"}, {{two}, {one}}, {}};
  EXPECT_TRUE(compare_results(left, right, false, terms));
  EXPECT_FALSE(compare_results(left, right, true, terms));
}

TEST_F(CompareResults, CountsRowsThatComeSeveralTimes) {
  const ResultSet left = {{"a"}, {{one}, {one}, {two}}, {}},
                  right = {{"a"}, {{one}, {two}, {two}}, {}};
  EXPECT_FALSE(compare_results(left, right, false, terms));
}

TEST_F(CompareResults, MatchesColumnsByName) {
  const ResultSet left = {{"a", "b"}, {{one, two}}, {}}, right = {{"b", "a"}, {{two, one}}, {}};
  EXPECT_TRUE(compare_results(left, right, true, terms));
  EXPECT_FALSE(compare_results(left, {{"a", "c"}, {{one, two}}, {}}, true, terms));
}

TEST_F(CompareResults, TellsUnboundFromBound) {
  EXPECT_FALSE(compare_results({{"a", "b"}, {{one, Id{}}}, {}}, {{"a", "b"}, {{Id{}, one}}, {}},
                               false, terms));
}

TEST_F(CompareResults, PairsBlankNodesAcrossRows) {
  const Id a = terms.fresh_blank(), b = terms.fresh_blank();
  const Id c = terms.fresh_blank(), d = terms.fresh_blank();
  const ResultSet left = {{"x", "y"}, {{a, one}, {a, two}, {b, one}}, {}};
  EXPECT_TRUE(
      compare_results(left, {{"x", "y"}, {{d, one}, {c, two}, {c, one}}, {}}, false, terms));
  EXPECT_FALSE(
      compare_results(left, {{"x", "y"}, {{d, one}, {c, two}, {d, one}}, {}}, false, terms));
}

TEST_F(CompareResults, ComparesAnswersOfYesAndNo) {
  EXPECT_TRUE(compare_results({{}, {}, true}, {{}, {}, true}, false, terms));
  EXPECT_EQ(compare_results({{}, {}, true}, {{}, {}, false}, false, terms).difference,
            "yes on the left, no on the right");
}

TEST_F(CompareResults, SaysWhichRowsDiffer) {
  const Comparison comparison =
      compare_results({{"a"}, {{one}}, {}}, {{"a"}, {{two}}, {}}, false, terms);
  EXPECT_EQ(comparison.difference,
            "1 rows on the left, 1 on the right\n"
            "  only on the left: ?a=\"1\"^^<http://www.w3.org/2001/XMLSchema#integer>\n"
            "  only on the right: ?a=\"2\"^^<http://www.w3.org/2001/XMLSchema#integer>");
}

}  // namespace
}  // namespace sinew::rdf
