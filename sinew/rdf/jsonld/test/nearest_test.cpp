#include "sinew/rdf/jsonld/nearest.h"

#include <gtest/gtest.h>

namespace sinew::jsonld {
namespace {

TEST(EditDistance, CountsInsertionsRemovalsReplacementsAndSwaps) {
  EXPECT_EQ(edit_distance("mass", "mass", 3), 0u);
  EXPECT_EQ(edit_distance("mass", "Mass", 3), 0u);  // case does not count
  EXPECT_EQ(edit_distance("mass", "mas", 3), 1u);
  EXPECT_EQ(edit_distance("mass", "moss", 3), 1u);
  EXPECT_EQ(edit_distance("mass", "mses", 3), 2u);
  EXPECT_EQ(edit_distance("parent", "parnet", 3), 1u);
  EXPECT_EQ(edit_distance("abc", "xyz", 2), 3u);  // more than the limit
}

TEST(Nearest, FindsTheMostSimilarOrNothing) {
  Nearest nearest("as-seen-by");
  nearest.offer("as-sen-by");
  nearest.offer("as-seen-bi");
  nearest.offer("about");
  EXPECT_EQ(nearest.found(), "as-seen-bi");
  Nearest nothing("of");
  nothing.offer("with-respect-to");
  EXPECT_EQ(nothing.found(), "");
}

}  // namespace
}  // namespace sinew::jsonld
