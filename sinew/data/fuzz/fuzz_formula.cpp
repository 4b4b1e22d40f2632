// Formulas, units and tables of units: any text is read or refused with an Error. The first line
// says which of the three the rest is.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "sinew/base/error.h"
#include "sinew/data/formula.h"
#include "sinew/data/units.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace sinew;
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  const std::string_view kind = text.substr(0, text.find('\n'));
  const std::string_view rest = text.substr(std::min(size, kind.size() + 1));
  try {
    if (kind == "unit") {
      data::UnitTable::shipped().find(rest);
      data::UnitTable::shipped().suggestions(rest);
    } else if (kind == "table") {
      data::UnitTable::read(rest, "fuzz.json");
    } else {
      const data::FormulaParameter inputs[] = {{"x", data::find_unit("m")->dimension}, {"y", {}}};
      const data::FormulaParameter outputs[] = {{"z", {}}};
      data::parse_formula(rest, {"fuzz.blocks", 1, 1}, inputs, outputs);
    }
  } catch (const Error&) {  // an answer too
  }
  return 0;
}
