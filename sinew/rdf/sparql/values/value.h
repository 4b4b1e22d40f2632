// A term taken apart, for expressions: what kind of value it is and the value itself.
//
// A Value is made from a term (its id is kept, so that it goes back unchanged) or computed (no id,
// until `term_of` makes one). Views point into the dictionary or into the evaluation's text memory.
// kError stands for an error or an unbound variable, which expressions treat alike.
#pragma once

#include <cstdint>
#include <string_view>

#include "sinew/graph/terms.h"
#include "sinew/rdf/sparql/values/date_time.h"
#include "sinew/rdf/sparql/values/decimal.h"
#include "sinew/rdf/sparql/values/term_space.h"
#include "sinew/rdf/sparql/values/xsd.h"

namespace sinew::rdf::sparql::values {

enum class ValueKind : std::uint8_t {
  kError,
  kIri,
  kBlank,
  kString,      // text
  kLangString,  // text, language
  kBoolean,     // boolean
  kInteger,
  kDecimal,  // decimal
  kFloat,
  kDouble,  // real
  kDateTime,
  kDate,
  kTime,      // an instant: decimal (seconds), zone_minutes
  kDuration,  // months, decimal (seconds), type
  kOther,     // a literal of a datatype we do not compute with, or one that is ill-typed
};

struct Value {
  ValueKind kind = ValueKind::kError;
  bool boolean = false;
  graph::Id id = {};                 // the term it was made from, else null
  Datatype type = Datatype::kOther;  // kDuration: which of the three
  int zone_minutes = Instant::kNoZone;
  double real = 0;
  std::int64_t months = 0;
  Decimal decimal;
  // kString, kLangString; of computed IRIs; the lexical form of literals that have an id. For the
  // text of any IRI use text_of: a derived node's is only made when it is asked for.
  std::string_view text;
  std::string_view language;
  std::string_view datatype;  // kOther

  explicit operator bool() const { return kind != ValueKind::kError; }
  bool is_numeric() const { return kind >= ValueKind::kInteger && kind <= ValueKind::kDouble; }
  bool is_literal() const { return kind >= ValueKind::kString; }
  bool is_instant() const { return kind >= ValueKind::kDateTime && kind <= ValueKind::kTime; }
  Instant instant() const { return {decimal, zone_minutes}; }
  Duration duration() const { return {months, decimal}; }

  static Value error() { return {}; }
  static Value of(bool value);
  static Value of_integer(std::int64_t value);
  static Value of_decimal(const Decimal& value);
  static Value of_double(double value);
  static Value of_float(float value);
  static Value of_instant(ValueKind kind, const Instant& instant);
  static Value of_duration(const Duration& duration, Datatype type);
  static Value of_string(std::string_view text, std::string_view language = {});
};

// The null id gives kError.
Value value_of(graph::Id id, const TermSpace& space);
// The term, which is added to the space if it is new; the null id for kError.
graph::Id term_of(const Value& value, TermSpace& space);

// Of an IRI or a literal with an id: its text.
std::string_view text_of(const Value& value, const TermSpace& space);

// What a condition makes of a value (SPARQL 1.1, section 17.2.2).
enum class Truth : std::uint8_t { kFalse, kTrue, kError };
Truth truth_of(const Value& value);
inline Truth truth(bool value) { return value ? Truth::kTrue : Truth::kFalse; }
inline Value value_of(Truth truth) {
  return truth == Truth::kError ? Value::error() : Value::of(truth == Truth::kTrue);
}

}  // namespace sinew::rdf::sparql::values
