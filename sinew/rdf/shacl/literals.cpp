#include "sinew/rdf/shacl/literals.h"

#include <algorithm>
#include <string>

#include "sinew/graph/numeric.h"
#include "sinew/graph/standard_iris.h"
#include "sinew/rdf/shacl/vocabulary.h"
#include "sinew/rdf/sparql/values/date_time.h"
#include "sinew/rdf/sparql/values/operators.h"

namespace sinew::rdf::shacl {
namespace {

namespace values = sparql::values;
using values::Datatype;

bool is_boolean(std::string_view text) {
  return text == "true" || text == "false" || text == "1" || text == "0";
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

bool is_hex_binary(std::string_view text) {
  return text.size() % 2 == 0 && std::all_of(text.begin(), text.end(), [](char c) {
           return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
         });
}

// Groups of four characters, single spaces allowed between characters; one or two '=' at the end.
bool is_base64_binary(std::string_view text) {
  std::string packed;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != ' ') {
      packed += text[i];
    } else if (i == 0 || i + 1 == text.size() || text[i + 1] == ' ') {
      return false;
    }
  }
  if (packed.size() % 4 != 0) return false;
  std::size_t padding = 0;
  while (padding < 2 && padding < packed.size() && packed[packed.size() - 1 - padding] == '=') {
    ++padding;
  }
  const std::string_view digits = std::string_view(packed).substr(0, packed.size() - padding);
  if (!std::all_of(digits.begin(), digits.end(),
                   [](char c) { return is_letter(c) || is_digit(c) || c == '+' || c == '/'; })) {
    return false;
  }
  // The last digit before padding must not carry bits that are lost.
  if (padding == 1) return std::string_view("AEIMQUYcgkosw048").find(digits.back()) != digits.npos;
  if (padding == 2) return std::string_view("AQgw").find(digits.back()) != digits.npos;
  return true;
}

// [a-zA-Z]{1,8}(-[a-zA-Z0-9]{1,8})*
bool is_language(std::string_view text) {
  bool first = true;
  while (true) {
    const std::size_t end = std::min(text.find('-'), text.size());
    const std::string_view part = text.substr(0, end);
    const auto fits = [first](char c) { return is_letter(c) || (!first && is_digit(c)); };
    if (part.empty() || part.size() > 8 || !std::all_of(part.begin(), part.end(), fits)) {
      return false;
    }
    if (end == text.size()) return true;
    text.remove_prefix(end + 1);
    first = false;
  }
}

bool is_normalized(std::string_view text) {
  return text.find_first_of("\t\n\r") == std::string_view::npos;
}

bool is_token(std::string_view text) {
  return is_normalized(text) && !text.starts_with(' ') && !text.ends_with(' ') &&
         text.find("  ") == std::string_view::npos;
}

// Approximately: every character beyond ASCII counts as a letter of a name.
bool is_name(std::string_view text, bool any_start, bool colons) {
  const auto starts = [&](char c) {
    return is_letter(c) || c == '_' || (c & 0x80) != 0 || (c == ':' && colons);
  };
  const auto continues = [&](char c) { return starts(c) || is_digit(c) || c == '-' || c == '.'; };
  return !text.empty() && (any_start || starts(text[0])) &&
         std::all_of(text.begin(), text.end(), continues);
}

template <Datatype kType>
bool is_instant(std::string_view text) {
  return values::parse_instant(text, kType).has_value();
}
template <Datatype kType>
bool is_duration(std::string_view text) {
  return values::parse_duration(text, kType).has_value();
}

// Z, or + or - and hh:mm, at the end of the text.
std::string_view zone_of(std::string_view text) {
  if (text.ends_with('Z')) return text.substr(text.size() - 1);
  constexpr std::size_t kZoneSize = 6;
  if (text.size() <= kZoneSize || text[text.size() - 3] != ':') return {};
  return text.substr(text.size() - kZoneSize);
}

// The parts of a date (gYear and so on): completed to a whole date, in a leap year.
bool is_part_of_date(std::string_view text, std::string_view marks, std::string_view before,
                     std::string_view behind) {
  const std::string_view zone = zone_of(text);
  std::string_view part = text.substr(0, text.size() - zone.size());
  if (!part.starts_with(marks)) return false;
  part.remove_prefix(marks.size());
  // No further part may come along.
  const std::size_t dashes = static_cast<std::size_t>(
      std::count(part.begin() + (part.starts_with('-') ? 1 : 0), part.end(), '-'));
  const std::size_t whole = static_cast<std::size_t>(std::count(before.begin(), before.end(), '-') +
                                                     std::count(behind.begin(), behind.end(), '-'));
  if (dashes + whole != 2) return false;
  std::string date(before);
  date += part;
  date += behind;
  date += zone;
  return values::parse_instant(date, Datatype::kDate).has_value();
}

struct Row {
  std::string_view name;
  bool (*check)(std::string_view);
};
constexpr Row kRows[] = {
    {"boolean", is_boolean},
    {"dateTime", is_instant<Datatype::kDateTime>},
    {"dateTimeStamp",
     [](std::string_view text) {
       const auto instant = values::parse_instant(text, Datatype::kDateTime);
       return instant && instant->has_zone();
     }},
    {"date", is_instant<Datatype::kDate>},
    {"time", is_instant<Datatype::kTime>},
    {"gYear", [](std::string_view text) { return is_part_of_date(text, "", "", "-01-01"); }},
    {"gYearMonth", [](std::string_view text) { return is_part_of_date(text, "", "", "-01"); }},
    {"gMonth", [](std::string_view text) { return is_part_of_date(text, "--", "1972-", "-01"); }},
    {"gMonthDay", [](std::string_view text) { return is_part_of_date(text, "--", "1972-", ""); }},
    {"gDay", [](std::string_view text) { return is_part_of_date(text, "---", "1972-01-", ""); }},
    {"duration", is_duration<Datatype::kDuration>},
    {"yearMonthDuration", is_duration<Datatype::kYearMonthDuration>},
    {"dayTimeDuration", is_duration<Datatype::kDayTimeDuration>},
    {"hexBinary", is_hex_binary},
    {"base64Binary", is_base64_binary},
    {"language", is_language},
    {"normalizedString", is_normalized},
    {"token", is_token},
    {"Name", [](std::string_view text) { return is_name(text, false, true); }},
    {"NCName", [](std::string_view text) { return is_name(text, false, false); }},
    {"NMTOKEN", [](std::string_view text) { return is_name(text, true, true); }},
};

}  // namespace

bool is_well_formed(std::string_view lexical, std::string_view datatype) {
  if (!datatype.starts_with(graph::kXsd)) return true;
  const std::string_view name = datatype.substr(graph::kXsd.size());
  if (const auto type = graph::numeric_type(name); type != graph::NumericType::kNone) {
    return graph::parse_number(lexical, type).has_value();
  }
  const auto row = std::find_if(std::begin(kRows), std::end(kRows),
                                [&](const Row& each) { return each.name == name; });
  return row == std::end(kRows) || row->check(lexical);
}

std::partial_ordering compare_values(Id a, Id b, const values::TermSpace& space) {
  const values::Value first = values::value_of(a, space), second = values::value_of(b, space);
  if (!first.is_literal() || !second.is_literal()) return std::partial_ordering::unordered;
  using values::Truth;
  const Truth less = values::less(first, second);
  if (less == Truth::kError) return std::partial_ordering::unordered;
  if (less == Truth::kTrue) return std::partial_ordering::less;
  if (values::less(second, first) == Truth::kTrue) return std::partial_ordering::greater;
  return values::equals(first, second, space) == Truth::kTrue ? std::partial_ordering::equivalent
                                                              : std::partial_ordering::unordered;
}

}  // namespace sinew::rdf::shacl
