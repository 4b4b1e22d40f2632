#include "sinew/rdf/sparql/values/numbers.h"

#include <array>
#include <charconv>
#include <cmath>

#include "sinew/rdf/sparql/values/xsd.h"

namespace sinew::rdf::sparql::values {
namespace {

struct Range {
  std::string_view name;
  bool has_lowest, has_highest;
  Int128 lowest, highest;
};

constexpr Int128 kTwo63 = Int128{1} << 63;
constexpr Range kRanges[] = {
    {"integer", false, false, 0, 0},
    {"int", true, true, -(Int128{1} << 31), (Int128{1} << 31) - 1},
    {"long", true, true, -kTwo63, kTwo63 - 1},
    {"short", true, true, -32768, 32767},
    {"byte", true, true, -128, 127},
    {"nonNegativeInteger", true, false, 0, 0},
    {"positiveInteger", true, false, 1, 0},
    {"nonPositiveInteger", false, true, 0, 0},
    {"negativeInteger", false, true, 0, -1},
    {"unsignedLong", true, true, 0, 2 * kTwo63 - 1},
    {"unsignedInt", true, true, 0, (Int128{1} << 32) - 1},
    {"unsignedShort", true, true, 0, 65535},
    {"unsignedByte", true, true, 0, 255},
};

// Mantissa and exponent of the shortest text that reads back to the same value.
template <typename Real>
struct Shortest {
  std::string digits;  // without point, without sign
  int exponent = 0;    // of the first digit
  bool negative = false;

  explicit Shortest(Real value) : negative(std::signbit(value)) {
    std::array<char, 64> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), std::fabs(value),
                                   std::chars_format::scientific);
    const std::string_view all(text.data(), static_cast<std::size_t>(end.ptr - text.data()));
    const std::size_t e = all.find('e');
    for (const char c : all.substr(0, e)) {
      if (c != '.') digits += c;
    }
    exponent = std::atoi(std::string(all.substr(e + 1)).c_str());
  }
};

template <typename Real>
std::string special_text(Real value) {
  if (std::isnan(value)) return "NaN";
  return value < 0 ? "-INF" : "INF";
}

template <typename Real>
std::string canonical(Real value) {
  if (!std::isfinite(value)) return special_text(value);
  const Shortest<Real> shortest(value);
  std::string result = shortest.negative ? "-" : "";
  result += shortest.digits[0];
  result += '.';
  result += shortest.digits.size() > 1 ? shortest.digits.substr(1) : "0";
  result += 'E';
  result += std::to_string(shortest.exponent);
  return result;
}

template <typename Real>
std::string as_string(Real value) {
  if (!std::isfinite(value)) return special_text(value);
  if (value == 0) return std::signbit(value) ? "-0" : "0";
  const Real magnitude = std::fabs(value);
  if (magnitude < Real(1e-6) || magnitude >= Real(1e6)) return canonical(value);
  const Shortest<Real> shortest(value);
  std::string digits = shortest.digits;
  std::string result = shortest.negative ? "-" : "";
  if (shortest.exponent < 0) {
    return result + "0." + std::string(static_cast<std::size_t>(-shortest.exponent - 1), '0') +
           digits;
  }
  const auto whole = static_cast<std::size_t>(shortest.exponent) + 1;
  while (digits.size() < whole) digits += '0';
  result += digits.substr(0, whole);
  if (digits.size() > whole) result += "." + digits.substr(whole);
  return result;
}

}  // namespace

std::optional<Decimal> parse_integer(std::string_view text, std::string_view datatype) {
  if (text.find('.') != std::string_view::npos) return std::nullopt;
  const auto value = parse_decimal(text);
  if (!value) return std::nullopt;
  const std::string_view name = datatype.substr(kXsd.size());
  for (const Range& range : kRanges) {
    if (range.name != name) continue;
    if (range.has_lowest && value->coefficient < range.lowest) return std::nullopt;
    if (range.has_highest && value->coefficient > range.highest) return std::nullopt;
    return value;
  }
  return std::nullopt;
}

std::optional<double> parse_double(std::string_view text) {
  if (text == "INF" || text == "+INF") return HUGE_VAL;
  if (text == "-INF") return -HUGE_VAL;
  if (text == "NaN") return std::nan("");
  // from_chars knows no '+', but "inf", "nan" and, with no fixed format, nothing else that we do
  // not.
  if (!text.empty() && text[0] == '+') text.remove_prefix(1);
  if (text.empty()) return std::nullopt;
  const std::size_t first = text[0] == '-' ? 1 : 0;
  if (first >= text.size() || !((text[first] >= '0' && text[first] <= '9') || text[first] == '.')) {
    return std::nullopt;
  }
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ptr != end) return std::nullopt;
  if (read.ec == std::errc::result_out_of_range) {
    // Too large is infinite, too small is zero; strtod tells which.
    return std::strtod(std::string(text).c_str(), nullptr);
  }
  if (read.ec != std::errc()) return std::nullopt;
  return value;
}

std::string double_text(double value) { return canonical(value); }
std::string float_text(float value) { return canonical(value); }
std::string double_as_string(double value) { return as_string(value); }
std::string float_as_string(float value) { return as_string(value); }

}  // namespace sinew::rdf::sparql::values
