// xsd:dateTime, xsd:date, xsd:time and the durations: reading, writing, parts, and the calendar
// (XML Schema 1.1, part 2, appendix E; proleptic Gregorian calendar, no leap seconds).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "sinew/rdf/sparql/values/decimal.h"
#include "sinew/rdf/sparql/values/xsd.h"

namespace sinew::rdf::sparql::values {

// An instant, as seconds since 1970-01-01T00:00:00 on the UTC clock; without a time zone, on a
// clock of unknown zone. A date is its first instant; a time is one of the day 1972-12-31.
struct Instant {
  static constexpr int kNoZone = INT16_MIN;
  Decimal seconds;
  int zone_minutes = kNoZone;  // east of UTC
  bool has_zone() const { return zone_minutes != kNoZone; }
};

// As a clock on the wall shows it.
struct Clock {
  std::int64_t year = 0;
  int month = 1, day = 1, hour = 0, minute = 0;
  Decimal second;
};

struct Duration {
  std::int64_t months = 0;
  Decimal seconds;  // both of the same sign
};

// Years beyond this are not computed with: such a literal has no value.
inline constexpr std::int64_t kMostYears = 999'999'999;

// `type`: kDateTime, kDate or kTime.
std::optional<Instant> parse_instant(std::string_view text, Datatype type);
std::string to_string(const Instant& instant, Datatype type);
Clock clock_of(const Instant& instant);
// "Z", "+01:30", or nothing without a zone.
std::string zone_text(const Instant& instant);

// `type`: kDuration, kDayTimeDuration or kYearMonthDuration.
std::optional<Duration> parse_duration(std::string_view text, Datatype type);
std::string to_string(const Duration& duration, Datatype type);
// At most kMostYears long.
bool in_range(const Duration& duration);

// Months first, to the last day of the month where the day does not exist; then seconds (appendix
// E.1).
std::optional<Instant> add(const Instant& instant, const Duration& duration);

enum class TimeOrder : std::uint8_t { kBefore, kSame, kAfter, kUnknown };
// Unknown where only one has a zone and 14 hours could turn the order round.
TimeOrder compare(const Instant& a, const Instant& b);
TimeOrder compare(const Duration& a, const Duration& b);

}  // namespace sinew::rdf::sparql::values
