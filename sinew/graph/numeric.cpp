#include "sinew/graph/numeric.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace sinew::graph {
namespace {

struct Range {
  std::string_view name;
  NumericType type;
  // Bounds as decimal digits with sign; empty means unbounded.
  std::string_view lowest, highest;
};

constexpr std::array kTypes = {
    Range{"decimal", NumericType::kDecimal, "", ""},
    Range{"double", NumericType::kDouble, "", ""},
    Range{"float", NumericType::kFloat, "", ""},
    Range{"integer", NumericType::kInteger, "", ""},
    Range{"long", NumericType::kLong, "-9223372036854775808", "9223372036854775807"},
    Range{"int", NumericType::kInt, "-2147483648", "2147483647"},
    Range{"short", NumericType::kShort, "-32768", "32767"},
    Range{"byte", NumericType::kByte, "-128", "127"},
    Range{"nonNegativeInteger", NumericType::kNonNegativeInteger, "0", ""},
    Range{"positiveInteger", NumericType::kPositiveInteger, "1", ""},
    Range{"nonPositiveInteger", NumericType::kNonPositiveInteger, "", "0"},
    Range{"negativeInteger", NumericType::kNegativeInteger, "", "-1"},
    Range{"unsignedLong", NumericType::kUnsignedLong, "0", "18446744073709551615"},
    Range{"unsignedInt", NumericType::kUnsignedInt, "0", "4294967295"},
    Range{"unsignedShort", NumericType::kUnsignedShort, "0", "65535"},
    Range{"unsignedByte", NumericType::kUnsignedByte, "0", "255"},
};

const Range& range_of(NumericType type) { return kTypes[static_cast<std::size_t>(type) - 1]; }

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view skip_digits(std::string_view text) {
  while (!text.empty() && is_digit(text.front())) text.remove_prefix(1);
  return text;
}

bool take_sign(std::string_view& text) {
  const bool negative = !text.empty() && text.front() == '-';
  if (!text.empty() && (text.front() == '+' || text.front() == '-')) text.remove_prefix(1);
  return negative;
}

// An integer of any size: sign and digits without leading zeros ("" for zero).
struct Digits {
  bool negative;
  std::string_view digits;
};

std::optional<Digits> read_digits(std::string_view text) {
  const bool negative = take_sign(text);
  if (text.empty() || !skip_digits(text).empty()) return std::nullopt;
  while (!text.empty() && text.front() == '0') text.remove_prefix(1);
  return Digits{negative && !text.empty(), text};
}

bool less(const Digits& a, const Digits& b) {
  if (a.negative != b.negative) return a.negative;
  const Digits& small = a.negative ? b : a;
  const Digits& large = a.negative ? a : b;
  if (small.digits.size() != large.digits.size()) return small.digits.size() < large.digits.size();
  return small.digits < large.digits;
}

std::optional<Digits> read_integer(std::string_view lexical, NumericType type) {
  const auto value = read_digits(lexical);
  if (!value) return std::nullopt;
  const Range& range = range_of(type);
  if (!range.lowest.empty() && less(*value, *read_digits(range.lowest))) return std::nullopt;
  if (!range.highest.empty() && less(*read_digits(range.highest), *value)) return std::nullopt;
  return value;
}

// noDecimalPtNumeral | decimalPtNumeral, without the sign.
bool is_decimal(std::string_view text) {
  const std::string_view fraction = skip_digits(text);
  if (fraction.empty()) return !text.empty();
  if (fraction.front() != '.') return false;
  const bool any_digit = text.size() > 1;
  return any_digit && skip_digits(fraction.substr(1)).empty();
}

// The same with an optional exponent.
bool is_floating(std::string_view text) {
  const std::size_t exponent = text.find_first_of("eE");
  if (exponent == std::string_view::npos) return is_decimal(text);
  std::string_view power = text.substr(exponent + 1);
  take_sign(power);
  return is_decimal(text.substr(0, exponent)) && !power.empty() && skip_digits(power).empty();
}

// The power of ten of the first significant digit, roughly: positive for numbers of at least 1.
std::int64_t magnitude(std::string_view text) {
  const std::size_t split = text.find_first_of("eE");
  std::int64_t power = 0;
  if (split != std::string_view::npos) {
    std::string_view exponent = text.substr(split + 1);
    const bool negative = take_sign(exponent);
    // An exponent that does not fit outweighs any mantissa that does.
    if (std::from_chars(exponent.data(), exponent.data() + exponent.size(), power).ec !=
        std::errc()) {
      power = std::numeric_limits<std::int64_t>::max() / 2;
    }
    if (negative) power = -power;
  }
  std::string_view mantissa = text.substr(0, split);
  mantissa.remove_prefix(std::min(mantissa.find_first_not_of('0'), mantissa.size()));
  if (mantissa.starts_with('.')) {
    const std::size_t zeros = mantissa.substr(1).find_first_not_of('0');
    return power - static_cast<std::int64_t>(zeros);
  }
  return power + static_cast<std::int64_t>(std::min(mantissa.find('.'), mantissa.size()));
}

template <typename Real>
double read_real(std::string_view unsigned_text) {
  Real value = 0;
  const auto [end, error] =
      std::from_chars(unsigned_text.data(), unsigned_text.data() + unsigned_text.size(), value);
  if (error == std::errc::result_out_of_range) {
    // from_chars leaves the value alone; XML Schema rounds to infinity or to zero.
    return magnitude(unsigned_text) > 0 ? std::numeric_limits<double>::infinity() : 0.0;
  }
  return static_cast<double>(value);
}

}  // namespace

NumericType numeric_type(std::string_view local_name) {
  for (const Range& range : kTypes) {
    if (range.name == local_name) return range.type;
  }
  return NumericType::kNone;
}

std::optional<double> parse_number(std::string_view lexical, NumericType type) {
  if (type == NumericType::kNone) return std::nullopt;
  if (is_integer(type)) {
    const auto digits = read_integer(lexical, type);
    if (!digits) return std::nullopt;
    const double value = digits->digits.empty() ? 0.0 : read_real<double>(digits->digits);
    return digits->negative ? -value : value;
  }
  const bool floating = type != NumericType::kDecimal;
  if (floating && lexical == "NaN") return std::numeric_limits<double>::quiet_NaN();
  const bool negative = take_sign(lexical);
  double value = 0;
  if (floating && lexical == "INF") {
    value = std::numeric_limits<double>::infinity();
  } else if (floating ? is_floating(lexical) : is_decimal(lexical)) {
    value = type == NumericType::kFloat ? read_real<float>(lexical) : read_real<double>(lexical);
  } else {
    return std::nullopt;
  }
  return negative ? -value : value;
}

std::optional<std::int64_t> parse_integer(std::string_view lexical, NumericType type) {
  if (!is_integer(type)) return std::nullopt;
  const auto digits = read_integer(lexical, type);
  if (!digits || digits->digits.size() > 19) return std::nullopt;
  std::array<char, 20> text;
  std::size_t size = 0;
  if (digits->negative) text[size++] = '-';
  size += digits->digits.copy(text.data() + size, digits->digits.size());
  if (digits->digits.empty()) text[size++] = '0';
  std::int64_t value = 0;
  const auto result = std::from_chars(text.data(), text.data() + size, value);
  if (result.ec != std::errc()) return std::nullopt;
  return value;
}

std::string double_text(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "INF" : "-INF";
  std::array<char, 32> text;
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), result.ptr};
}

}  // namespace sinew::graph
