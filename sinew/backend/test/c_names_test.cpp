// Names of the values in a generated function.
#include "sinew/backend/c_names.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string>
#include <vector>

namespace {

using sinew::backend::CNames;

TEST(CNames, NumberWhatIsTaken) {
  CNames names = {"in"};
  EXPECT_EQ(names.unique("q"), "q");
  EXPECT_EQ(names.unique("q"), "q_2");
  EXPECT_EQ(names.unique("in"), "in_2");
  EXPECT_EQ(names.unique("q"), "q_3");
  names.take("q_4");
  EXPECT_EQ(names.unique("q"), "q_5");
}

TEST(CNames, GiveATemporaryThatIsReadAgainANameAfterIt) {
  CNames names = {};
  EXPECT_EQ(names.temporary(), "t1");
  EXPECT_EQ(names.temporary(), "t2");
  EXPECT_EQ(names.unique("t1"), "t1_2");
  EXPECT_EQ(names.unique("t1"), "t1_3");
  EXPECT_EQ(names.unique("t2"), "t2_2");
  EXPECT_EQ(names.unique("t1_2"), "t1_2_2");
}

TEST(CNames, LetInputsBeCalledAsTemporariesAre) {
  CNames names = {};
  EXPECT_EQ(names.unique("t2"), "t2");
  EXPECT_EQ(names.unique("t1_2"), "t1_2");
  EXPECT_EQ(names.temporary(), "t1");
  EXPECT_EQ(names.unique("t1"), "t1_3");
  EXPECT_EQ(names.unique("t1_3"), "t1_3_2");
  EXPECT_EQ(names.temporary(), "t2_2");
  EXPECT_EQ(names.temporary(), "t3");
  EXPECT_EQ(names.unique("t03"), "t03");
}

// Whatever is asked for: each name is the base, or the base with the lowest number that is free.
TEST(CNames, AreTheLowestThatNothingElseHas) {
  std::mt19937 random(7);
  const std::vector<std::string> bases = {"t1",   "t2",   "t3",   "t9",     "t1_2", "t2_2",
                                          "t2_3", "t02",  "t2_",  "t2_2_2", "a",    "a_2",
                                          "t",    "t1_1", "t9_2", "t10"};
  for (int round = 0; round < 200; ++round) {
    CNames names = {"a"};
    std::set<std::string> taken = {"a"};
    const auto lowest = [&](const std::string& base) {
      std::string name = base;
      for (int k = 2; !taken.insert(name).second; ++k) name = base + "_" + std::to_string(k);
      return name;
    };
    int temporaries = 0;
    for (int k = 0; k < 40; ++k) {
      if (random() % 4 == 0) {
        EXPECT_EQ(names.temporary(), lowest("t" + std::to_string(++temporaries)));
      } else {
        const std::string& base = bases[random() % bases.size()];
        EXPECT_EQ(names.unique(base), lowest(base)) << base << " in round " << round;
      }
    }
  }
}

}  // namespace
