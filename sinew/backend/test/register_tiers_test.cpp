#include "sinew/backend/jit/register_tiers.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <vector>

namespace {

using sinew::backend::choose_tiers;
using sinew::backend::Lifetime;

std::map<unsigned, unsigned> tiers(const std::vector<Lifetime>& lifetimes,
                                   const std::vector<unsigned>& sizes) {
  std::map<unsigned, unsigned> result;
  for (const auto& [value, tier] : choose_tiers(lifetimes, sizes)) result[value] = tier;
  return result;
}

TEST(RegisterTiers, AllAreInTheFirstWhileItHasRoom) {
  EXPECT_EQ(tiers({{0, 0, 4, 1}, {1, 1, 3, 1}, {2, 4, 6, 1}}, {2, 2}),
            (std::map<unsigned, unsigned>{{0, 0}, {1, 0}, {2, 0}}));
}

TEST(RegisterTiers, WhatIsNamedSeldomMakesRoom) {
  EXPECT_EQ(tiers({{0, 0, 4, 2}, {1, 1, 3, 5}}, {1, 1}),
            (std::map<unsigned, unsigned>{{0, 1}, {1, 0}}));
}

TEST(RegisterTiers, ManyShortLivesWeighMoreThanALongOne) {
  EXPECT_EQ(tiers({{0, 0, 9, 4}, {1, 0, 3, 2}, {2, 3, 6, 2}, {3, 6, 9, 2}}, {1, 1}),
            (std::map<unsigned, unsigned>{{0, 1}, {1, 0}, {2, 0}, {3, 0}}));
}

TEST(RegisterTiers, ALongLifeThatIsNamedOftenOutweighsShortOnes) {
  EXPECT_EQ(tiers({{0, 0, 9, 90}, {1, 0, 1, 20}, {2, 3, 4, 20}}, {1, 1}),
            (std::map<unsigned, unsigned>{{0, 0}, {1, 1}, {2, 1}}));
}

TEST(RegisterTiers, WhatFindsNoPlaceIsInTheLast) {
  EXPECT_EQ(tiers({{0, 0, 4, 3}, {1, 0, 4, 2}, {2, 0, 4, 1}}, {1, 1}),
            (std::map<unsigned, unsigned>{{0, 0}, {1, 1}, {2, 1}}));
}

TEST(RegisterTiers, NoTierButTheLastIsEverTooFull) {
  std::mt19937 random(1);
  const std::vector<unsigned> sizes = {3, 2, 4};
  for (int round = 0; round < 100; ++round) {
    std::vector<Lifetime> lifetimes;
    for (unsigned value = 0; value < 80; ++value) {
      const unsigned begin = random() % 100;
      lifetimes.push_back({value, begin, begin + 1 + static_cast<unsigned>(random() % 20),
                           1 + static_cast<unsigned>(random() % 6)});
    }
    const auto chosen = tiers(lifetimes, sizes);
    ASSERT_EQ(chosen.size(), lifetimes.size());
    for (unsigned at = 0; at < 120; ++at) {
      std::vector<unsigned> there(sizes.size(), 0);
      for (const Lifetime& of : lifetimes) {
        if (of.begin <= at && at < of.end) ++there[chosen.at(of.value)];
      }
      EXPECT_LE(there[0], sizes[0]);
      EXPECT_LE(there[1], sizes[1]);
    }
  }
}

}  // namespace
