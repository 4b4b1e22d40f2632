#include "sinew/rdf/sparql/values/time_arithmetic.h"

#include <cmath>

namespace sinew::rdf::sparql::values {
namespace {

Duration negated(const Duration& duration) { return {-duration.months, negate(duration.seconds)}; }

Value lasting(const Duration& duration, Datatype type) {
  return in_range(duration) ? Value::of_duration(duration, type) : Value::error();
}

// A date stays a date: the part below a day is cut off. A time wraps around midnight.
Value moved(const Value& instant, const Duration& by) {
  if (instant.kind == ValueKind::kTime && by.months != 0) return Value::error();
  auto result = add(instant.instant(), by);
  if (!result) return Value::error();
  const Clock clock = clock_of(*result);
  if (instant.kind == ValueKind::kDate) {
    const auto rest = add(clock.second, Decimal::of(clock.hour * 3600 + clock.minute * 60));
    if (!rest) return Value::error();
    result->seconds = subtract(result->seconds, *rest).value_or(result->seconds);
  }
  if (instant.kind == ValueKind::kTime) {
    result = parse_instant(to_string(*result, Datatype::kTime), Datatype::kTime);
    if (!result) return Value::error();
  }
  return Value::of_instant(instant.kind, *result);
}

// Without a zone on one side, the two may be hours apart in truth: no value.
Value difference(const Value& a, const Value& b) {
  if (a.kind != b.kind || a.instant().has_zone() != b.instant().has_zone()) return Value::error();
  const auto seconds = subtract(a.decimal, b.decimal);
  if (!seconds) return Value::error();
  return Value::of_duration({0, *seconds}, Datatype::kDayTimeDuration);
}

Value sum(Operator op, const Value& a, const Value& b) {
  if (a.type != b.type || a.type == Datatype::kDuration) return Value::error();
  const Duration second = op == Operator::kAdd ? b.duration() : negated(b.duration());
  const auto seconds = add(a.decimal, second.seconds);
  if (!seconds) return Value::error();
  return lasting({a.months + second.months, *seconds}, a.type);
}

Value scaled(Operator op, const Value& duration, const Value& number) {
  if (duration.type == Datatype::kDuration) return Value::error();
  const bool exact = number.kind == ValueKind::kInteger || number.kind == ValueKind::kDecimal;
  const auto factor = exact ? std::optional(number.decimal) : decimal_of(number.real);
  if (!factor) return Value::error();
  const auto scale = [&](const Decimal& part) {
    return op == Operator::kMultiply ? multiply(part, *factor) : divide(part, *factor);
  };
  const auto seconds = scale(duration.decimal);
  const auto months = scale(Decimal::of(duration.months));
  if (!seconds || !months) return Value::error();
  const auto whole = to_int64(round(*months, Rounding::kHalfUp));
  return whole ? lasting({*whole, *seconds}, duration.type) : Value::error();
}

Value ratio(const Value& a, const Value& b) {
  if (a.type != b.type || a.type == Datatype::kDuration) return Value::error();
  const bool by_months = a.type == Datatype::kYearMonthDuration;
  const auto result = by_months ? divide(Decimal::of(a.months), Decimal::of(b.months))
                                : divide(a.decimal, b.decimal);
  return result ? Value::of_decimal(*result) : Value::error();
}

}  // namespace

Value time_arithmetic(Operator op, const Value& a, const Value& b) {
  const bool a_lasts = a.kind == ValueKind::kDuration;
  const bool b_lasts = b.kind == ValueKind::kDuration;
  switch (op) {
    case Operator::kAdd:
      if (a.is_instant() && b_lasts) return moved(a, b.duration());
      if (a_lasts && b.is_instant()) return moved(b, a.duration());
      if (a_lasts && b_lasts) return sum(op, a, b);
      break;
    case Operator::kSubtract:
      if (a.is_instant() && b_lasts) return moved(a, negated(b.duration()));
      if (a.is_instant() && b.is_instant()) return difference(a, b);
      if (a_lasts && b_lasts) return sum(op, a, b);
      break;
    case Operator::kMultiply:
      if (a_lasts && b.is_numeric()) return scaled(op, a, b);
      if (a.is_numeric() && b_lasts) return scaled(op, b, a);
      break;
    case Operator::kDivide:
      if (a_lasts && b.is_numeric()) return scaled(op, a, b);
      if (a_lasts && b_lasts) return ratio(a, b);
      break;
    default:
      break;
  }
  return Value::error();
}

}  // namespace sinew::rdf::sparql::values
