// Any text as a number, a date, a duration and a regular expression; what is read and written must
// be read as the same value again.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "sinew/base/error.h"
#include "sinew/rdf/iri/characters.h"
#include "sinew/rdf/sparql/values/date_time.h"
#include "sinew/rdf/sparql/values/decimal.h"
#include "sinew/rdf/sparql/values/numbers.h"
#include "sinew/rdf/sparql/values/regex.h"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sinew::rdf::sparql::values;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const auto number = parse_decimal(text)) {
    const auto again = parse_decimal(to_string(*number));
    require(again && compare(*number, *again) == 0);
    if (const auto quotient = divide(*number, Decimal::of(7))) multiply(*quotient, *number);
    round(*number, Rounding::kHalfUp);
  }
  if (const auto number = parse_double(text); number && *number == *number) {
    require(parse_double(double_text(*number)) == number);
    require(parse_double(double_as_string(*number)) == number);
  }
  for (const Datatype type : {Datatype::kDateTime, Datatype::kDate, Datatype::kTime}) {
    const auto instant = parse_instant(text, type);
    if (!instant) continue;
    const auto again = parse_instant(to_string(*instant, type), type);
    require(again && compare(*instant, *again) == TimeOrder::kSame);
    if (const auto moved = add(*instant, {14, Decimal::of(86'399)})) to_string(*moved, type);
  }
  for (const Datatype type :
       {Datatype::kDuration, Datatype::kDayTimeDuration, Datatype::kYearMonthDuration}) {
    const auto duration = parse_duration(text, type);
    if (!duration) continue;
    const auto again = parse_duration(to_string(*duration, type), type);
    require(again && compare(*duration, *again) == TimeOrder::kSame);
  }
  // The first byte says where the pattern ends and the text begins.
  if (size > 1 && sinew::rdf::first_invalid_utf8(text) == std::string_view::npos) {
    const std::size_t cut = 1 + static_cast<unsigned char>(text[0]) % (size - 1);
    if ((text[cut] & 0xC0) != 0x80) {
      try {
        const auto regex = Regex::compile(text.substr(1, cut - 1), "");
        if (regex) {
          regex->search(text.substr(cut));
          regex->replace(text.substr(cut), "$0$1");
        }
      } catch (const sinew::Error&) {  // an answer too
      }
    }
  }
  return 0;
}
