#include <cmath>

#include "sinew/rdf/sparql/values/operators.h"
#include "sinew/rdf/sparql/values/time_arithmetic.h"

namespace sinew::rdf::sparql::values {
namespace {

double real_of(const Value& value) {
  return value.kind == ValueKind::kInteger || value.kind == ValueKind::kDecimal
             ? to_double(value.decimal)
             : value.real;
}

template <typename Real>
Real compute(Operator op, Real a, Real b) {
  switch (op) {
    case Operator::kAdd:
      return a + b;
    case Operator::kSubtract:
      return a - b;
    case Operator::kMultiply:
      return a * b;
    default:
      return a / b;
  }
}

Value exact(Operator op, const Value& a, const Value& b) {
  std::optional<Decimal> result;
  switch (op) {
    case Operator::kAdd:
      result = add(a.decimal, b.decimal);
      break;
    case Operator::kSubtract:
      result = subtract(a.decimal, b.decimal);
      break;
    case Operator::kMultiply:
      result = multiply(a.decimal, b.decimal);
      break;
    default:
      result = divide(a.decimal, b.decimal);
      break;
  }
  if (!result) return Value::error();  // division by zero, or too many digits
  Value value = Value::of_decimal(*result);
  // integer / integer is a decimal (section 17.3).
  if (a.kind == ValueKind::kInteger && b.kind == ValueKind::kInteger && op != Operator::kDivide) {
    value.kind = ValueKind::kInteger;
  }
  return value;
}

}  // namespace

Value arithmetic(Operator op, const Value& a, const Value& b) {
  if (!a.is_numeric() || !b.is_numeric()) return time_arithmetic(op, a, b);
  if (a.kind == ValueKind::kDouble || b.kind == ValueKind::kDouble) {
    return Value::of_double(compute(op, real_of(a), real_of(b)));
  }
  if (a.kind == ValueKind::kFloat || b.kind == ValueKind::kFloat) {
    return Value::of_float(
        compute(op, static_cast<float>(real_of(a)), static_cast<float>(real_of(b))));
  }
  return exact(op, a, b);
}

Value negated(const Value& a) {
  Value result = a;
  result.id = {};
  switch (a.kind) {
    case ValueKind::kInteger:
    case ValueKind::kDecimal:
      result.decimal = negate(a.decimal);
      return result;
    case ValueKind::kFloat:
    case ValueKind::kDouble:
      result.real = -a.real;
      return result;
    default:
      return Value::error();
  }
}

}  // namespace sinew::rdf::sparql::values
