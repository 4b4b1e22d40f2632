// Functions on numbers and times, and what is random (SPARQL 1.1, sections 17.4.4 and 17.4.5).
#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "sinew/rdf/sparql/eval/state.h"

namespace sinew::rdf::sparql::eval {

using values::Decimal;
using values::ValueKind;

namespace {

double rounded(Operator op, double value) {
  switch (op) {
    case Operator::kAbs:
      return std::fabs(value);
    case Operator::kCeil:
      return std::ceil(value);
    case Operator::kFloor:
      return std::floor(value);
    default: {
      // Half up; value + 0.5 would round numbers just below a half.
      const double below = std::floor(value);
      return value - below >= 0.5 ? below + 1 : below;
    }
  }
}

Decimal rounded(Operator op, const Decimal& value) {
  switch (op) {
    case Operator::kAbs:
      return value.coefficient < 0 ? values::negate(value) : value;
    case Operator::kCeil:
      return values::round(value, values::Rounding::kCeiling);
    case Operator::kFloor:
      return values::round(value, values::Rounding::kFloor);
    default:
      return values::round(value, values::Rounding::kHalfUp);
  }
}

}  // namespace

Value Evaluator::number_function(const plan::Expression& call) {
  if (call.op == Operator::kRand) {
    // 53 random bits.
    return Value::of_double(static_cast<double>(random_bits() >> 11) * 0x1.0p-53);
  }
  Value number = argument(call, 0);
  if (!number.is_numeric()) return Value::error();
  number.id = {};
  number.text = {};
  if (number.kind == ValueKind::kInteger || number.kind == ValueKind::kDecimal) {
    number.decimal = rounded(call.op, number.decimal);
  } else {
    number.real = rounded(call.op, number.real);
  }
  return number;
}

std::uint64_t Evaluator::random_bits() {
  if (!random_) random_.emplace(std::random_device{}());
  return (*random_)();
}

std::string Evaluator::random_uuid() {
  std::uint64_t high = random_bits();
  std::uint64_t low = random_bits();
  high = (high & ~0xF000ull) | 0x4000ull;                // version 4
  low = (low & ~(0xC000ull << 48)) | (0x8000ull << 48);  // variant of RFC 4122
  return fmt::format("{:08x}-{:04x}-{:04x}-{:04x}-{:012x}", high >> 32, (high >> 16) & 0xFFFF,
                     high & 0xFFFF, low >> 48, low & 0xFFFFFFFFFFFFull);
}

// The same throughout one evaluation.
Value Evaluator::now() {
  if (!now_) {
    const auto since = std::chrono::system_clock::now().time_since_epoch();
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(since).count();
    values::Instant instant;
    instant.seconds = {ms, 3};
    instant.zone_minutes = 0;
    now_ = Value::of_instant(ValueKind::kDateTime, instant);
  }
  return *now_;
}

Value Evaluator::time_function(const plan::Expression& call) {
  if (call.op == Operator::kNow) return now();
  const Value time = argument(call, 0);
  if (!time.is_instant()) return Value::error();
  const values::Instant instant = time.instant();
  const bool has_date = time.kind != ValueKind::kTime;
  const bool has_clock = time.kind != ValueKind::kDate;
  switch (call.op) {
    case Operator::kTz:
      return kept_string(values::zone_text(instant));
    case Operator::kTimezone:
      if (!instant.has_zone()) return Value::error();
      return Value::of_duration({0, Decimal::of(instant.zone_minutes * 60)},
                                values::Datatype::kDayTimeDuration);
    default:
      break;
  }
  const values::Clock clock = values::clock_of(instant);
  switch (call.op) {
    case Operator::kYear:
      return has_date ? Value::of_integer(clock.year) : Value::error();
    case Operator::kMonth:
      return has_date ? Value::of_integer(clock.month) : Value::error();
    case Operator::kDay:
      return has_date ? Value::of_integer(clock.day) : Value::error();
    case Operator::kHours:
      return has_clock ? Value::of_integer(clock.hour) : Value::error();
    case Operator::kMinutes:
      return has_clock ? Value::of_integer(clock.minute) : Value::error();
    default:
      return has_clock ? Value::of_decimal(clock.second) : Value::error();
  }
}

}  // namespace sinew::rdf::sparql::eval
