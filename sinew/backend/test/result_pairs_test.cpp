#include "sinew/backend/jit/result_pairs.h"

#include <gtest/gtest.h>

#include <vector>

namespace {

using sinew::backend::pair_results;
using sinew::backend::ResultPair;
using sinew::program::LimbProgram;
using sinew::program::LimbRegion;
using sinew::program::LimbSource;
using sinew::program::Ref;

// A region of so many lanes whose results are the nodes of as many products.
struct Products {
  LimbProgram program;
  std::vector<std::vector<std::uint32_t>> statements;

  explicit Products(std::uint32_t lanes, std::uint32_t products) {
    LimbRegion& region = program.regions.emplace_back();
    region.lanes = lanes;
    std::vector<std::uint32_t>& order = statements.emplace_back();
    Ref last = region.computation.dag.input(0);
    const Ref factor = region.computation.dag.input(1);
    for (std::uint32_t k = 0; k < products; ++k) {
      last = region.computation.dag.multiply(last, factor);
      region.computation.results.push_back(last);
      order.push_back(last.node());
    }
  }
  void result(std::uint32_t product, std::uint32_t lane, bool negative = false) {
    program.results.push_back(
        {.kind = LimbSource::Kind::kRegion, .index = product, .lane = lane, .negative = negative});
  }
  void constant() { program.results.push_back({}); }
  std::vector<ResultPair> pairs() const { return pair_results(program, statements); }
};

TEST(ResultPairs, NeighboursOfEachLimbMakeOnePair) {
  Products of(2, 2);
  of.result(0, 0);
  of.result(1, 0);
  of.constant();
  of.result(0, 1);
  of.result(1, 1);
  const auto pairs = of.pairs();
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].left, of.statements[0][0]);
  EXPECT_EQ(pairs[0].right, of.statements[0][1]);
  EXPECT_EQ(pairs[0].later, pairs[0].right);
  EXPECT_EQ(pairs[0].earlier(), pairs[0].left);
  ASSERT_EQ(pairs[0].places.size(), 2u);
  EXPECT_EQ(pairs[0].places[0].lane, 0u);
  EXPECT_EQ(pairs[0].places[0].left, 0u);
  EXPECT_EQ(pairs[0].places[1].lane, 1u);
  EXPECT_EQ(pairs[0].places[1].left, 3u);
}

TEST(ResultPairs, TheLeftOneMayBeComputedLater) {
  Products of(2, 2);
  of.result(1, 0);
  of.result(0, 0);
  const auto pairs = of.pairs();
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].later, pairs[0].left);
}

TEST(ResultPairs, NoResultIsInTwo) {
  Products of(2, 3);
  for (const std::uint32_t product : {0, 1, 2}) of.result(product, 0);
  const auto pairs = of.pairs();
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].places.size(), 1u);
}

TEST(ResultPairs, ThoseOfMoreLimbsComeFirst) {
  // Of the first limb there is a neighbour more in front.
  Products of(2, 3);
  for (const std::uint32_t product : {2, 0, 1}) of.result(product, 0);
  of.constant();
  for (const std::uint32_t product : {0, 1}) of.result(product, 1);
  const auto pairs = of.pairs();
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].left, of.statements[0][0]);
  EXPECT_EQ(pairs[0].places.size(), 2u);
}

TEST(ResultPairs, NumbersOfDifferentLimbsAreNoPair) {
  Products of(2, 2);
  of.result(0, 0);
  of.result(1, 1);
  EXPECT_TRUE(of.pairs().empty());
}

TEST(ResultPairs, ANegativeOneIsStoredOnItsOwn) {
  Products of(2, 2);
  of.result(0, 0, true);
  of.result(1, 0);
  EXPECT_TRUE(of.pairs().empty());
}

TEST(ResultPairs, NoneWaitsLong) {
  Products of(2, 100);
  of.result(0, 0);
  of.result(99, 0);
  EXPECT_TRUE(of.pairs().empty());
}

TEST(ResultPairs, PlainNumbersAreJoinedForSeveralPlaces) {
  Products once(1, 2), twice(1, 2);
  for (Products* of : {&once, &twice, &twice}) {
    of->result(0, 0);
    of->result(1, 0);
    of->constant();
  }
  EXPECT_TRUE(once.pairs().empty());
  const auto pairs = twice.pairs();
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].places.size(), 2u);
}

}  // namespace
