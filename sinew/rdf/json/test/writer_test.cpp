#include "sinew/rdf/json/writer.h"

#include <gtest/gtest.h>

#include "sinew/rdf/json/reader.h"

namespace sinew::json {
namespace {

TEST(JsonWriter, PrintsNumbersLikeEcmaScript) {
  const std::pair<double, const char*> cases[] = {
      {0.0, "0"},
      {-0.0, "0"},
      {1.0, "1"},
      {-1.5, "-1.5"},
      {1e20, "100000000000000000000"},
      {1e21, "1e+21"},
      {1e-6, "0.000001"},
      {1e-7, "1e-7"},
      {1.5e-7, "1.5e-7"},
      {123456.789, "123456.789"},
      {5e-324, "5e-324"},
      {1.7976931348623157e308, "1.7976931348623157e+308"},
      {0.1, "0.1"},
      {333333333.33333329, "333333333.3333333"},
      {4.5, "4.5"},
      {2e-3, "0.002"},
  };
  for (const auto& [value, text] : cases) EXPECT_EQ(ecmascript_number(value), text);
}

// The example of RFC 8785, section 3.2.
TEST(JsonWriter, CanonicalFormSortsKeysByUtf16AndNormalisesNumbers) {
  const Document document = read(
      R"({"numbers":[333333333.33333329,1E30,4.50,2e-3,0.000000000000000000000000001],)"
      R"("string":"\u20ac$\u000F\u000aA'\u0042\u0022\u005c\\\"\/","literals":[null,true,false]})",
      "f");
  EXPECT_EQ(to_canonical_text(document.root),
            R"({"literals":[null,true,false],"numbers":[333333333.3333333,1e+30,4.5,0.002,1e-27],)"
            R"("string":"€$\u000f\nA'B\"\\\\\"/"})");
  const Document keys =
      read(R"({"\u20ac":1,"\r":2,"\ufb33":3,"1":4,"\ud83d\ude00":5,"\u0080":6,"\u00f6":7})", "f");
  EXPECT_EQ(to_canonical_text(keys.root),
            "{\"\\r\":2,\"1\":4,\"\xC2\x80\":6,\"ö\":7,\"€\":1,\"😀\":5,\"\xEF\xAC\xB3\":3}");
}

TEST(JsonWriter, CanonicalFormKeepsNumbersBeyondDoublesAsTheyWereWritten) {
  const Document document = read("[1E30000000, -1e400, 1e308]", "numbers.json");
  EXPECT_EQ(to_canonical_text(document.root), "[1E30000000,-1e400,1e+308]");
}

TEST(JsonWriter, PrettyTextKeepsShortThingsOnOneLine) {
  const Document document =
      read(R"({"a":[1,2,3],"b":{"c":"d"},"e":[[1,0],[0,1]],"f":[],"g":{}})", "f");
  EXPECT_EQ(to_pretty_text(document.root), R"({
  "a": [1, 2, 3],
  "b": { "c": "d" },
  "e": [
    [1, 0],
    [0, 1]
  ],
  "f": [],
  "g": {}
}
)");
}

TEST(JsonWriter, PrettyTextStaysWithinTheWidth) {
  const Document document =
      read(R"({"names":["aaaaaaaaaa","bbbbbbbbbb"],"numbers":[1.5,2.5,3.5,4.5,5.5]})", "f");
  EXPECT_EQ(to_pretty_text(document.root, 24), R"({
  "names": [
    "aaaaaaaaaa",
    "bbbbbbbbbb"
  ],
  "numbers": [
    1.5, 2.5, 3.5, 4.5,
    5.5
  ]
}
)");
}

TEST(JsonWriter, WhatIsWrittenReadsBackEqual) {
  const Document document =
      read(R"({"a\u0001\"\\":[null,true,-0.5e-10,"é\n"],"b":{"c":[{}]}})", "f");
  for (const std::string& text :
       {to_text(document.root), to_pretty_text(document.root), to_canonical_text(document.root)}) {
    EXPECT_TRUE(equal(document.root, read(text, "again").root)) << text;
  }
}

TEST(JsonNumber, IsRecognised) {
  for (const char* text : {"0", "-0", "10.5", "1e5", "1E+5", "-0.0e-0"})
    EXPECT_TRUE(is_number(text)) << text;
  for (const char* text : {"", "-", "01", "1.", ".5", "+1", "1e", "NaN", "1 "})
    EXPECT_FALSE(is_number(text)) << text;
}

}  // namespace
}  // namespace sinew::json
