// What a misspelt unit may have been meant to be.
#include <algorithm>
#include <cctype>

#include "sinew/base/spelling.h"
#include "sinew/data/units.h"

namespace sinew::data {
namespace {

bool same_but_for_case(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

bool is_in_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || (c & 0x80) != 0;
}

}  // namespace

std::vector<std::string> UnitTable::close_units(std::string_view text) const {
  std::vector<std::string> common, by_case;
  for (const Row& row : rows_) {
    common.push_back(row.name);
    common.insert(common.end(), row.symbols.begin(), row.symbols.end());
    if (!row.takes_prefix) continue;
    for (const Prefix& prefix : prefixes_) {
      by_case.push_back(prefix.name + row.name);
      for (const std::string& symbol : row.symbols) by_case.push_back(prefix.symbol + symbol);
    }
  }
  for (const Spellings& usual : usual_) common.insert(common.end(), {usual.symbols, usual.name});
  // A unit with one of the eighteen prefixes is close to anything short.
  std::erase_if(by_case, [&](const std::string& unit) { return !same_but_for_case(unit, text); });
  common.insert(common.end(), by_case.begin(), by_case.end());
  return close_spellings(text, common);
}

std::string UnitTable::corrected_product(std::string_view text) const {
  std::string corrected;
  while (!text.empty()) {
    const auto word_end =
        static_cast<std::size_t>(std::ranges::find_if_not(text, is_in_word) - text.begin());
    std::string_view word = text.substr(0, word_end);
    if (word.empty()) {  // what joins factors
      corrected += text.front();
      text.remove_prefix(1);
      continue;
    }
    text.remove_prefix(word_end);
    const std::size_t exponent = word.find_last_not_of("0123456789") + 1;
    const std::string_view unit = word.substr(0, exponent);
    const auto close = unit.empty() || unit == "PER" || find_single(unit)
                           ? std::vector<std::string>{std::string(unit)}
                           : close_units(unit);
    if (close.empty()) return {};
    corrected.append(close.front()).append(word.substr(exponent));
  }
  return find_qudt_product(corrected) || find_symbol_product(corrected) ? corrected : "";
}

std::string UnitTable::qudt_name(const std::string& unit) const {
  for (const Row& row : rows_) {
    if (std::ranges::find(row.symbols, unit) != row.symbols.end()) return row.name;
    if (!row.takes_prefix) continue;
    for (const Prefix& prefix : prefixes_)
      for (const std::string& symbol : row.symbols)
        if (prefix.symbol + symbol == unit) return prefix.name + row.name;
  }
  const auto usual = std::ranges::find(usual_, unit, &Spellings::symbols);
  return usual == usual_.end() ? unit : usual->name;
}

std::vector<std::string> UnitTable::suggestions(std::string_view text,
                                                UnitSpelling spelling) const {
  std::vector<std::string> units;
  for (const Synonym& synonym : synonyms_)
    if (same_but_for_case(synonym.text, text)) units.push_back(synonym.means);
  const bool is_known = !units.empty();
  for (std::string& close : close_units(text))
    if (!is_known || same_but_for_case(close, text)) units.push_back(std::move(close));
  if (units.empty())
    if (std::string product = corrected_product(text); !product.empty())
      units.push_back(std::move(product));
  std::vector<std::string> result;
  for (const std::string& unit : units) {
    std::string spelt = spelling == UnitSpelling::kQudt ? qudt_name(unit) : unit;
    constexpr std::size_t kMost = 3;
    if (result.size() < kMost && std::ranges::find(result, spelt) == result.end())
      result.push_back(std::move(spelt));
  }
  return result;
}

}  // namespace sinew::data
