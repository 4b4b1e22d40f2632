#include "sinew/rdf/iri/characters.h"

#include <gtest/gtest.h>

namespace sinew::rdf {
namespace {

constexpr std::size_t kValid = std::string_view::npos;

TEST(Utf8, AcceptsEveryWellFormedLength) {
  EXPECT_EQ(first_invalid_utf8(""), kValid);
  EXPECT_EQ(first_invalid_utf8("plain text that is longer than eight bytes"), kValid);
  EXPECT_EQ(first_invalid_utf8("\u00e4 \u20ac \U0001F916 \uD7FF \uE000 \U0010FFFF"), kValid);
}

TEST(Utf8, FindsTheFirstBadByte) {
  const std::pair<std::string_view, std::size_t> cases[] = {
      {"12345678\xFF", 8},      // never a lead byte
      {"ab\xC3", 2},            // cut short
      {"ab\xC3z", 2},           // no continuation
      {"\xC0\xAF", 0},          // overlong '/'
      {"\xE0\x9F\xBF", 0},      // overlong
      {"\xF0\x8F\xBF\xBF", 0},  // overlong
      {"\xED\xA0\x80", 0},      // surrogate
      {"\xF4\x90\x80\x80", 0},  // above U+10FFFF
      {"x\x80", 1},             // continuation without a lead
  };
  for (const auto& [text, offset] : cases) EXPECT_EQ(first_invalid_utf8(text), offset);
}

TEST(Utf8, DecodesWhatItEncodes) {
  for (const char32_t c :
       {U'\0', U'a', U'\x7F', U'\x80', U'\x7FF', U'\x800', U'\xFFFD', U'\x10000', U'\x10FFFF'}) {
    std::string text;
    append_utf8(text, c);
    EXPECT_EQ(first_invalid_utf8(text), kValid);
    const Decoded decoded = decode_utf8(text, 0);
    EXPECT_EQ(decoded.character, c);
    EXPECT_EQ(decoded.length, text.size());
  }
  EXPECT_EQ(decode_utf8("a", 1).length, 0u);
}

TEST(Names, FollowTheGrammar) {
  for (const char* good :
       {"", "a", "joint-1", "1st", "a.b", "a:b", ":", "_x", "ä", "a%2Fb", "a\u00B7"}) {
    EXPECT_TRUE(is_plain_local_name(good)) << good;
  }
  for (const char* bad : {"-a", ".a", "a.", "a/b", "a b", "a%2", "a%zz", "a#", "\u00B7"}) {
    EXPECT_FALSE(is_plain_local_name(bad)) << bad;
  }
  EXPECT_TRUE(is_prefix_name("kc.v1-x"));
  EXPECT_FALSE(is_prefix_name("1kc"));
  EXPECT_FALSE(is_prefix_name("_kc"));
  EXPECT_FALSE(is_prefix_name("kc."));
  EXPECT_TRUE(is_blank_label("0a.b"));
  EXPECT_FALSE(is_blank_label(""));
  EXPECT_FALSE(is_blank_label("-a"));
  EXPECT_FALSE(is_blank_label("a."));
}

TEST(LanguageTag, IsGroupsOfLettersAndDigits) {
  for (const char* good : {"en", "de-DE", "x-1-b2"}) EXPECT_TRUE(is_language_tag(good)) << good;
  for (const char* bad : {"", "1", "en-", "-en", "e1", "en--gb", "en_GB"}) {
    EXPECT_FALSE(is_language_tag(bad)) << bad;
  }
}

}  // namespace
}  // namespace sinew::rdf
