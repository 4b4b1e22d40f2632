#include "sinew/program/passes/small_list.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace sinew::program {
namespace {

TEST(SmallList, HoldsWhatAVectorHoldsShortOrLong) {
  std::mt19937 random(1);
  SmallList<unsigned, 3> list;
  std::vector<unsigned> expected;
  for (int step = 0; step < 2000; ++step) {
    if (expected.empty() || random() % 5 < 3) {
      expected.push_back(random() % 4);
      list.push_back(expected.back());
    } else {
      const std::size_t at = random() % expected.size();
      expected.erase(expected.begin() + static_cast<std::ptrdiff_t>(at));
      list.erase(list.begin() + at);
    }
    if (expected.size() > 8) expected.clear(), list = {};
    ASSERT_EQ(std::vector<unsigned>(list.begin(), list.end()), expected);
    const SmallList<unsigned, 3> copy = list;
    EXPECT_TRUE(copy == list);
  }
}

TEST(SmallList, IsOrderedAsAVectorIs) {
  using List = SmallList<unsigned, 2>;
  EXPECT_TRUE((List{1, 2} < List{1, 2, 0}));
  EXPECT_TRUE((List{1, 2, 9} < List{1, 3}));
  EXPECT_FALSE((List{1, 2} < List{1, 2}));
}

}  // namespace
}  // namespace sinew::program
