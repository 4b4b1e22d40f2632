#include "sinew/rdf/iri/prefixes.h"

#include <gtest/gtest.h>

namespace sinew::rdf {
namespace {

TEST(Prefixes, ShortenWithTheLongestNamespaceThatFits) {
  const Prefixes prefixes{
      {"ex", "http://ex/"}, {"joint", "http://ex/joint/"}, {"", "http://here#"}};
  EXPECT_EQ(prefixes.shorten("http://ex/a"), "ex:a");
  EXPECT_EQ(prefixes.shorten("http://ex/joint/1"), "joint:1");
  EXPECT_EQ(prefixes.shorten("http://here#"), ":");
  EXPECT_EQ(prefixes.shorten("http://ex/a/b"), std::nullopt) << "a slash would need an escape";
  EXPECT_EQ(prefixes.shorten("http://other/"), std::nullopt);
}

TEST(Prefixes, ExpandOnlyNamesThatAreKnown) {
  Prefixes prefixes{{"ex", "http://ex/"}};
  EXPECT_EQ(prefixes.expand("ex:a:b"), "http://ex/a:b");
  EXPECT_EQ(prefixes.expand("no:a"), std::nullopt);
  EXPECT_EQ(prefixes.expand("ex"), std::nullopt);
}

TEST(Prefixes, LaterOnesReplaceEarlierOnesButMissingOnesAreOnlyAdded) {
  Prefixes prefixes{{"a", "http://1/"}};
  prefixes.set("a", "http://2/");
  prefixes.add_missing({{"a", "http://3/"}, {"b", "http://4/"}});
  EXPECT_EQ(prefixes.find("a"), "http://2/");
  EXPECT_EQ(prefixes.find("b"), "http://4/");
  EXPECT_EQ(prefixes.list().size(), 2u);
}

}  // namespace
}  // namespace sinew::rdf
