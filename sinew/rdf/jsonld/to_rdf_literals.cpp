// Literals: from a value object to an RDF literal (JSON-LD 1.1 API, section 8.2).
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "sinew/graph/standard_iris.h"
#include "sinew/graph/store.h"
#include "sinew/rdf/iri/characters.h"
#include "sinew/rdf/iri/iri.h"
#include "sinew/rdf/json/writer.h"
#include "sinew/rdf/jsonld/expanded.h"
#include "sinew/rdf/jsonld/rdf_names.h"
#include "sinew/rdf/jsonld/to_rdf.h"

namespace sinew::jsonld {
namespace {

using graph::Id;

// A number is written as an integer when it has no fraction and is below this (section 8.2, step
// 10).
constexpr double kIntegerLimit = 1e21;

// The canonical form of xsd:double, as section 8.6 has it: one digit before the point, at most 15
// and at least one behind it, an exponent without sign or zeros that it does not need.
std::string canonical_double(double value) {
  if (std::isinf(value)) return value < 0 ? "-INF" : "INF";
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::scientific, 15);
  const std::string_view text(buffer.data(), static_cast<std::size_t>(end.ptr - buffer.data()));
  const std::size_t e = text.find('e');
  std::string result(text.substr(0, e));
  while (result.ends_with('0') && !result.ends_with(".0")) result.pop_back();
  int exponent = 0;
  const char* sign = text.data() + e + 1;
  std::from_chars(*sign == '+' ? sign + 1 : sign, end.ptr, exponent);
  return result + "E" + std::to_string(exponent);
}

// All digits of a number without fraction, exponent or needless sign.
std::string integer_text(double value) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(),
                                 value == 0 ? 0 : value, std::chars_format::fixed, 0);
  return {buffer.data(), end.ptr};
}

// xsd:decimal has no exponents: all digits, the fewest that read back to the same value.
std::string decimal_text(double value) {
  std::array<char, 400> buffer;  // 5e-324 has 326 characters
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed);
  return {buffer.data(), end.ptr};
}

bool is_plain_decimal(std::string_view number) {
  return number.find_first_of("eE") == std::string_view::npos;
}

bool is_plain_integer(std::string_view number) {
  return number.find_first_of(".eE") == std::string_view::npos;
}

}  // namespace

Id ToRdf::literal(const json::Value& object) {
  const json::Value& value = *object.find(keyword::kValue);
  const auto text_of = [&](std::string_view key) {
    const json::Value* found = object.find(key);
    return found == nullptr ? std::string_view{} : found->text();
  };
  const std::string_view type = text_of(keyword::kType);
  if (type == keyword::kJson) return json_literal(value);
  // Like every other quad with an ill-formed part, one with such a datatype or language is left
  // out.
  Id datatype;
  if (!type.empty()) {
    datatype = iri(type, object.position(), "datatype", {});
    if (!datatype) return {};
  }
  const std::string_view language = text_of(keyword::kLanguage);
  if (!language.empty() && !rdf::is_language_tag(language)) {
    if (context_.check != nullptr) {
      context_.check->dropped_quad(place_in(context_.source, value.position()), "",
                                   fmt::format("\"{}\" is no language tag", language),
                                   "a tag such as \"en\" or \"de-AT\"");
    }
    return {};
  }
  const std::string_view direction = text_of(keyword::kDirection);

  if (value.is_boolean()) {
    const std::string_view text = value.is_true() ? "true" : "false";
    return datatype ? terms_.literal(text, datatype) : terms_.literal(text, graph::kXsdBoolean);
  }
  if (value.is_number()) return number_literal(value, type);
  if (!direction.empty() && context_.options.rdf_direction != RdfDirection::kNone) {
    return directed_literal(value, language, direction);
  }
  if (datatype) return terms_.literal(value.text(), datatype);
  return terms_.literal(value.text(), {}, language);
}

Id ToRdf::number_literal(const json::Value& number, std::string_view datatype) {
  const double value = number.number();
  const bool is_double = datatype == graph::kXsdDouble;
  const bool whole = std::trunc(value) == value && std::fabs(value) < kIntegerLimit;
  if (context_.numbers == Numbers::kExact) {
    if (datatype == graph::kXsdDecimal) {
      const bool plain = is_plain_decimal(number.text());
      return terms_.literal(plain ? number.text() : decimal_text(value), datatype);
    }
    if (!is_double && is_plain_integer(number.text())) {
      return terms_.literal(number.text(), datatype.empty() ? graph::kXsdInteger : datatype);
    }
    // "1.0" is meant as a real number, whatever the standard makes of it.
    if (is_double || datatype.empty()) return terms_.real(value);
  }
  if (whole && !is_double) {
    return terms_.literal(integer_text(value), datatype.empty() ? graph::kXsdInteger : datatype);
  }
  return terms_.literal(canonical_double(value), datatype.empty() ? graph::kXsdDouble : datatype);
}

Id ToRdf::directed_literal(const json::Value& text, std::string_view language,
                           std::string_view direction) {
  std::string lower(language);
  for (char& c : lower) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c + 0x20 : c);
  if (context_.options.rdf_direction == RdfDirection::kI18nDatatype) {
    const std::string datatype =
        std::string(rdf_name::kI18n) + lower + "_" + std::string(direction);
    return terms_.literal(text.text(), datatype);
  }
  const Id literal = terms_.fresh_blank();
  const auto describe = [&](std::string_view property, std::string_view value) {
    emit(literal, terms_.iri(property), terms_.literal(value), current_graph_, {});
  };
  describe(rdf_name::kValue, text.text());
  if (!lower.empty()) describe(rdf_name::kLanguage, lower);
  describe(rdf_name::kDirection, direction);
  return literal;
}

Id ToRdf::json_literal(const json::Value& value) {
  return terms_.literal(json::to_canonical_text(value), rdf_name::kJson);
}

}  // namespace sinew::jsonld
