// Units of measurement by their QUDT names, symbols or products of these, from the table
// metamodels/units.json.
//
//   find_unit("MilliM")  find_unit("mm")                a row of the table, with a prefix where it
//   takes one find_unit("M-PER-SEC2")  find_unit("N-M")           QUDT's own way to write products
//   find_unit("rad/s")  find_unit("kg*m^2/s^2")         products of symbols; a middle dot is a
//   product too
//
// Only a unit that stands alone may have an offset: "degree Celsius per metre" has none that means
// anything.
#pragma once

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

// The largest exponent that a unit in a product may have; that of the product is kMaximumExponent.
constexpr int kMaximumUnitExponent = 12;

class UnitTable {
 public:
  // Reads a table in the form of metamodels/units.json; `file` names it in errors. Throws Error.
  static UnitTable read(std::string_view json, const std::string& file);
  // The table that Sinew ships.
  static const UnitTable& shipped();

  // The unit, or nothing and (where asked for) the reason.
  std::optional<Unit> find(std::string_view text, UnitProblem* problem = nullptr) const;
  // Unit names close to a misspelt one, the closest first; at most three.
  std::vector<std::string> suggestions(std::string_view text) const;

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
  std::optional<Unit> find_single(std::string_view text) const;
  std::optional<Unit> find_qudt_product(std::string_view text) const;
  std::optional<Unit> find_symbol_product(std::string_view text) const;

  std::vector<Prefix> prefixes_;
  std::vector<Row> rows_;
};

// The coherent SI unit of a dimension by its QUDT name: "M-PER-SEC", "N-M". Of units with the same
// dimension it is the one of mechanics: N-M, not J.
std::string coherent_unit(const Dimension& dimension);

// From the shipped table.
std::optional<Unit> find_unit(std::string_view text);

// Nothing when the dimensions differ.
std::optional<UnitConversion> conversion(const Unit& from, const Unit& to);

}  // namespace sinew::data
