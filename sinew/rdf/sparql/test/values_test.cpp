// Decimals, dates, durations and regular expressions on their own.
#include <gtest/gtest.h>

#include <cmath>

#include "sinew/base/error.h"
#include "sinew/rdf/sparql/values/date_time.h"
#include "sinew/rdf/sparql/values/decimal.h"
#include "sinew/rdf/sparql/values/numbers.h"
#include "sinew/rdf/sparql/values/regex.h"

namespace sinew::rdf::sparql::values {
namespace {

std::string text(const std::optional<Decimal>& value) { return value ? to_string(*value) : "-"; }
Decimal decimal(std::string_view lexical) { return parse_decimal(lexical).value(); }

TEST(Decimals, AreReadAndWrittenExactly) {
  for (const auto& [lexical, canonical] :
       {std::pair("0", "0"),
        {"-0.0", "0"},
        {"+007.50", "7.5"},
        {".5", "0.5"},
        {"5.", "5"},
        {"-.25", "-0.25"},
        {"170141183460469231731687303715884105727", "170141183460469231731687303715884105727"},
        {"0.000000000000000000000000000000000001", "0.000000000000000000000000000000000001"},
        {"1.5000000000000000000000000000000000000000000000", "1.5"},
        {"", "-"},
        {".", "-"},
        {"1e3", "-"},
        {"--1", "-"},
        {"170141183460469231731687303715884105728", "-"},
        {"0.0000000000000000000000000000000000001", "-"}}) {
    EXPECT_EQ(text(parse_decimal(lexical)), canonical) << lexical;
  }
}

TEST(Decimals, ComputeExactlyOrNotAtAll) {
  EXPECT_EQ(text(add(decimal("0.1"), decimal("0.2"))), "0.3");
  EXPECT_EQ(text(subtract(decimal("1"), decimal("0.0001"))), "0.9999");
  EXPECT_EQ(text(multiply(decimal("-1.5"), decimal("2.5"))), "-3.75");
  EXPECT_EQ(text(divide(decimal("2"), decimal("3"))), "0.666666666666666667");
  EXPECT_EQ(text(divide(decimal("-2"), decimal("3"))), "-0.666666666666666667");
  EXPECT_EQ(text(divide(decimal("1"), decimal("0"))), "-");
  const Decimal huge = decimal("170141183460469231731687303715884105727");
  EXPECT_EQ(text(add(huge, decimal("1"))), "-");
  EXPECT_EQ(text(multiply(huge, decimal("2"))), "-");
  EXPECT_EQ(text(divide(huge, decimal("1"))), text(huge));
  // Half of it has a digit more than there is room for.
  EXPECT_EQ(text(divide(huge, decimal("2"))), "-");
  EXPECT_EQ(compare(huge, decimal("0.000001")), 1);
  EXPECT_EQ(compare(negate(huge), decimal("-0.000001")), -1);
}

TEST(Decimals, RoundTowardsWhatIsAsked) {
  for (const auto& [value, floor, ceiling, half_up] : {std::tuple("2.5", "2", "3", "3"),
                                                       {"-2.5", "-3", "-2", "-2"},
                                                       {"2.4", "2", "3", "2"},
                                                       {"-2.6", "-3", "-2", "-3"},
                                                       {"7", "7", "7", "7"}}) {
    EXPECT_EQ(to_string(round(decimal(value), Rounding::kFloor)), floor) << value;
    EXPECT_EQ(to_string(round(decimal(value), Rounding::kCeiling)), ceiling) << value;
    EXPECT_EQ(to_string(round(decimal(value), Rounding::kHalfUp)), half_up) << value;
  }
}

TEST(Doubles, HaveACanonicalFormAndOneForPeople) {
  for (const auto& [value, canonical, plain] : {std::tuple(1.0, "1.0E0", "1"),
                                                {-0.5, "-5.0E-1", "-0.5"},
                                                {123456.0, "1.23456E5", "123456"},
                                                {1e6, "1.0E6", "1.0E6"},
                                                {1e-6, "1.0E-6", "0.000001"},
                                                {1.5e-7, "1.5E-7", "1.5E-7"},
                                                {0.0, "0.0E0", "0"},
                                                {-0.0, "-0.0E0", "-0"}}) {
    EXPECT_EQ(double_text(value), canonical);
    EXPECT_EQ(double_as_string(value), plain);
  }
  EXPECT_EQ(parse_double("-INF"), -HUGE_VAL);
  EXPECT_EQ(parse_double("inf"), std::nullopt);
  EXPECT_EQ(parse_double("0x1p3"), std::nullopt);
  EXPECT_EQ(parse_double("1e999"), HUGE_VAL);
}

TEST(Instants, AreReadByTheCalendar) {
  for (const char* good :
       {"2024-02-29T00:00:00", "-0044-03-15T12:00:00Z", "0000-01-01T00:00:00Z",
        "2024-12-31T24:00:00", "12024-01-01T00:00:00+14:00", "2024-01-01T00:00:00.000001-00:30"}) {
    EXPECT_TRUE(parse_instant(good, Datatype::kDateTime)) << good;
  }
  for (const char* bad :
       {"2023-02-29T00:00:00", "2024-13-01T00:00:00", "2024-1-01T00:00:00", "2024-01-01", "",
        "2024-01-01T24:00:01", "2024-01-01T00:00:60", "2024-01-01T00:00:00+15:00",
        "02024-01-01T00:00:00", "2024-01-01T00:00:00 ", "2024-01-01T00:00"}) {
    EXPECT_FALSE(parse_instant(bad, Datatype::kDateTime)) << bad;
  }
}

TEST(Instants, GoThroughTheWholeCalendarAndBack) {
  for (int year = -401; year < 2500; year += 7) {
    for (int month = 1; month <= 12; ++month) {
      const std::string day = (year < 0 ? "-" : "") +
                              std::string(year < 0 ? (year > -1000 ? "0" : "")
                                                   : (year < 10     ? "000"
                                                      : year < 100  ? "00"
                                                      : year < 1000 ? "0"
                                                                    : "")) +
                              std::to_string(std::abs(year)) + (month < 10 ? "-0" : "-") +
                              std::to_string(month) + "-28";
      if (year < 0 && year > -100) continue;
      const auto instant = parse_instant(day, Datatype::kDate);
      ASSERT_TRUE(instant) << day;
      EXPECT_EQ(to_string(*instant, Datatype::kDate), day);
      constexpr std::int64_t k400Days = std::int64_t{86'400} * 400;
      const auto later = add(*instant, {0, Decimal::of(k400Days)});
      EXPECT_EQ(compare(*add(*later, {0, Decimal::of(-k400Days)}), *instant), TimeOrder::kSame);
    }
  }
}

TEST(Durations, AreReadAndWrittenInCanonicalForm) {
  for (const auto& [lexical, canonical] : {std::pair("P14M", "P1Y2M"),
                                           {"PT36H", "P1DT12H"},
                                           {"-PT90.5S", "-PT1M30.5S"},
                                           {"P0D", "PT0S"},
                                           {"P1Y2M3DT4H5M6.7S", "P1Y2M3DT4H5M6.7S"}}) {
    EXPECT_EQ(to_string(parse_duration(lexical, Datatype::kDuration).value(), Datatype::kDuration),
              canonical);
  }
  for (const char* bad :
       {"P", "PT", "1D", "P1H", "PT1D", "P1D1Y", "P-1D", "P1.5D", "PT1.S", "P1DT"}) {
    EXPECT_FALSE(parse_duration(bad, Datatype::kDuration)) << bad;
  }
  EXPECT_FALSE(parse_duration("P1M", Datatype::kDayTimeDuration));
  EXPECT_FALSE(parse_duration("P1D", Datatype::kYearMonthDuration));
}

struct Match {
  const char* pattern;
  const char* flags;
  const char* text;
  const char* outcome;  // yes, no, or bad for a pattern that is not allowed
};
std::ostream& operator<<(std::ostream& out, const Match& m) { return out << m.pattern; }
class Regexes : public testing::TestWithParam<Match> {};

TEST_P(Regexes, AreThoseOfXPath) {
  const auto regex = Regex::compile(GetParam().pattern, GetParam().flags);
  const std::string outcome = !regex ? "bad" : regex->search(GetParam().text) ? "yes" : "no";
  EXPECT_EQ(outcome, GetParam().outcome);
}

INSTANTIATE_TEST_SUITE_P(
    All, Regexes,
    testing::Values(
        Match{"a.c", "", "a\nc", "no"}, Match{"a.c", "s", "a\nc", "yes"},
        Match{"a.c", "", "a\rc", "no"}, Match{"^b", "", "a\nb", "no"},
        Match{"^b", "m", "a\nb", "yes"}, Match{"a$", "", "a\n", "no"},
        Match{"^\\d+$", "", "\u0661\u0662", "yes"}, Match{"^\\w+$", "", "größe", "yes"},
        Match{"\\w", "", "-!", "no"}, Match{"^\\i\\c*$", "", "a-b.c", "yes"},
        Match{"^\\i", "", "1a", "no"}, Match{"^\\s$", "", "\u00A0", "no"},
        Match{"\\p{Lu}", "", "aÄ", "yes"}, Match{"\\P{L}", "", "ab", "no"},
        Match{"^\\p{IsGreek}+$", "", "αβγ", "yes"}, Match{"^[a-z-[aeiou]]+$", "", "xyz", "yes"},
        Match{"^[a-z-[aeiou]]+$", "", "xaz", "no"}, Match{"^[^a-c]$", "", "d", "yes"},
        Match{"^[\\d\\-]+$", "", "1-2", "yes"}, Match{"a{2,3}?", "", "aa", "yes"},
        Match{"(a)\\1", "", "aa", "yes"}, Match{"(a)(?:b)c", "", "abc", "yes"},
        Match{"A", "i", "ä a", "yes"}, Match{"Ä", "i", "ä", "yes"}, Match{"a b", "x", "ab", "yes"},
        Match{"a.b*", "q", "a.b*", "yes"}, Match{"\\.\\\\", "", ".\\", "yes"},
        Match{"", "", "anything", "yes"}, Match{"#", "", "#", "yes"},
        Match{"(?=a)", "", "a", "bad"}, Match{"(?<n>a)", "", "a", "bad"},
        Match{"\\bword", "", "word", "bad"}, Match{"a++", "", "a", "bad"},
        Match{"*a", "", "a", "bad"}, Match{"(a", "", "a", "bad"}, Match{"a)", "", "a", "bad"},
        Match{"[a", "", "a", "bad"}, Match{"[]", "", "a", "bad"}, Match{"\\1(a)", "", "a", "bad"},
        Match{"a{,2}", "", "a", "bad"}, Match{"\\p{Foo}", "", "a", "bad"},
        Match{"a", "z", "a", "bad"}, Match{"a}", "", "a", "bad"}, Match{"[z-a]", "", "a", "bad"}));

TEST(Replacement, FillsInGroups) {
  const auto replaced = [](const char* pattern, const char* replacement, const char* text) {
    return Regex::compile(pattern, "")->replace(text, replacement).value_or("error");
  };
  EXPECT_EQ(replaced("b", "[$0]", "abcb"), "a[b]c[b]");
  EXPECT_EQ(replaced("(a)(x)?", "$1$2-", "ab"), "a-b");
  EXPECT_EQ(replaced("a", "\\$\\\\", "a"), "$\\");
  EXPECT_EQ(replaced("(a)", "$12", "a"), "a2");
  EXPECT_EQ(replaced("a", "$", "a"), "error");
  EXPECT_EQ(replaced("a", "\\n", "b"), "error");
  EXPECT_EQ(replaced("a*", "x", "b"), "error");
  EXPECT_EQ(replaced("ü", "ue", "für über"), "fuer ueber");
}

}  // namespace
}  // namespace sinew::rdf::sparql::values
