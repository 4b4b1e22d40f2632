// The date and time datatypes of XML Schema 1.1 part 2: lexical forms, and the order of dateTimes.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sinew::rdf::shacl {

// dateTime, dateTimeStamp, date, time, gYear, gYearMonth, gMonth, gMonthDay, gDay.
enum class DateKind : std::uint8_t {
  kDateTime,
  kDateTimeStamp,
  kDate,
  kTime,
  kYear,
  kYearMonth,
  kMonth,
  kMonthDay,
  kDay
};

// A point on the time line: seconds since 0001-01-01T00:00:00, with the fraction's digits (without
// trailing zeros) aside, so that nothing is rounded.
struct DateTime {
  std::int64_t seconds = 0;
  std::string fraction;
  bool has_zone = false;  // seconds are of UTC, else local
};

// Empty when the text is not in the lexical space. Parts that the kind lacks are those of
// 1972-12-31T00:00:00 (XML Schema 1.1 part 2, appendix E.3.3).
std::optional<DateTime> parse_date_time(std::string_view text, DateKind kind);

// Unordered when only one of the two has a time zone and the difference is within 14 hours.
std::partial_ordering compare(const DateTime& a, const DateTime& b);

// duration, and its subtypes that have no days and no months part, respectively.
enum class DurationKind : std::uint8_t { kAny, kYearMonth, kDayTime };
bool is_duration(std::string_view text, DurationKind kind);

}  // namespace sinew::rdf::shacl
