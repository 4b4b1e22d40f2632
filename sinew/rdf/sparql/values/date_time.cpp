#include "sinew/rdf/sparql/values/date_time.h"

#include <fmt/format.h>

#include <algorithm>

namespace sinew::rdf::sparql::values {
namespace {

constexpr std::int64_t kMinuteSeconds = 60, kHourSeconds = 3600;
constexpr std::int64_t kDaySeconds = 86'400;

// Days since 1970-01-01 of a day of the proleptic Gregorian calendar, by counting eras of 400 years
// of 146097 days that begin in March.
std::int64_t days_of(std::int64_t year, int month, int day) {
  year -= month <= 2 ? 1 : 0;
  const std::int64_t era = (year >= 0 ? year : year - 399) / 400;
  const std::int64_t year_of_era = year - era * 400;
  const std::int64_t day_of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  const std::int64_t day_of_era =
      year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year;
  return era * 146'097 + day_of_era - 719'468;
}

void set_day(Clock& clock, std::int64_t days) {
  days += 719'468;
  const std::int64_t era = (days >= 0 ? days : days - 146'096) / 146'097;
  const std::int64_t day_of_era = days - era * 146'097;
  const std::int64_t year_of_era =
      (day_of_era - day_of_era / 1460 + day_of_era / 36'524 - day_of_era / 146'096) / 365;
  const std::int64_t day_of_year =
      day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
  const std::int64_t month_from_march = (5 * day_of_year + 2) / 153;
  clock.day = static_cast<int>(day_of_year - (153 * month_from_march + 2) / 5 + 1);
  clock.month =
      static_cast<int>(month_from_march < 10 ? month_from_march + 3 : month_from_march - 9);
  clock.year = year_of_era + era * 400 + (clock.month <= 2 ? 1 : 0);
}

int days_in_month(std::int64_t year, int month) {
  static constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return month == 2 && leap ? 29 : kDays[month - 1];
}

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}
  bool done() const { return text_.empty(); }
  bool accept(char c) {
    if (text_.empty() || text_[0] != c) return false;
    text_.remove_prefix(1);
    return true;
  }
  // As many digits as there are.
  std::string_view digits() {
    std::size_t count = 0;
    while (count < text_.size() && text_[count] >= '0' && text_[count] <= '9') ++count;
    const std::string_view result = text_.substr(0, count);
    text_.remove_prefix(count);
    return result;
  }
  // Exactly two digits, at most `most`; -1 if there is no such number.
  int two(int least, int most) {
    const std::string_view found = digits();
    if (found.size() != 2) return -1;
    const int value = (found[0] - '0') * 10 + (found[1] - '0');
    return value >= least && value <= most ? value : -1;
  }
  // Digits, and a point with more of them.
  std::string_view decimal() {
    const char* const begin = text_.data();
    std::size_t length = digits().size();
    if (!text_.empty() && text_[0] == '.') {
      text_.remove_prefix(1);
      length += 1 + digits().size();
    }
    return {begin, length};
  }

 private:
  std::string_view text_;
};

bool read_year(Reader& reader, Clock& clock) {
  const bool negative = reader.accept('-');
  const std::string_view digits = reader.digits();
  if (digits.size() < 4 || (digits.size() > 4 && digits[0] == '0') || digits.size() > 9) {
    return false;
  }
  for (const char digit : digits) clock.year = clock.year * 10 + (digit - '0');
  if (negative) clock.year = -clock.year;
  return true;
}

bool read_date(Reader& reader, Clock& clock) {
  if (!read_year(reader, clock) || !reader.accept('-')) return false;
  clock.month = reader.two(1, 12);
  if (clock.month < 0 || !reader.accept('-')) return false;
  clock.day = reader.two(1, 31);
  return clock.day > 0 && clock.day <= days_in_month(clock.year, clock.month);
}

bool read_time(Reader& reader, Clock& clock) {
  clock.hour = reader.two(0, 24);
  if (clock.hour < 0 || !reader.accept(':')) return false;
  clock.minute = reader.two(0, 59);
  if (clock.minute < 0 || !reader.accept(':')) return false;
  const std::string_view text = reader.decimal();
  const std::size_t point = text.find('.');
  if ((point == std::string_view::npos ? text.size() : point) != 2 || text.back() == '.')
    return false;
  const auto second = parse_decimal(text);
  if (!second || compare(*second, Decimal::of(60)) >= 0) return false;
  clock.second = *second;
  // 24:00:00 is the end of the day.
  return clock.hour < 24 || (clock.minute == 0 && second->coefficient == 0);
}

bool read_zone(Reader& reader, int& zone) {
  if (reader.done()) return true;
  if (reader.accept('Z')) {
    zone = 0;
    return reader.done();
  }
  const bool west = reader.accept('-');
  if (!west && !reader.accept('+')) return false;
  const int hours = reader.two(0, 14);
  if (hours < 0 || !reader.accept(':')) return false;
  const int minutes = reader.two(0, 59);
  if (minutes < 0 || (hours == 14 && minutes > 0)) return false;
  zone = (west ? -1 : 1) * (hours * 60 + minutes);
  return reader.done();
}

std::optional<Decimal> seconds_of(const Clock& clock, int zone_minutes) {
  const std::int64_t whole = days_of(clock.year, clock.month, clock.day) * kDaySeconds +
                             clock.hour * kHourSeconds +
                             (clock.minute - zone_minutes) * kMinuteSeconds;
  return add(Decimal::of(whole), clock.second);
}

std::string second_text(const Decimal& second) {
  std::string text = to_string(second);
  const std::size_t whole = text.find('.') == std::string::npos ? text.size() : text.find('.');
  return whole < 2 ? "0" + text : text;
}

}  // namespace

