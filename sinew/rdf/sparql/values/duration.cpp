#include <fmt/format.h>

#include "sinew/rdf/sparql/values/date_time.h"

namespace sinew::rdf::sparql::values {
namespace {

// The value of a run of digits; what is too long is out of range anyway.
bool read_whole(std::string_view digits, std::int64_t& value) {
  if (digits.empty() || digits.size() > 13) return false;
  value = 0;
  for (const char digit : digits) value = value * 10 + (digit - '0');
  return true;
}

}  // namespace

std::optional<Duration> parse_duration(std::string_view text, Datatype type) {
  const bool negative = !text.empty() && text[0] == '-';
  if (negative) text.remove_prefix(1);
  if (text.empty() || text[0] != 'P') return std::nullopt;
  text.remove_prefix(1);
  if (text.empty()) return std::nullopt;
  // Each unit at most once, in this order.
  static constexpr std::string_view kDateUnits = "YMD";
  static constexpr std::string_view kTimeUnits = "HMS";
  Duration result;
  bool in_time = false;
  bool any_behind_t = false;
  std::size_t next_unit = 0;
  bool has_months = false;
  bool has_days = false;
  while (!text.empty()) {
    if (text[0] == 'T' && !in_time) {
      in_time = true;
      next_unit = 0;
      text.remove_prefix(1);
      continue;
    }
    const std::size_t length = text.find_first_not_of("0123456789.");
    if (length == 0 || length == std::string_view::npos) return std::nullopt;
    const std::string_view number = text.substr(0, length);
    const std::string_view units = in_time ? kTimeUnits : kDateUnits;
    const std::size_t unit = units.find(text[length]);
    if (unit == std::string_view::npos || unit < next_unit) return std::nullopt;
    next_unit = unit + 1;
    text.remove_prefix(length + 1);
    if (in_time) any_behind_t = true;
    if (in_time && unit == 2) {
      const auto seconds = parse_decimal(number);
      if (!seconds || number.front() == '.' || number.back() == '.') return std::nullopt;
      const auto sum = add(result.seconds, *seconds);
      if (!sum) return std::nullopt;
      result.seconds = *sum;
      has_days = true;
      continue;
    }
    std::int64_t whole = 0;
    if (!read_whole(number, whole) || number.find('.') != std::string_view::npos) {
      return std::nullopt;
    }
    if (!in_time && unit < 2) {
      result.months += whole * (unit == 0 ? 12 : 1);
      has_months = true;
      continue;
    }
    static constexpr std::int64_t kSeconds[] = {3600, 60};
    const std::int64_t factor = in_time ? kSeconds[unit] : 86'400;
    result.seconds = add(result.seconds, Decimal::of(whole * factor)).value_or(Decimal{});
    has_days = true;
  }
  if ((in_time && !any_behind_t) || (!has_months && !has_days)) return std::nullopt;
  if (type == Datatype::kDayTimeDuration && has_months) return std::nullopt;
  if (type == Datatype::kYearMonthDuration && has_days) return std::nullopt;
  if (negative) {
    result.months = -result.months;
    result.seconds = negate(result.seconds);
  }
  if (!in_range(result)) return std::nullopt;
  return result;
}

bool in_range(const Duration& duration) {
  const Decimal most = Decimal::of(kMostYears * 366 * 86'400);
  return duration.months <= kMostYears * 12 && duration.months >= -kMostYears * 12 &&
         compare(duration.seconds, most) <= 0 && compare(duration.seconds, negate(most)) >= 0;
}

std::string to_string(const Duration& duration, Datatype type) {
  const bool negative = duration.months < 0 || duration.seconds.coefficient < 0;
  const std::int64_t months = negative ? -duration.months : duration.months;
  const Decimal seconds = negative ? negate(duration.seconds) : duration.seconds;
  std::string text = negative ? "-P" : "P";
  if (months / 12 != 0) text += fmt::format("{}Y", months / 12);
  if (months % 12 != 0) text += fmt::format("{}M", months % 12);
  const Decimal whole = round(seconds, Rounding::kFloor);
  const std::int64_t all = to_int64(whole).value_or(0);
  const Decimal rest = subtract(seconds, Decimal::of(all / 60 * 60)).value_or(Decimal{});
  if (all / 86'400 != 0) text += fmt::format("{}D", all / 86'400);
  std::string time;
  if (all / 3600 % 24 != 0) time += fmt::format("{}H", all / 3600 % 24);
  if (all / 60 % 60 != 0) time += fmt::format("{}M", all / 60 % 60);
  if (rest.coefficient != 0) time += to_string(rest) + "S";
  if (!time.empty()) text += "T" + time;
  if (text.back() == 'P') text += type == Datatype::kYearMonthDuration ? "0M" : "T0S";
  return text;
}

TimeOrder compare(const Duration& a, const Duration& b) {
  const int seconds = compare(a.seconds, b.seconds);
  const int months = a.months < b.months ? -1 : a.months > b.months ? 1 : 0;
  if (months == 0 && seconds == 0) return TimeOrder::kSame;
  if (months <= 0 && seconds <= 0) return TimeOrder::kBefore;
  if (months >= 0 && seconds >= 0) return TimeOrder::kAfter;
  return TimeOrder::kUnknown;
}

}  // namespace sinew::rdf::sparql::values
