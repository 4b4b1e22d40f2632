#include "sinew/data/dimension.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>

namespace sinew::data {
namespace {

constexpr std::array<std::string_view, kBaseQuantities> kNames = {
    "length", "mass", "time", "current", "temperature", "amount", "luminous-intensity", "angle"};

std::optional<std::size_t> base_quantity(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) return i;
  }
  return std::nullopt;
}

}  // namespace

Dimension operator*(const Dimension& a, const Dimension& b) {
  Dimension product = a;
  for (std::size_t i = 0; i < kBaseQuantities; ++i) product.exponents[i] += b.exponents[i];
  return product;
}

Dimension operator/(const Dimension& a, const Dimension& b) { return a * power(b, -1); }

Dimension power(const Dimension& a, int exponent) {
  Dimension result = a;
  for (int& value : result.exponents) value *= exponent;
  return result;
}

std::string to_string(const Dimension& dimension) {
  std::string text;
  for (std::size_t i = 0; i < kBaseQuantities; ++i) {
    const int exponent = dimension.exponents[i];
    if (exponent == 0) continue;
    if (!text.empty()) text += ' ';
    text += kNames[i];
    if (exponent != 1) text += "^" + std::to_string(exponent);
  }
  return text.empty() ? "dimensionless" : text;
}

std::optional<Dimension> parse_dimension(std::string_view text) {
  Dimension dimension;
  if (text == "dimensionless") return dimension;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    const std::size_t caret = word.find('^');
    const auto index = base_quantity(word.substr(0, caret));
    if (!index) return std::nullopt;
    int exponent = 1;
    if (caret != std::string_view::npos) {
      const std::string_view digits = word.substr(caret + 1);
      const auto [end, status] =
          std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
      if (status != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
      if (std::abs(exponent) > kMaximumExponent) return std::nullopt;
    }
    int& sum = dimension.exponents[*index];
    sum += exponent;
    if (std::abs(sum) > kMaximumExponent) return std::nullopt;
  }
  return dimension;
}

}  // namespace sinew::data
