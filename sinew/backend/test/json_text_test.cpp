#include "sinew/backend/json_text.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace sinew::backend {
namespace {

using nlohmann::json;

TEST(JsonText, IsReadAsWhatWasWritten) {
  std::string every;
  for (char c = 1; c > 0; ++c) every += c;
  every += "ü\xe2\x82\xac";
  JsonText text;
  text.begin_object().member("text", every).member("empty", std::vector<double>{});
  text.member("numbers", std::vector<double>{0.1, -3.0, 1e300, 5e-324, 123456789.0});
  text.key("mixed").begin_array().value(1U).value("a:").begin_object().end_object();
  text.begin_array().value(-7).end_array().end_array();
  text.member("none", std::numeric_limits<double>::quiet_NaN()).end_object();
  const json read = json::parse(text.take());
  EXPECT_EQ(read.at("text"), every);
  EXPECT_TRUE(read.at("empty").empty());
  EXPECT_EQ(read.at("numbers"), json({0.1, -3.0, 1e300, 5e-324, 123456789.0}));
  EXPECT_TRUE(read.at("numbers").at(1).is_number_float());
  EXPECT_EQ(read.at("mixed"), json::parse("[1, \"a:\", {}, [-7]]"));
  EXPECT_TRUE(read.at("none").is_null());
}

TEST(JsonText, WritesPairsHoweverManyThereAre) {
  for (const std::size_t count : {0U, 1U, 2U, 100U, 5000U}) {
    std::vector<std::uint64_t> numbers;
    json expected = json::array();
    for (std::size_t k = 0; k < count; ++k) {
      numbers.push_back(k % 7 == 0 ? std::numeric_limits<std::uint64_t>::max() - k : k * k);
      expected.push_back({numbers.back(), numbers.back() / 3});
    }
    JsonText text;
    text.pairs(
        numbers, [](std::uint64_t n) { return n; }, [](std::uint64_t n) { return n / 3; });
    EXPECT_EQ(json::parse(text.take()), expected) << count;
  }
}

}  // namespace
}  // namespace sinew::backend
