#include "sinew/rdf/sparql/values/value.h"

#include <cmath>

#include "sinew/rdf/sparql/values/numbers.h"

namespace sinew::rdf::sparql::values {

using graph::Id;
using graph::TermKind;

Value Value::of(bool value) {
  Value result;
  result.kind = ValueKind::kBoolean;
  result.boolean = value;
  return result;
}

Value Value::of_integer(std::int64_t value) {
  Value result;
  result.kind = ValueKind::kInteger;
  result.decimal = Decimal::of(value);
  return result;
}

Value Value::of_decimal(const Decimal& value) {
  Value result;
  result.kind = ValueKind::kDecimal;
  result.decimal = value;
  return result;
}

Value Value::of_double(double value) {
  Value result;
  result.kind = ValueKind::kDouble;
  result.real = value;
  return result;
}

Value Value::of_float(float value) {
  Value result;
  result.kind = ValueKind::kFloat;
  result.real = value;
  return result;
}

Value Value::of_instant(ValueKind kind, const Instant& instant) {
  Value result;
  result.kind = kind;
  result.decimal = instant.seconds;
  result.zone_minutes = instant.zone_minutes;
  return result;
}

Value Value::of_duration(const Duration& duration, Datatype type) {
  Value result;
  result.kind = ValueKind::kDuration;
  result.months = duration.months;
  result.decimal = duration.seconds;
  result.type = type;
  return result;
}

Value Value::of_string(std::string_view text, std::string_view language) {
  Value result;
  result.kind = language.empty() ? ValueKind::kString : ValueKind::kLangString;
  result.text = text;
  result.language = language;
  return result;
}

namespace {

void read_instant(Value& value, ValueKind kind, Datatype type) {
  const auto instant = parse_instant(value.text, type);
  if (!instant) return;
  value.kind = kind;
  value.decimal = instant->seconds;
  value.zone_minutes = instant->zone_minutes;
}

void read_literal(Value& value, const TypeName& type) {
  const std::string_view datatype = type.iri;
  value.kind = ValueKind::kOther;
  value.datatype = datatype;
  switch (type.datatype) {
    case Datatype::kString:
      value.kind = ValueKind::kString;
      break;
    case Datatype::kLangString:
      value.kind = ValueKind::kLangString;
      break;
    case Datatype::kBoolean:
      if (value.text == "true" || value.text == "1") {
        value.kind = ValueKind::kBoolean;
        value.boolean = true;
      } else if (value.text == "false" || value.text == "0") {
        value.kind = ValueKind::kBoolean;
      }
      break;
    case Datatype::kInteger:
      if (const auto number = parse_integer(value.text, datatype)) {
        value.kind = ValueKind::kInteger;
        value.decimal = *number;
      }
      break;
    case Datatype::kDecimal:
      if (const auto number = parse_decimal(value.text)) {
        value.kind = ValueKind::kDecimal;
        value.decimal = *number;
      }
      break;
    case Datatype::kFloat:
      if (const auto number = parse_double(value.text)) {
        value.kind = ValueKind::kFloat;
        value.real = static_cast<float>(*number);
      }
      break;
    case Datatype::kDouble:
      if (const auto number = parse_double(value.text)) {
        value.kind = ValueKind::kDouble;
        value.real = *number;
      }
      break;
    case Datatype::kDateTime:
      read_instant(value, ValueKind::kDateTime, Datatype::kDateTime);
      break;
    case Datatype::kDate:
      read_instant(value, ValueKind::kDate, Datatype::kDate);
      break;
    case Datatype::kTime:
      read_instant(value, ValueKind::kTime, Datatype::kTime);
      break;
    case Datatype::kDuration:
    case Datatype::kDayTimeDuration:
    case Datatype::kYearMonthDuration:
      value.type = type.datatype;
      if (const auto duration = parse_duration(value.text, value.type)) {
        value.kind = ValueKind::kDuration;
        value.months = duration->months;
        value.decimal = duration->seconds;
      }
      break;
    case Datatype::kOther:
      break;
  }
}

}  // namespace

Value value_of(Id id, const TermSpace& space) {
  Value value;
  value.id = id;
  switch (space.kind(id)) {
    case TermKind::kNone:
      return Value::error();
    case TermKind::kIri:
    case TermKind::kDerived:
      value.kind = ValueKind::kIri;
      return value;
    case TermKind::kBlank:
      value.kind = ValueKind::kBlank;
      return value;
    case TermKind::kLiteral:
      value.text = space.text(id);
      value.language = space.language(id);
      read_literal(value, space.type(id));
      return value;
  }
  return value;
}

std::string_view text_of(const Value& value, const TermSpace& space) {
  return value.kind == ValueKind::kIri && value.id ? space.text(value.id) : value.text;
}

Id term_of(const Value& value, TermSpace& space) {
  if (value.id) return value.id;
  switch (value.kind) {
    case ValueKind::kError:
    case ValueKind::kBlank:  // always has an id
      return {};
    case ValueKind::kIri:
      return space.iri(value.text);
    case ValueKind::kString:
      return space.literal(value.text);
    case ValueKind::kLangString:
      return space.literal(value.text, {}, value.language);
    case ValueKind::kBoolean:
      return space.literal(value.boolean ? "true" : "false", kXsdBoolean);
    case ValueKind::kInteger:
      return space.literal(to_string(value.decimal), kXsdInteger);
    case ValueKind::kDecimal:
      return space.literal(to_string(value.decimal), kXsdDecimal);
    case ValueKind::kFloat:
      return space.literal(float_text(static_cast<float>(value.real)), kXsdFloat);
    case ValueKind::kDouble:
      return space.literal(double_text(value.real), kXsdDouble);
    case ValueKind::kDateTime:
      return space.literal(to_string(value.instant(), Datatype::kDateTime), kXsdDateTime);
    case ValueKind::kDate:
      return space.literal(to_string(value.instant(), Datatype::kDate), kXsdDate);
    case ValueKind::kTime:
      return space.literal(to_string(value.instant(), Datatype::kTime), kXsdTime);
    case ValueKind::kDuration:
      return space.literal(to_string(value.duration(), value.type), iri_of(value.type));
    case ValueKind::kOther:
      return space.literal(value.text, value.datatype);
  }
  return {};
}

Truth truth_of(const Value& value) {
  switch (value.kind) {
    case ValueKind::kBoolean:
      return truth(value.boolean);
    case ValueKind::kString:
    case ValueKind::kLangString:
      return truth(!value.text.empty());
    case ValueKind::kInteger:
    case ValueKind::kDecimal:
      return truth(value.decimal.coefficient != 0);
    case ValueKind::kFloat:
    case ValueKind::kDouble:
      return truth(value.real != 0 && !std::isnan(value.real));
    case ValueKind::kOther: {
      // A boolean or a number with an invalid lexical form is false.
      const Datatype datatype = datatype_of(value.datatype);
      const bool ill_typed = datatype == Datatype::kBoolean || datatype == Datatype::kInteger ||
                             datatype == Datatype::kDecimal || datatype == Datatype::kFloat ||
                             datatype == Datatype::kDouble;
      return ill_typed ? Truth::kFalse : Truth::kError;
    }
    default:
      return Truth::kError;
  }
}

}  // namespace sinew::rdf::sparql::values
