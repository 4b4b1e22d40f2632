// Physical dimensions: the exponents of the base quantities. Two values can be converted into each
// other only where their dimensions are equal.
//
// Plane angle counts as a base quantity of its own, unlike in the SI: a radian is not a metre per
// metre here, and hertz is not radian per second. That catches the factors of 2 pi that software
// gets wrong.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sinew::data {

enum class BaseQuantity : std::uint8_t {
  kLength,
  kMass,
  kTime,
  kCurrent,
  kTemperature,
  kAmount,
  kLuminousIntensity,
  kAngle,
};
constexpr std::size_t kBaseQuantities = 8;

// The largest exponent of a base quantity in a unit or a formula.
constexpr int kMaximumExponent = 24;

struct Dimension {
  std::array<int, kBaseQuantities> exponents = {};

  bool dimensionless() const { return *this == Dimension{}; }
  friend bool operator==(const Dimension&, const Dimension&) = default;
};

Dimension operator*(const Dimension& a, const Dimension& b);
Dimension operator/(const Dimension& a, const Dimension& b);
Dimension power(const Dimension& a, int exponent);

// "length mass time^-2"; "dimensionless". The reader takes the writer's form and nothing else, with
// exponents up to the largest.
std::string to_string(const Dimension& dimension);
std::optional<Dimension> parse_dimension(std::string_view text);

}  // namespace sinew::data
