#include "sinew/rdf/sparql/values/decimal.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace sinew::rdf::sparql::values {
namespace {

// 10^38 is the largest power of ten in 127 bits.
constexpr int kMaximumDigits = 38;

constexpr Int128 power_of_ten(int exponent) {
  Int128 result = 1;
  for (int i = 0; i < exponent; ++i) result *= 10;
  return result;
}

std::optional<Int128> times(Int128 a, Int128 b) {
  Int128 result;
  if (__builtin_mul_overflow(a, b, &result)) return std::nullopt;
  return result;
}

// The same value with a larger scale.
std::optional<Int128> scaled(const Decimal& a, int scale) {
  if (scale - a.scale > kMaximumDigits)
    return a.coefficient == 0 ? std::optional<Int128>(0) : std::nullopt;
  return times(a.coefficient, power_of_ten(scale - a.scale));
}

Decimal without_trailing_zeros(Decimal a) {
  while (a.scale > 0 && a.coefficient % 10 == 0) {
    a.coefficient /= 10;
    --a.scale;
  }
  return a;
}

std::optional<Decimal> checked(Decimal a) {
  a = without_trailing_zeros(a);
  if (a.scale > Decimal::kMaximumScale) return std::nullopt;
  return a;
}

int sign(Int128 value) { return value < 0 ? -1 : value > 0 ? 1 : 0; }

}  // namespace

std::optional<Decimal> parse_decimal(std::string_view text) {
  bool negative = false;
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) {
    negative = text[0] == '-';
    text.remove_prefix(1);
  }
  Decimal result;
  bool digits = false;
  bool point = false;
  int pending_zeros = 0;  // behind the point, not yet part of the coefficient
  for (const char c : text) {
    if (c == '.') {
      if (point) return std::nullopt;
      point = true;
      continue;
    }
    if (c < '0' || c > '9') return std::nullopt;
    digits = true;
    if (point && c == '0') {
      ++pending_zeros;
      continue;
    }
    const int shift = point ? pending_zeros + 1 : 1;
    if (shift > kMaximumDigits) return std::nullopt;
    const auto moved = times(result.coefficient, power_of_ten(shift));
    if (!moved ||
        __builtin_add_overflow(*moved, static_cast<Int128>(c - '0'), &result.coefficient)) {
      return std::nullopt;
    }
    if (point) result.scale += shift;
    pending_zeros = 0;
  }
  if (!digits || result.scale > Decimal::kMaximumScale) return std::nullopt;
  if (negative) result.coefficient = -result.coefficient;
  return result;
}

std::optional<Decimal> decimal_of(double value) {
  if (!std::isfinite(value) || std::fabs(value) >= 1.0e38) return std::nullopt;
  // The shortest decimal that reads back to the same double; tiny ones have too many digits.
  std::array<char, 400> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  return parse_decimal({text.data(), static_cast<std::size_t>(end.ptr - text.data())});
}

std::string to_string(const Decimal& value) {
  const Decimal a = without_trailing_zeros(value);
  std::string digits;
  // Work on negative numbers: they reach one further.
  Int128 rest = a.coefficient > 0 ? -a.coefficient : a.coefficient;
  do {
    digits += static_cast<char>('0' - static_cast<int>(rest % 10));
    rest /= 10;
  } while (rest != 0);
  while (digits.size() <= static_cast<std::size_t>(a.scale)) digits += '0';
  std::reverse(digits.begin(), digits.end());
  if (a.scale > 0) digits.insert(digits.size() - static_cast<std::size_t>(a.scale), ".");
  if (a.coefficient < 0) digits.insert(digits.begin(), '-');
  return digits;
}

double to_double(const Decimal& value) {
  const Decimal a = without_trailing_zeros(value);
  if (a.scale == 0) return static_cast<double>(a.coefficient);
  return std::strtod(to_string(a).c_str(), nullptr);
}

