#include "sinew/rdf/shacl/literals.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "sinew/graph/numeric.h"
#include "sinew/rdf/shacl/date_time.h"
#include "sinew/rdf/shacl/vocabulary.h"

namespace sinew::rdf::shacl {
namespace {

bool is_boolean(std::string_view text) {
  return text == "true" || text == "false" || text == "1" || text == "0";
}

bool is_hex_digit(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

bool is_hex_binary(std::string_view text) {
  return text.size() % 2 == 0 && std::all_of(text.begin(), text.end(), is_hex_digit);
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
  const auto is_digit = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+' ||
           c == '/';
  };
  if (!std::all_of(digits.begin(), digits.end(), is_digit)) return false;
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
    const auto fits = [first](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (!first && c >= '0' && c <= '9');
    };
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
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (c & 0x80) != 0 ||
           (c == ':' && colons);
  };
  const auto continues = [&](char c) {
    return starts(c) || (c >= '0' && c <= '9') || c == '-' || c == '.';
  };
  return !text.empty() && (any_start || starts(text[0])) &&
         std::all_of(text.begin(), text.end(), continues);
}

struct DateRow {
  std::string_view name;
  DateKind kind;
};
constexpr DateRow kDates[] = {
    {"dateTime", DateKind::kDateTime}, {"dateTimeStamp", DateKind::kDateTimeStamp},
    {"date", DateKind::kDate},         {"time", DateKind::kTime},
    {"gYear", DateKind::kYear},        {"gYearMonth", DateKind::kYearMonth},
    {"gMonth", DateKind::kMonth},      {"gMonthDay", DateKind::kMonthDay},
    {"gDay", DateKind::kDay},
};

std::optional<DateKind> date_kind(std::string_view name) {
  for (const DateRow& row : kDates) {
    if (row.name == name) return row.kind;
  }
  return std::nullopt;
}

struct TextRow {
  std::string_view name;
  bool (*check)(std::string_view);
};
constexpr TextRow kTexts[] = {
    {"boolean", is_boolean},
    {"hexBinary", is_hex_binary},
    {"base64Binary", is_base64_binary},
    {"language", is_language},
    {"normalizedString", is_normalized},
    {"token", is_token},
    {"Name", [](std::string_view text) { return is_name(text, false, true); }},
    {"NCName", [](std::string_view text) { return is_name(text, false, false); }},
    {"NMTOKEN", [](std::string_view text) { return is_name(text, true, true); }},
    {"duration", [](std::string_view text) { return is_duration(text, DurationKind::kAny); }},
    {"yearMonthDuration",
     [](std::string_view text) { return is_duration(text, DurationKind::kYearMonth); }},
    {"dayTimeDuration",
     [](std::string_view text) { return is_duration(text, DurationKind::kDayTime); }},
};

// The name behind the namespace of XML Schema, or nothing.
std::string_view xsd_name(std::string_view datatype) {
  return datatype.starts_with(kXsd) ? datatype.substr(kXsd.size()) : std::string_view();
}

// A decimal without sign and without superfluous zeros.
struct Digits {
  bool negative = false;
  std::string_view whole, fraction;

  explicit Digits(std::string_view text) {
    if (text.starts_with('-') || text.starts_with('+')) {
      negative = text[0] == '-';
      text.remove_prefix(1);
    }
    const std::size_t point = std::min(text.find('.'), text.size());
    whole = text.substr(0, point);
    whole.remove_prefix(std::min(whole.find_first_not_of('0'), whole.size()));
    fraction = text.substr(std::min(point + 1, text.size()));
    fraction = fraction.substr(0, fraction.find_last_not_of('0') + 1);
    if (whole.empty() && fraction.empty()) negative = false;
  }
};

std::partial_ordering compare_decimals(std::string_view a_text, std::string_view b_text) {
  const Digits a(a_text), b(b_text);
  if (a.negative != b.negative) {
    return a.negative ? std::partial_ordering::less : std::partial_ordering::greater;
  }
  std::partial_ordering order = a.whole.size() <=> b.whole.size();
  if (order == 0) order = a.whole <=> b.whole;
  if (order == 0) order = a.fraction <=> b.fraction;
  return a.negative ? 0 <=> order : order;
}

bool is_exact(std::string_view datatype) {
  const graph::NumericType type = graph::numeric_type(xsd_name(datatype));
  return type == graph::NumericType::kDecimal || graph::is_integer(type);
}

}  // namespace

bool is_well_formed(std::string_view lexical, std::string_view datatype) {
  const std::string_view name = xsd_name(datatype);
  if (const auto type = graph::numeric_type(name); type != graph::NumericType::kNone) {
    return graph::parse_number(lexical, type).has_value();
  }
  if (const auto kind = date_kind(name)) return parse_date_time(lexical, *kind).has_value();
  for (const TextRow& row : kTexts) {
    if (row.name == name) return row.check(lexical);
  }
  return true;
}

std::partial_ordering compare_values(Id a, Id b, const graph::Terms& terms) {
  if (!terms.is_literal(a) || !terms.is_literal(b)) return std::partial_ordering::unordered;
  const Id a_type = terms.datatype(a), b_type = terms.datatype(b);
  const std::string_view a_name = terms.text(a_type), b_name = terms.text(b_type);
  const auto a_number = terms.number(a), b_number = terms.number(b);
  if (a_number && b_number) {
    if (is_exact(a_name) && is_exact(b_name)) return compare_decimals(terms.text(a), terms.text(b));
    return *a_number <=> *b_number;
  }
  if (a_type != b_type || !terms.language(a).empty()) return std::partial_ordering::unordered;
  const std::string_view name = xsd_name(a_name);
  if (name == "string") return terms.text(a) <=> terms.text(b);
  if (name == "boolean") {
    if (!is_boolean(terms.text(a)) || !is_boolean(terms.text(b))) {
      return std::partial_ordering::unordered;
    }
    const auto truth = [&](Id id) { return terms.text(id) == "true" || terms.text(id) == "1"; };
    return static_cast<int>(truth(a)) <=> static_cast<int>(truth(b));
  }
  if (const auto kind = date_kind(name)) {
    const auto a_time = parse_date_time(terms.text(a), *kind);
    const auto b_time = parse_date_time(terms.text(b), *kind);
    if (a_time && b_time) return compare(*a_time, *b_time);
  }
  return std::partial_ordering::unordered;
}

std::string to_lower(std::string_view ascii) {
  std::string lower(ascii);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

bool language_matches(std::string_view language, std::string_view range) {
  if (range == "*") return !language.empty();
  const std::string tag = to_lower(language), prefix = to_lower(range);
  return tag.starts_with(prefix) && (tag.size() == prefix.size() || tag[prefix.size()] == '-');
}

std::size_t character_count(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace sinew::rdf::shacl
