// Exact decimal numbers, for xsd:decimal and xsd:integer: up to 38 digits, of which up to 36 behind
// the point. What does not fit is an error of the expression (no value), never a rounded number.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sinew::rdf::sparql::values {

__extension__ typedef __int128 Int128;

struct Decimal {
  Int128 coefficient = 0;
  int scale = 0;  // value = coefficient / 10^scale

  static constexpr int kMaximumScale = 36;
  // Digits behind the point to which a quotient is rounded (half away from zero).
  static constexpr int kQuotientScale = 18;

  static Decimal of(std::int64_t value) { return {value, 0}; }
};

// Of the lexical form of xsd:decimal or xsd:integer; nothing when it is not one, or does not fit.
std::optional<Decimal> parse_decimal(std::string_view text);
// The shortest decimal that stands for this double, or nothing when it does not fit.
std::optional<Decimal> decimal_of(double value);
// Canonical form: no superfluous zeros, no point for whole numbers.
std::string to_string(const Decimal& value);
double to_double(const Decimal& value);

std::optional<Decimal> add(const Decimal& a, const Decimal& b);
std::optional<Decimal> subtract(const Decimal& a, const Decimal& b);
std::optional<Decimal> multiply(const Decimal& a, const Decimal& b);
std::optional<Decimal> divide(const Decimal& a, const Decimal& b);  // nothing for b = 0
Decimal negate(const Decimal& a);
int compare(const Decimal& a, const Decimal& b);  // < 0, 0, > 0

enum class Rounding { kFloor, kCeiling, kHalfUp };  // half up: towards plus infinity, as fn:round
Decimal round(const Decimal& a, Rounding rounding);
// Towards zero; nothing when it does not fit.
std::optional<std::int64_t> to_int64(const Decimal& a);

}  // namespace sinew::rdf::sparql::values
