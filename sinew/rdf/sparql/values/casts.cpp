#include "sinew/rdf/sparql/values/casts.h"

#include <cmath>

#include "sinew/rdf/sparql/values/numbers.h"

namespace sinew::rdf::sparql::values {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\n\r";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

Value to_boolean(const Value& value) {
  switch (value.kind) {
    case ValueKind::kString: {
      const std::string_view text = trimmed(value.text);
      if (text == "true" || text == "1") return Value::of(true);
      if (text == "false" || text == "0") return Value::of(false);
      return Value::error();
    }
    case ValueKind::kInteger:
    case ValueKind::kDecimal:
      return Value::of(value.decimal.coefficient != 0);
    case ValueKind::kFloat:
    case ValueKind::kDouble:
      return Value::of(value.real != 0 && !std::isnan(value.real));
    default:
      return Value::error();
  }
}

std::optional<double> as_double(const Value& value) {
  switch (value.kind) {
    case ValueKind::kString:
      return parse_double(trimmed(value.text));
    case ValueKind::kBoolean:
      return value.boolean ? 1 : 0;
    case ValueKind::kInteger:
    case ValueKind::kDecimal:
      return to_double(value.decimal);
    case ValueKind::kFloat:
    case ValueKind::kDouble:
      return value.real;
    default:
      return std::nullopt;
  }
}

std::optional<Decimal> as_decimal(const Value& value) {
  switch (value.kind) {
    case ValueKind::kString:
      return parse_decimal(trimmed(value.text));
    case ValueKind::kBoolean:
      return Decimal::of(value.boolean ? 1 : 0);
    case ValueKind::kInteger:
    case ValueKind::kDecimal:
      return value.decimal;
    case ValueKind::kFloat:
    case ValueKind::kDouble:
      return decimal_of(value.real);
    default:
      return std::nullopt;
  }
}

Value to_integer(const Value& value) {
  if (value.kind == ValueKind::kString) {
    const auto number = parse_integer(trimmed(value.text), kXsdInteger);
    if (!number) return Value::error();
    Value result = Value::of_decimal(*number);
    result.kind = ValueKind::kInteger;
    return result;
  }
  const auto number = as_decimal(value);
  if (!number) return Value::error();
  // Towards zero.
  const bool negative = number->coefficient < 0;
  Value result =
      Value::of_decimal(round(*number, negative ? Rounding::kCeiling : Rounding::kFloor));
  result.kind = ValueKind::kInteger;
  return result;
}

Value to_instant(const Value& value, ValueKind kind, Datatype type) {
  if (value.kind == kind) return value;
  if (value.kind == ValueKind::kString) {
    const auto instant = parse_instant(trimmed(value.text), type);
    return instant ? Value::of_instant(kind, *instant) : Value::error();
  }
  // A date begins at midnight; a date or a time is a part of a dateTime.
  if (!value.is_instant()) return Value::error();
  const std::string zone = zone_text(value.instant());
  std::string text;
  if (value.kind == ValueKind::kDateTime) {
    const std::string all = to_string(value.instant(), Datatype::kDateTime);
    const std::size_t t = all.find('T');
    text = type == Datatype::kDate ? all.substr(0, t) + zone : all.substr(t + 1);
  } else if (value.kind == ValueKind::kDate && type == Datatype::kDateTime) {
    const std::string all = to_string(value.instant(), Datatype::kDate);
    text = all.substr(0, all.size() - zone.size()) + "T00:00:00" + zone;
  }
  const auto instant = parse_instant(text, type);
  return instant ? Value::of_instant(kind, *instant) : Value::error();
}

Value to_duration(const Value& value, Datatype type) {
  Duration duration;
  if (value.kind == ValueKind::kString) {
    const auto parsed = parse_duration(trimmed(value.text), type);
    if (!parsed) return Value::error();
    duration = *parsed;
  } else if (value.kind == ValueKind::kDuration) {
    duration = value.duration();
    if (type == Datatype::kDayTimeDuration) duration.months = 0;
    if (type == Datatype::kYearMonthDuration) duration.seconds = {};
  } else {
    return Value::error();
  }
  return Value::of_duration(duration, type);
}

// A boolean's or a number's text, which casts and str() write in two ways; false for others.
template <typename FloatText, typename DoubleText>
bool write_plain(const Value& value, FloatText float_form, DoubleText double_form,
                 std::string& text) {
  switch (value.kind) {
    case ValueKind::kBoolean:
      text = value.boolean ? "true" : "false";
      return true;
    case ValueKind::kInteger:
    case ValueKind::kDecimal:
      text = to_string(value.decimal);
      return true;
    case ValueKind::kFloat:
      text = float_form(static_cast<float>(value.real));
      return true;
    case ValueKind::kDouble:
      text = double_form(value.real);
      return true;
    default:
      return false;
  }
}

Value to_text(const Value& value, const TermSpace& space, std::string& text) {
  // Numbers and booleans are cast by value, not by how they are written.
  if (write_plain(value, float_as_string, double_as_string, text)) return Value::of_string(text);
  const auto plain = as_text(value, space, text);
  return plain ? Value::of_string(*plain) : Value::error();
}

}  // namespace

std::optional<std::string_view> as_text(const Value& value, const TermSpace& space,
                                        std::string& text) {
  switch (value.kind) {
    case ValueKind::kError:
    case ValueKind::kBlank:
      return std::nullopt;
    case ValueKind::kIri:
      return text_of(value, space);
    case ValueKind::kString:
    case ValueKind::kLangString:
    case ValueKind::kOther:
      return value.text;
    default:
      break;
  }
  if (value.id) return value.text;
  if (write_plain(value, float_text, double_text, text)) return text;
  switch (value.kind) {
    case ValueKind::kDateTime:
      text = to_string(value.instant(), Datatype::kDateTime);
      break;
    case ValueKind::kDate:
      text = to_string(value.instant(), Datatype::kDate);
      break;
    case ValueKind::kTime:
      text = to_string(value.instant(), Datatype::kTime);
      break;
    default:
      text = to_string(value.duration(), value.type);
      break;
  }
  return text;
}

Value cast(const Value& value, Datatype to, const TermSpace& space, std::string& text) {
  // A literal with a language cannot be cast, but to a string.
  switch (to) {
    case Datatype::kString:
      return to_text(value, space, text);
    case Datatype::kBoolean:
      return value.kind == ValueKind::kBoolean ? Value::of(value.boolean) : to_boolean(value);
    case Datatype::kInteger:
      return to_integer(value);
    case Datatype::kDecimal: {
      const auto number = as_decimal(value);
      return number ? Value::of_decimal(*number) : Value::error();
    }
    case Datatype::kFloat: {
      const auto number = as_double(value);
      return number ? Value::of_float(static_cast<float>(*number)) : Value::error();
    }
    case Datatype::kDouble: {
      const auto number = as_double(value);
      return number ? Value::of_double(*number) : Value::error();
    }
    case Datatype::kDateTime:
      return to_instant(value, ValueKind::kDateTime, to);
    case Datatype::kDate:
      return to_instant(value, ValueKind::kDate, to);
    case Datatype::kTime:
      return to_instant(value, ValueKind::kTime, to);
    case Datatype::kDuration:
    case Datatype::kDayTimeDuration:
    case Datatype::kYearMonthDuration:
      return to_duration(value, to);
    case Datatype::kLangString:
    case Datatype::kOther:
      break;
  }
  return Value::error();
}

}  // namespace sinew::rdf::sparql::values
