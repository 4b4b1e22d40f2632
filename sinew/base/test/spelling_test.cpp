#include "sinew/base/spelling.h"

#include <gtest/gtest.h>

namespace sinew {
namespace {

using Names = std::vector<std::string>;

TEST(SpellingDistance, CountsInsertionsRemovalsReplacementsAndSwapsAndALittleForCase) {
  constexpr std::size_t kFar = 3 * kOneEdit;
  EXPECT_EQ(spelling_distance("mass", "mass", kFar), 0u);
  EXPECT_EQ(spelling_distance("mass", "Mass", kFar), 1u);
  EXPECT_EQ(spelling_distance("MASS", "mass", kFar), 4u);
  EXPECT_EQ(spelling_distance("mass", "mas", kFar), kOneEdit);
  EXPECT_EQ(spelling_distance("mass", "moss", kFar), kOneEdit);
  EXPECT_EQ(spelling_distance("mass", "mses", kFar), 2 * kOneEdit);
  EXPECT_EQ(spelling_distance("parent", "parnet", kFar), kOneEdit);
  EXPECT_EQ(spelling_distance("parent", "ParNet", kFar), kOneEdit + 2);
  EXPECT_EQ(spelling_distance("", "ab", kFar), 2 * kOneEdit);
  EXPECT_EQ(spelling_distance("abc", "xyz", 2 * kOneEdit), 2 * kOneEdit + 1) << "over the limit";
  const std::string long_word(kLongestComparedWord + 1, 'x');
  EXPECT_EQ(spelling_distance(long_word, long_word, kFar), kFar + 1);
}

TEST(CloseSpellings, AreTheClosestFirstAndEqualsByName) {
  EXPECT_EQ(close_spellings("as-seen-by", Names{"as-sen-by", "as-seen-bi", "about"}),
            (Names{"as-seen-bi", "as-sen-by"}));
  EXPECT_EQ(close_spellings("of", Names{"with-respect-to"}), Names{});
  EXPECT_EQ(close_spellings("abc", Names{"abd", "abe", "abf", "abg", "abd"}),
            (Names{"abd", "abe", "abf"}));
  EXPECT_EQ(close_spellings("abcd", Names{"ab", "abxy", "a"}), (Names{"ab", "abxy"}));
  EXPECT_EQ(close_spellings("ab", Names{"", "xy", "b"}), Names{"b"});
}

TEST(CloseSpellings, TakeAsFewEditsAsTheClosest) {
  EXPECT_EQ(close_spellings("costs", Names{"cost", "loses"}), Names{"cost"});
  EXPECT_EQ(close_spellings("Kg", Names{"G", "K", "KN", "kg", "KG"}), (Names{"KG", "kg"}));
  EXPECT_EQ(close_spellings("JOINT", Names{"joint", "join", "Joint"}), (Names{"Joint", "joint"}));
}

TEST(DidYouMean, IsARemedy) {
  EXPECT_EQ(did_you_mean("positon", Names{"position", "velocity"}, "use another"),
            "did you mean position?");
  EXPECT_EQ(did_you_mean("abc", Names{"abd", "abe"}, ""), "did you mean abd or abe?");
  EXPECT_EQ(did_you_mean("abc", Names{"xyz"}, "use another"), "use another");
}

}  // namespace
}  // namespace sinew
