#include "sinew/data/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "sinew/base/error.h"
#include "sinew/data/embedded.h"

namespace sinew::data {
namespace {

[[noreturn]] void fail(const std::string& file, const std::string& what,
                       const std::string& remedy) {
  throw Error(Problem{{file, 0, 0}, {}, what, remedy, Severity::kError, {}});
}

// Nothing where an exponent of the product is too large for a unit.
std::optional<Unit> product_of(const Unit& a, const Unit& b, int exponent) {
  Unit result = a;
  result.dimension = a.dimension * power(b.dimension, exponent);
  for (const int of_base : result.dimension.exponents)
    if (std::abs(of_base) > kMaximumExponent) return std::nullopt;
  for (int i = 0; i < std::abs(exponent); ++i) {
    result.scale = exponent > 0 ? result.scale * b.scale : result.scale / b.scale;
  }
  return result;
}

// The digits at the end of "SEC2": 2, and takes them off; 1 when there are none, 0 when too large.
int take_trailing_exponent(std::string_view& text) {
  std::size_t digits = 0;
  while (digits < text.size() && text[text.size() - 1 - digits] >= '0' &&
         text[text.size() - 1 - digits] <= '9') {
    ++digits;
  }
  if (digits == 0 || digits == text.size()) return 1;
  if (digits > 2) return 0;
  const int exponent = std::stoi(std::string(text.substr(text.size() - digits)));
  text.remove_suffix(digits);
  return exponent <= kMaximumUnitExponent ? exponent : 0;
}

}  // namespace

UnitTable UnitTable::read(std::string_view text, const std::string& file) {
  UnitTable table;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded()) fail(file, "the unit table is no JSON", "see metamodels/units.json");
  try {
    for (const auto& entry : json.at("prefixes")) {
      table.prefixes_.push_back({entry.at("name"), entry.at("symbol"), entry.at("scale")});
    }
    for (const auto& entry : json.at("units")) {
      Row row;
      row.name = entry.at("name");
      row.symbols = entry.at("symbols").get<std::vector<std::string>>();
      const std::string dimension = entry.at("dimension");
      const auto parsed = parse_dimension(dimension);
      if (!parsed) {
        fail(file, fmt::format("unit {}: '{}' is no dimension", row.name, dimension),
             "write base quantities with exponents, as in \"length time^-2\"");
      }
      row.dimension = *parsed;
      row.scale = entry.at("scale");
      row.offset = entry.value("offset", 0.0);
      row.takes_prefix = entry.value("prefixes", false);
      if (!(row.scale > 0)) fail(file, "unit " + row.name + " has no positive scale", "");
      table.rows_.push_back(std::move(row));
    }
    for (const auto& entry : json.value("usual", nlohmann::json::array()))
      table.usual_.push_back({entry.at("symbols"), entry.at("name")});
    for (const auto& entry : json.value("synonyms", nlohmann::json::array()))
      table.synonyms_.push_back({entry.at("text"), entry.at("means")});
  } catch (const nlohmann::json::exception& error) {
    fail(file, fmt::format("the unit table lacks an entry: {}", error.what()),
         "see metamodels/units.json");
  }
  return table;
}

const UnitTable& UnitTable::shipped() {
  static const UnitTable table = read(embedded_file("units.json"), "metamodels/units.json");
  return table;
}

std::optional<Unit> UnitTable::find_single(std::string_view text, Words words) const {
  const auto unit = [&](const Row& row, double scale) {
    return Unit{std::string(text), row.dimension, row.scale * scale, scale == 1 ? row.offset : 0};
  };
  const auto named = [&](const Row& row, std::string_view name) {
    return (words != Words::kSymbols && row.name == name) ||
           (words != Words::kNames &&
            std::find(row.symbols.begin(), row.symbols.end(), name) != row.symbols.end());
  };
  for (const Row& row : rows_) {
    if (named(row, text)) return unit(row, 1);
  }
  for (const Prefix& prefix : prefixes_) {
    for (const Row& row : rows_) {
      if (!row.takes_prefix) continue;
      if (words != Words::kSymbols && text.starts_with(prefix.name) &&
          text.substr(prefix.name.size()) == row.name) {
        return unit(row, prefix.scale);
      }
      if (words != Words::kNames && text.starts_with(prefix.symbol)) {
        const std::string_view rest = text.substr(prefix.symbol.size());
        for (const std::string& symbol : row.symbols) {
          if (rest == symbol) return unit(row, prefix.scale);
        }
      }
    }
  }
  return std::nullopt;
}

