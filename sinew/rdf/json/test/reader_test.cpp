#include "sinew/rdf/json/reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "sinew/base/error.h"

namespace sinew::json {
namespace {

Problem fault(std::string_view text) {
  try {
    read(text, "file.json");
  } catch (const Error& error) {
    return error.problems().front();
  }
  return {};
}

TEST(JsonReader, KnowsTheLineAndColumnOfEveryKeyAndValue) {
  const Document document = read("{\n  \"a\": [1,\n  {\"b\" : null}]\n}", "file.json");
  const Member& a = document.root.members()[0];
  EXPECT_EQ(a.key.position().line, 2u);
  EXPECT_EQ(a.key.position().column, 3u);
  EXPECT_EQ(a.value.position().column, 8u);
  const Member& b = a.value.items()[1].members()[0];
  EXPECT_EQ(b.key.position().line, 3u);
  EXPECT_EQ(b.key.position().column, 4u);
  EXPECT_EQ(b.value.position().column, 10u);
}

TEST(JsonReader, KeepsNumbersAsTheyWereWrittenAndAsTheNearestDouble) {
  const Document document = read("[0.30, -1E+2, 1e400, -1e-400, 12345678901234567890]", "f");
  const auto items = document.root.items();
  EXPECT_EQ(items[0].text(), "0.30");
  EXPECT_EQ(items[0].number(), 0.3);
  EXPECT_EQ(items[1].number(), -100.0);
  EXPECT_TRUE(std::isinf(items[2].number()));
  EXPECT_EQ(items[3].number(), 0.0);
  EXPECT_EQ(items[4].text(), "12345678901234567890");
}

TEST(JsonReader, UndoesEscapes) {
  const Document document = read(R"(["\"\\\/\b\f\n\r\t", "\u00e9\u20AC\ud83d\ude00"])", "f");
  EXPECT_EQ(document.root.items()[0].text(), "\"\\/\b\f\n\r\t");
  EXPECT_EQ(document.root.items()[1].text(), "é€😀");
}

TEST(JsonReader, KeepsTheOrderOfMembersAndFindsThemInLargeObjects) {
  std::string text = "{";
  for (int i = 0; i < 1000; ++i)
    text += (i ? ",\"k" : "\"k") + std::to_string(i) + "\":" + std::to_string(i);
  const Document document = read(text + "}", "f");
  ASSERT_EQ(document.root.members().size(), 1000u);
  EXPECT_EQ(document.root.members()[999].name(), "k999");
  EXPECT_EQ(document.root.find("k500")->text(), "500");
  EXPECT_EQ(document.root.find("k1000"), nullptr);
}

TEST(JsonReader, RefusesWhatIsNotJsonAndSaysWhere) {
  struct Case {
    std::string_view text;
    std::size_t line, column;
    std::string_view words;
  };
  const Case cases[] = {
      {"", 1, 1, "the file ends where a value is expected"},
      {"{\"a\": 1,\n\"a\": 2}", 2, 1, "stands twice"},
      {"[1, 2,]", 1, 7, "starts no value"},
      {"{\"a\" 1}", 1, 6, "follows a key"},
      {"{\"a\": 1 \"b\": 2}", 1, 9, "follows a member"},
      {"{a: 1}", 1, 2, "a key is expected"},
      {"[1 2]", 1, 4, "follows an item"},
      {"[01]", 1, 3, "needless 0"},
      {"[1.]", 1, 4, "in a number"},
      {"[+1]", 1, 2, "starts no value"},
      {"[NaN]", 1, 2, "starts no value"},
      {"[tru]", 1, 2, "starts no value"},
      {"\"abc", 1, 5, "ends inside a string"},
      {"\"a\nb\"", 1, 3, "control character"},
      {"\"\\x\"", 1, 3, "after a backslash"},
      {"\"\\ud800\"", 1, 8, "surrogate"},
      {"\"\\ud800\\u0041\"", 1, 14, "surrogate"},
      {"\"\\u12g4\"", 1, 6, "after \\u"},
      {"1 2", 1, 3, "follows the end"},
      {"[\n\"\xC0\x80\"]", 2, 2, "not valid UTF-8"},
      {"\"\xED\xA0\x80\"", 1, 2, "not valid UTF-8"},
      {"// comment\n1", 1, 1, "starts no value"},
  };
  for (const Case& c : cases) {
    const Problem problem = fault(c.text);
    EXPECT_NE(problem.what.find(c.words), std::string::npos) << c.text << "\n"
                                                             << to_string(problem);
    EXPECT_EQ(problem.place.line, c.line) << c.text;
    EXPECT_EQ(problem.place.column, c.column) << c.text;
    EXPECT_EQ(problem.place.file, "file.json");
    EXPECT_EQ(problem.code, "loading document failed");
  }
}

TEST(JsonReader, RefusesHostileDocumentsQuickly) {
  EXPECT_NE(fault(std::string(100 << 20, '[')).what.find("larger than 64 MiB"), std::string::npos);
  EXPECT_NE(fault(std::string(60 << 20, '[')).what.find("nested more than 200"), std::string::npos);
  std::string many = "[";
  for (std::size_t i = 0; i < kMaxValues; ++i) many += "1,";
  EXPECT_NE(fault(many + "1]").what.find("more than 4194304 values"), std::string::npos);
}

TEST(JsonReader, AcceptsWhatIsJustWithinTheLimitOfDepth) {
  const std::string text = std::string(kMaxDepth, '[') + std::string(kMaxDepth, ']');
  EXPECT_TRUE(read(text, "f").root.is_array());
  EXPECT_NE(fault("[" + text + "]").what.find("nested"), std::string::npos);
}

TEST(JsonValue, ComparesObjectsWhateverTheOrderOfMembers) {
  const Document a = read(R"({"x": [1.0, true], "y": {"z": null}})", "f");
  const Document b = read(R"({"y": {"z": null}, "x": [1, true]})", "f");
  const Document c = read(R"({"y": {"z": null}, "x": [true, 1]})", "f");
  EXPECT_TRUE(equal(a.root, b.root));
  EXPECT_FALSE(equal(a.root, c.root));
}

TEST(JsonValue, ErasesMembers) {
  Arena arena;
  Value object = Value::object(arena);
  std::vector<std::string> keys;
  for (int i = 0; i < 40; ++i) keys.push_back("k" + std::to_string(i));
  for (const std::string& key : keys) object.set(arena, Value::string(key), Value::boolean(true));
  object.erase("k0");
  object.erase("k20");
  EXPECT_EQ(object.members().size(), 38u);
  EXPECT_EQ(object.find("k20"), nullptr);
  EXPECT_NE(object.find("k21"), nullptr);
  EXPECT_NE(object.find("k39"), nullptr);
}

}  // namespace
}  // namespace sinew::json
