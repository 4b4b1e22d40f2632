// Units of measurement by their QUDT names, symbols or products of these, from the table
// metamodels/units.json.
//
//   find_unit("MilliM")  find_unit("mm")                a row of the table, with a prefix where it
//   takes one find_unit("M-PER-SEC2")  find_unit("N-M")           QUDT's own way to write products
//   find_unit("rad/s")  find_unit("kg*m^2/s^2")         products of symbols; a middle dot is a
//   product too; names and symbols are not mixed in one: M/S would be metres a siemens
//
// Only a unit that stands alone may have an offset: "degree Celsius per metre" has none that means
// anything.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/data/dimension.h"

namespace sinew::data {

// value in coherent SI units (metre, kilogram, second, ampere, kelvin, mole, candela, radian)
//   = scale * value in this unit + offset
struct Unit {
  std::string name;  // as it was asked for
  Dimension dimension;
  double scale = 1;
  double offset = 0;
};

// The way from one unit to another: result = scale * value + offset.
struct UnitConversion {
  double scale = 1;
  double offset = 0;
  bool identity() const { return scale == 1 && offset == 0; }
};

// Why a text names no unit: what is wrong and what would be right.
struct UnitProblem {
  std::string what;
  std::string remedy;
};

// How the place in which a unit stands spells it: suggestions for one that is misspelt are spelt
// so.
enum class UnitSpelling : std::uint8_t {
  kEither,  // a QUDT name or symbols
  kQudt,    // a QUDT name: the end of a unit's IRI
};

// The largest exponent that a unit in a product may have; that of the product is kMaximumExponent.
constexpr int kMaximumUnitExponent = 12;

class UnitTable {
 public:
  // Reads a table in the form of metamodels/units.json; `file` names it in errors. Throws Error.
  static UnitTable read(std::string_view json, const std::string& file);
  // The table that Sinew ships.
  static const UnitTable& shipped();

  // The unit, or nothing and (where asked for) the reason.
  std::optional<Unit> find(std::string_view text, UnitProblem* problem = nullptr,
                           UnitSpelling spelling = UnitSpelling::kEither) const;
  // Units that a misspelt one may mean, the likeliest first; at most three: what people write in
  // its place ("Nm"), what differs in case alone ("Kg"), what is close (base/spelling.h), and a
  // product of which each factor is one of these.
  std::vector<std::string> suggestions(std::string_view text,
                                       UnitSpelling spelling = UnitSpelling::kEither) const;

 private:
  struct Prefix {
    std::string name, symbol;
    double scale;
  };
  struct Row {
    std::string name;                  // QUDT local name
    std::vector<std::string> symbols;  // the first is the preferred one
    Dimension dimension;
    double scale = 1, offset = 0;
    bool takes_prefix = false;
  };
  enum class Words : std::uint8_t { kNames, kSymbols, kBoth };
  std::optional<Unit> find_single(std::string_view text, Words words = Words::kBoth) const;
  std::optional<Unit> find_qudt_product(std::string_view text) const;
  std::optional<Unit> find_symbol_product(std::string_view text) const;

  std::vector<std::string> close_units(std::string_view text) const;
  std::string corrected_product(std::string_view text) const;
  std::string qudt_name(const std::string& unit) const;

  struct Spellings {
    std::string symbols, name;  // "N*m", "N-M"
  };
  struct Synonym {
    std::string text, means;
  };
  std::vector<Prefix> prefixes_;
  std::vector<Row> rows_;
  std::vector<Spellings> usual_;  // beside the rows
  std::vector<Synonym> synonyms_;
};

// The coherent SI unit of a dimension by its QUDT name: "M-PER-SEC", "N-M". Of units with the same
// dimension it is the one of mechanics: N-M, not J.
std::string coherent_unit(const Dimension& dimension);

// From the shipped table.
std::optional<Unit> find_unit(std::string_view text);

// Nothing when the dimensions differ.
std::optional<UnitConversion> conversion(const Unit& from, const Unit& to);

}  // namespace sinew::data
