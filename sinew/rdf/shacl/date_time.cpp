#include "sinew/rdf/shacl/date_time.h"

#include <algorithm>

namespace sinew::rdf::shacl {
namespace {

// Years of more digits than this are refused: their seconds would not fit.
constexpr std::size_t kMaxYearDigits = 9;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Reads a text from its front; every function returns false where the text is otherwise.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}
  bool done() const { return text_.empty(); }
  bool literal(std::string_view expected) {
    if (!text_.starts_with(expected)) return false;
    text_.remove_prefix(expected.size());
    return true;
  }
  bool two_digits(int lowest, int highest, int& value) {
    if (text_.size() < 2 || !is_digit(text_[0]) || !is_digit(text_[1])) return false;
    value = (text_[0] - '0') * 10 + (text_[1] - '0');
    text_.remove_prefix(2);
    return value >= lowest && value <= highest;
  }
  std::string_view digits() {
    std::size_t count = 0;
    while (count < text_.size() && is_digit(text_[count])) ++count;
    const std::string_view found = text_.substr(0, count);
    text_.remove_prefix(count);
    return found;
  }
  // -?([1-9][0-9]{3,}|0[0-9]{3})
  bool year(std::int64_t& value) {
    const bool negative = literal("-");
    const std::string_view found = digits();
    if (found.size() < 4 || found.size() > kMaxYearDigits) return false;
    if (found.size() > 4 && found[0] == '0') return false;
    value = 0;
    for (const char c : found) value = value * 10 + (c - '0');
    if (negative) value = -value;
    return true;
  }

 private:
  std::string_view text_;
};

bool is_leap(std::int64_t year) { return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0); }

int days_in(std::int64_t year, int month) {
  constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  return month == 2 && is_leap(year) ? 29 : kDays[month - 1];
}

std::int64_t floor_divide(std::int64_t a, std::int64_t b) {
  return a / b - (a % b != 0 && (a % b < 0) != (b < 0));
}

// Days from 0001-01-01 in the proleptic Gregorian calendar; year 0 precedes year 1.
std::int64_t days_before(std::int64_t year, int month, int day) {
  const std::int64_t before = year - 1;
  std::int64_t days = before * 365 + floor_divide(before, 4) - floor_divide(before, 100) +
                      floor_divide(before, 400);
  for (int m = 1; m < month; ++m) days += days_in(year, m);
  return days + day - 1;
}

struct Parts {
  std::int64_t year = 1972;
  int month = 12, day = 31, hour = 0, minute = 0, second = 0;
  std::string fraction;
};

bool read_time(Reader& in, Parts& parts) {
  if (!in.two_digits(0, 24, parts.hour) || !in.literal(":") ||
      !in.two_digits(0, 59, parts.minute) || !in.literal(":") ||
      !in.two_digits(0, 59, parts.second)) {
    return false;
  }
  if (in.literal(".")) {
    parts.fraction = in.digits();
    if (parts.fraction.empty()) return false;
    parts.fraction.erase(parts.fraction.find_last_not_of('0') + 1);
  }
  // 24:00:00 is the end of the day.
  return parts.hour < 24 || (parts.minute == 0 && parts.second == 0 && parts.fraction.empty());
}

// Nothing, Z or (+|-)hh:mm; minutes east of UTC.
bool read_zone(Reader& in, bool& present, int& minutes) {
  if (in.done()) return true;
  present = true;
  if (in.literal("Z")) return true;
  const bool west = in.literal("-");
  if (!west && !in.literal("+")) return false;
  int hour = 0, minute = 0;
  if (!in.two_digits(0, 14, hour) || !in.literal(":") || !in.two_digits(0, 59, minute)) {
    return false;
  }
  if (hour == 14 && minute != 0) return false;
  minutes = (hour * 60 + minute) * (west ? -1 : 1);
  return true;
}

bool read_parts(Reader& in, DateKind kind, Parts& parts) {
  const auto month = [&] { return in.two_digits(1, 12, parts.month); };
  const auto day = [&] { return in.two_digits(1, 31, parts.day); };
  switch (kind) {
    case DateKind::kDateTime:
    case DateKind::kDateTimeStamp:
    case DateKind::kDate:
      if (!in.year(parts.year) || !in.literal("-") || !month() || !in.literal("-") || !day() ||
          parts.day > days_in(parts.year, parts.month)) {
        return false;
      }
      return kind == DateKind::kDate || (in.literal("T") && read_time(in, parts));
    case DateKind::kTime:
      return read_time(in, parts);
    case DateKind::kYear:
      return in.year(parts.year);
    case DateKind::kYearMonth:
      parts.day = 1;
      return in.year(parts.year) && in.literal("-") && month();
    case DateKind::kMonth:
      return in.literal("--") && month();
    case DateKind::kMonthDay:
      // 1972 was a leap year, so that --02-29 is possible.
      return in.literal("--") && month() && in.literal("-") && day() &&
             parts.day <= days_in(1972, parts.month);
    case DateKind::kDay:
      return in.literal("---") && day();
  }
  return false;
}

}  // namespace

std::optional<DateTime> parse_date_time(std::string_view text, DateKind kind) {
  Reader in(text);
  Parts parts;
  DateTime value;
  int zone_minutes = 0;
  if (!read_parts(in, kind, parts) || !read_zone(in, value.has_zone, zone_minutes) || !in.done()) {
    return std::nullopt;
  }
  if (kind == DateKind::kDateTimeStamp && !value.has_zone) return std::nullopt;
  const std::int64_t days = days_before(parts.year, parts.month, parts.day);
  value.seconds = ((days * 24 + parts.hour) * 60 + parts.minute - zone_minutes) * 60 + parts.second;
  value.fraction = std::move(parts.fraction);
  return value;
}

std::partial_ordering compare(const DateTime& a, const DateTime& b) {
  constexpr std::int64_t kFourteenHours = 14 * 3600;
  if (a.has_zone != b.has_zone) {
    const std::int64_t difference = a.seconds - b.seconds;
    if (difference < -kFourteenHours) return std::partial_ordering::less;
    if (difference > kFourteenHours) return std::partial_ordering::greater;
    return std::partial_ordering::unordered;
  }
  if (a.seconds != b.seconds) return a.seconds <=> b.seconds;
  return a.fraction <=> b.fraction;
}

bool is_duration(std::string_view text, DurationKind kind) {
  Reader in(text);
  in.literal("-");
  if (!in.literal("P")) return false;
  bool any = false, in_time = false, any_time = false;
  // The designators that may still come, in order; a time's come after T.
  std::string_view left = kind == DurationKind::kYearMonth ? "YM"
                          : kind == DurationKind::kDayTime ? "D"
                                                           : "YMD";
  while (!in.done()) {
    if (!in_time && kind != DurationKind::kYearMonth && in.literal("T")) {
      in_time = true;
      left = "HMS";
      continue;
    }
    if (in.digits().empty()) return false;
    bool fraction = false;
    if (in_time && in.literal(".")) {
      if (in.digits().empty()) return false;
      fraction = true;
    }
    std::size_t at = 0;
    while (at < left.size() && !in.literal(left.substr(at, 1))) ++at;
    if (at == left.size() || (fraction && left[at] != 'S')) return false;
    left.remove_prefix(at + 1);
    any = true;
    any_time = any_time || in_time;
  }
  return any && in_time == any_time;
}

}  // namespace sinew::rdf::shacl