// KiloGM-M2-PER-SEC2: factors joined by '-', digits are exponents, all after PER divide.
std::optional<Unit> UnitTable::find_qudt_product(std::string_view text) const {
  if (text.find('-') == std::string_view::npos && !text.starts_with("PER-")) {
    std::string_view single = text;
    const int exponent = take_trailing_exponent(single);
    if (exponent < 2 || single == text) return std::nullopt;
    const auto factor = find_single(single);
    if (!factor || factor->offset != 0) return std::nullopt;
    return product_of(Unit{std::string(text), {}, 1, 0}, *factor, exponent);
  }
  Unit result{std::string(text), {}, 1, 0};
  int sign = 1;
  for (std::string_view rest = text; !rest.empty();) {
    std::string_view word = rest.substr(0, rest.find('-'));
    rest.remove_prefix(std::min(rest.size(), word.size() + 1));
    if (word == "PER") {
      if (sign < 0 || rest.empty()) return std::nullopt;
      sign = -1;
      continue;
    }
    const int exponent = take_trailing_exponent(word);
    const auto factor = find_single(word);
    if (!factor || factor->offset != 0 || exponent == 0) return std::nullopt;
    auto product = product_of(result, *factor, sign * exponent);
    if (!product) return std::nullopt;
    result = *std::move(product);
  }
  return result;
}

// kg*m^2/s^2: factors joined by '*', the middle dot or a space; every '/' divides by the next
// factor.
std::optional<Unit> UnitTable::find_symbol_product(std::string_view text) const {
  constexpr std::string_view kMiddleDot = "\xC2\xB7";
  Unit result{std::string(text), {}, 1, 0};
  int sign = 1;
  while (true) {
    std::size_t end = 0;
    while (end < text.size() && text[end] != '*' && text[end] != '/' && text[end] != ' ' &&
           !text.substr(end).starts_with(kMiddleDot)) {
      ++end;
    }
    std::string_view word = text.substr(0, end);
    text.remove_prefix(end);
    int exponent = 1;
    if (const std::size_t caret = word.find('^'); caret != std::string_view::npos) {
      const std::string digits(word.substr(caret + 1));
      const bool negative = digits.starts_with('-');
      if (digits.size() <= std::size_t(negative) || digits.size() > 3 ||
          digits.find_first_not_of("0123456789", negative) != std::string::npos) {
        return std::nullopt;
      }
      exponent = std::stoi(digits);
      if (std::abs(exponent) > kMaximumUnitExponent) return std::nullopt;
      word = word.substr(0, caret);
    }
    const auto factor = find_single(word, Words::kSymbols);
    if (!factor || factor->offset != 0) return std::nullopt;
    auto product = product_of(result, *factor, sign * exponent);
    if (!product) return std::nullopt;
    result = *std::move(product);
    if (text.empty()) return result;
    sign = text[0] == '/' ? -1 : 1;
    text.remove_prefix(text.starts_with(kMiddleDot) ? kMiddleDot.size() : 1);
  }
}

std::optional<Unit> UnitTable::find(std::string_view text, UnitProblem* problem,
                                    UnitSpelling spelling) const {
  if (auto unit = find_single(text)) return unit;
  if (auto unit = find_qudt_product(text)) return unit;
  if (auto unit = find_symbol_product(text)) return unit;
  if (problem) {
    problem->what = fmt::format("'{}' is no unit of the QUDT table", text);
    const auto close = suggestions(text, spelling);
    problem->remedy = !close.empty() ? fmt::format("did you mean {}?", fmt::join(close, " or "))
                      : spelling == UnitSpelling::kQudt
                          ? "use a QUDT name (MilliM, M-PER-SEC)"
                          : "use a QUDT name (MilliM, M-PER-SEC) or symbols (mm, m/s)";
  }
  return std::nullopt;
}

std::string coherent_unit(const Dimension& dimension) {
  // Usual names of products with force and torque; all others are written in base units.
  constexpr std::string_view kUsual[] = {
      "UNITLESS",       "N",       "N-M",         "N-PER-M",         "N-M-PER-RAD", "N-SEC",
      "N-SEC-PER-M",    "N-M-SEC", "N-PER-M-SEC", "N-M-SEC-PER-RAD", "N-PER-SEC",   "N-M-PER-SEC",
      "N-M-PER-RAD-SEC"};
  for (const std::string_view name : kUsual)
    if (find_unit(name)->dimension == dimension) return std::string(name);
  constexpr std::array<std::string_view, kBaseQuantities> kBase = {"M", "KiloGM", "SEC", "A",
                                                                   "K", "MOL",    "CD",  "RAD"};
  constexpr std::array<std::size_t, kBaseQuantities> kOrder = {7, 1, 0, 2, 3, 4, 5, 6};
  std::string above, below;
  for (const std::size_t i : kOrder) {
    const int exponent = dimension.exponents[i];
    if (exponent == 0) continue;
    std::string& side = exponent > 0 ? above : below;
    if (!side.empty()) side += '-';
    side += kBase[i];
    if (exponent > 1 || exponent < -1) side += std::to_string(exponent < 0 ? -exponent : exponent);
  }
  return below.empty() ? above : above.empty() ? "PER-" + below : above + "-PER-" + below;
}

std::optional<Unit> find_unit(std::string_view text) { return UnitTable::shipped().find(text); }

std::optional<UnitConversion> conversion(const Unit& from, const Unit& to) {
  if (from.dimension != to.dimension) return std::nullopt;
  return UnitConversion{from.scale / to.scale, (from.offset - to.offset) / to.scale};
}

}  // namespace sinew::data