std::optional<Decimal> add(const Decimal& a, const Decimal& b) {
  Decimal result;
  result.scale = std::max(a.scale, b.scale);
  const auto left = scaled(a, result.scale);
  const auto right = scaled(b, result.scale);
  if (!left || !right || __builtin_add_overflow(*left, *right, &result.coefficient)) {
    return std::nullopt;
  }
  return checked(result);
}

std::optional<Decimal> subtract(const Decimal& a, const Decimal& b) { return add(a, negate(b)); }

std::optional<Decimal> multiply(const Decimal& left, const Decimal& right) {
  const Decimal a = without_trailing_zeros(left);
  const Decimal b = without_trailing_zeros(right);
  const auto product = times(a.coefficient, b.coefficient);
  if (!product) return std::nullopt;
  return checked({*product, a.scale + b.scale});
}

std::optional<Decimal> divide(const Decimal& left, const Decimal& right) {
  const Decimal a = without_trailing_zeros(left);
  const Decimal b = without_trailing_zeros(right);
  if (b.coefficient == 0) return std::nullopt;
  // a/10^s / (b/10^t) = (a * 10^(q + t - s) / b) / 10^q, with one digit more to round by.
  for (int scale = Decimal::kQuotientScale; scale >= 0; --scale) {
    const int shift = scale + 1 + b.scale - a.scale;
    std::optional<Int128> dividend = a.coefficient;
    Int128 divisor = b.coefficient;
    if (shift >= 0) {
      dividend = shift > kMaximumDigits ? std::nullopt : times(a.coefficient, power_of_ten(shift));
    } else {
      const auto larger = times(b.coefficient, power_of_ten(-shift));
      if (!larger) continue;
      divisor = *larger;
    }
    if (!dividend) continue;
    Int128 quotient = *dividend / divisor;
    const int last = static_cast<int>(quotient % 10);
    quotient /= 10;
    if (last >= 5) ++quotient;
    if (last <= -5) --quotient;
    return checked({quotient, scale});
  }
  // No room for a digit to round by: only what divides without remainder.
  if (a.scale < b.scale || a.coefficient % b.coefficient != 0) return std::nullopt;
  return checked({a.coefficient / b.coefficient, a.scale - b.scale});
}

Decimal negate(const Decimal& a) {
  // The most negative number has no positive counterpart, but no operation here yields it: it has
  // 39 digits' worth of bits only by one, and parse and arithmetic check for overflow.
  if (a.coefficient == std::numeric_limits<Int128>::min()) return {-(a.coefficient + 1), a.scale};
  return {-a.coefficient, a.scale};
}

int compare(const Decimal& a, const Decimal& b) {
  const int sign_a = sign(a.coefficient);
  const int sign_b = sign(b.coefficient);
  if (sign_a != sign_b) return sign_a < sign_b ? -1 : 1;
  const int scale = std::max(a.scale, b.scale);
  const auto left = scaled(a, scale);
  const auto right = scaled(b, scale);
  // What does not fit is larger in magnitude than what does.
  if (!left) return sign_a;
  if (!right) return -sign_b;
  return *left < *right ? -1 : *left > *right ? 1 : 0;
}

Decimal round(const Decimal& value, Rounding rounding) {
  const Decimal a = without_trailing_zeros(value);
  if (a.scale == 0) return a;
  const Int128 unit = power_of_ten(a.scale);
  Int128 whole = a.coefficient / unit;  // towards zero
  Int128 rest = a.coefficient % unit;
  if (rest < 0) {  // now towards minus infinity
    --whole;
    rest += unit;
  }
  if (rounding == Rounding::kCeiling && rest > 0) ++whole;
  if (rounding == Rounding::kHalfUp && rest >= unit - rest) ++whole;
  return {whole, 0};
}

std::optional<std::int64_t> to_int64(const Decimal& a) {
  const Int128 whole = a.scale == 0 ? a.coefficient : a.coefficient / power_of_ten(a.scale);
  if (whole < std::numeric_limits<std::int64_t>::min() ||
      whole > std::numeric_limits<std::int64_t>::max()) {
    return std::nullopt;
  }
  return static_cast<std::int64_t>(whole);
}

}  // namespace sinew::rdf::sparql::values