std::optional<Instant> parse_instant(std::string_view text, Datatype type) {
  Reader reader(text);
  Clock clock;
  if (type == Datatype::kTime) {
    clock.year = 1972;
    clock.month = 12;
    clock.day = 31;
  } else if (!read_date(reader, clock)) {
    return std::nullopt;
  }
  if (type == Datatype::kDateTime && !reader.accept('T')) return std::nullopt;
  if (type != Datatype::kDate && !read_time(reader, clock)) return std::nullopt;
  if (type == Datatype::kTime && clock.hour == 24) clock.hour = 0;
  Instant result;
  if (!read_zone(reader, result.zone_minutes)) return std::nullopt;
  const auto seconds = seconds_of(clock, result.has_zone() ? result.zone_minutes : 0);
  if (!seconds) return std::nullopt;
  result.seconds = *seconds;
  return result;
}

Clock clock_of(const Instant& instant) {
  Clock clock;
  const Decimal whole = round(instant.seconds, Rounding::kFloor);
  const auto rest = subtract(instant.seconds, whole);
  // Years are bounded, so this fits.
  std::int64_t local = to_int64(whole).value_or(0);
  if (instant.has_zone()) local += instant.zone_minutes * kMinuteSeconds;
  std::int64_t days = local / kDaySeconds;
  std::int64_t second = local % kDaySeconds;
  if (second < 0) {
    second += kDaySeconds;
    --days;
  }
  set_day(clock, days);
  clock.hour = static_cast<int>(second / 3600);
  clock.minute = static_cast<int>(second / 60 % 60);
  clock.second = add(Decimal::of(second % 60), rest.value_or(Decimal{})).value_or(Decimal{});
  return clock;
}

std::string zone_text(const Instant& instant) {
  if (!instant.has_zone()) return {};
  if (instant.zone_minutes == 0) return "Z";
  const int minutes = instant.zone_minutes < 0 ? -instant.zone_minutes : instant.zone_minutes;
  return fmt::format("{}{:02}:{:02}", instant.zone_minutes < 0 ? '-' : '+', minutes / 60,
                     minutes % 60);
}

std::string to_string(const Instant& instant, Datatype type) {
  const Clock clock = clock_of(instant);
  std::string text;
  if (type != Datatype::kTime) {
    const std::int64_t year = clock.year < 0 ? -clock.year : clock.year;
    text =
        fmt::format("{}{:04}-{:02}-{:02}", clock.year < 0 ? "-" : "", year, clock.month, clock.day);
  }
  if (type == Datatype::kDateTime) text += 'T';
  if (type != Datatype::kDate) {
    text += fmt::format("{:02}:{:02}:{}", clock.hour, clock.minute, second_text(clock.second));
  }
  return text + zone_text(instant);
}

std::optional<Instant> add(const Instant& instant, const Duration& duration) {
  Instant result = instant;
  if (duration.months != 0) {
    Clock clock = clock_of(instant);
    const std::int64_t months = clock.year * 12 + (clock.month - 1) + duration.months;
    clock.year = (months >= 0 ? months : months - 11) / 12;
    clock.month = static_cast<int>(months - clock.year * 12) + 1;
    if (clock.year > kMostYears || clock.year < -kMostYears) return std::nullopt;
    clock.day = std::min(clock.day, days_in_month(clock.year, clock.month));
    const auto moved = seconds_of(clock, instant.has_zone() ? instant.zone_minutes : 0);
    if (!moved) return std::nullopt;
    result.seconds = *moved;
  }
  const auto sum = add(result.seconds, duration.seconds);
  // A year has at most 366 days.
  const Decimal most = Decimal::of(kMostYears * 366 * kDaySeconds);
  if (!sum || compare(*sum, most) > 0 || compare(*sum, negate(most)) < 0) return std::nullopt;
  result.seconds = *sum;
  return result;
}

TimeOrder compare(const Instant& a, const Instant& b) {
  const auto of = [](int order) {
    return order < 0 ? TimeOrder::kBefore : order > 0 ? TimeOrder::kAfter : TimeOrder::kSame;
  };
  if (a.has_zone() == b.has_zone()) return of(compare(a.seconds, b.seconds));
  const auto difference = subtract(a.seconds, b.seconds);
  const Decimal range = Decimal::of(14 * kHourSeconds);
  if (!difference) return of(compare(a.seconds, b.seconds));
  if (compare(*difference, range) > 0) return TimeOrder::kAfter;
  if (compare(*difference, negate(range)) < 0) return TimeOrder::kBefore;
  return TimeOrder::kUnknown;
}

}  // namespace sinew::rdf::sparql::values
