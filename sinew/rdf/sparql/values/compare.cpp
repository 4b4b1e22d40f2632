#include <algorithm>
#include <cmath>

#include "sinew/rdf/sparql/values/operators.h"

namespace sinew::rdf::sparql::values {
namespace {

double as_double(const Value& value) {
  return value.kind == ValueKind::kInteger || value.kind == ValueKind::kDecimal
             ? to_double(value.decimal)
             : value.real;
}

bool is_exact(const Value& value) {
  return value.kind == ValueKind::kInteger || value.kind == ValueKind::kDecimal;
}

// Of two numbers; kUnordered where one is not a number.
enum class Order : std::uint8_t { kLess, kEqual, kGreater, kUnordered };

Order compare_numbers(const Value& a, const Value& b) {
  if (is_exact(a) && is_exact(b)) {
    const int result = compare(a.decimal, b.decimal);
    return result < 0 ? Order::kLess : result > 0 ? Order::kGreater : Order::kEqual;
  }
  double left = as_double(a);
  double right = as_double(b);
  // Promotion goes to xsd:float unless one is a double.
  if (a.kind != ValueKind::kDouble && b.kind != ValueKind::kDouble) {
    left = static_cast<float>(left);
    right = static_cast<float>(right);
  }
  if (left < right) return Order::kLess;
  if (left > right) return Order::kGreater;
  return left == right ? Order::kEqual : Order::kUnordered;
}

Truth is(TimeOrder wanted, TimeOrder order) {
  return order == TimeOrder::kUnknown ? Truth::kError : truth(order == wanted);
}

bool same_language(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) {
           const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; };
           return lower(x) == lower(y);
         });
}

}  // namespace

bool same_node(graph::Id a, graph::Id b, const TermSpace& space) {
  using graph::TermKind;
  if (a == b) return true;
  const TermKind kind_a = space.kind(a);
  const TermKind kind_b = space.kind(b);
  const bool mixed = (kind_a == TermKind::kDerived && kind_b == TermKind::kIri) ||
                     (kind_a == TermKind::kIri && kind_b == TermKind::kDerived);
  return mixed && space.text(a) == space.text(b);
}

Truth same_without_values(graph::Id a, graph::Id b, const TermSpace& space) {
  using graph::TermKind;
  const TermKind kind_a = space.kind(a);
  const TermKind kind_b = space.kind(b);
  if (kind_a == TermKind::kLiteral && kind_b == TermKind::kLiteral) return Truth::kError;
  if (a == b) return Truth::kTrue;
  if (kind_a == kind_b) return Truth::kFalse;
  return truth(same_node(a, b, space));
}

Truth equals(const Value& a, const Value& b, const TermSpace& space) {
  if (!a || !b) return Truth::kError;
  if (!a.is_literal() || !b.is_literal()) {
    if (a.kind != b.kind) return Truth::kFalse;
    if (a.id && b.id) return truth(same_node(a.id, b.id, space));
    if (a.kind != ValueKind::kIri) return Truth::kFalse;
    return truth(text_of(a, space) == text_of(b, space));
  }
  if (a.is_numeric() && b.is_numeric()) return truth(compare_numbers(a, b) == Order::kEqual);
  if (a.kind == ValueKind::kOther || b.kind == ValueKind::kOther) {
    if (a.id && a.id == b.id) return Truth::kTrue;
    if (a.kind == b.kind && a.text == b.text && a.datatype == b.datatype) return Truth::kTrue;
    // The other may be the same value in a datatype that is not known here.
    return Truth::kError;
  }
  if (a.kind != b.kind) return Truth::kFalse;
  switch (a.kind) {
    case ValueKind::kString:
      return truth(a.text == b.text);
    case ValueKind::kLangString:
      return truth(a.text == b.text && same_language(a.language, b.language));
    case ValueKind::kBoolean:
      return truth(a.boolean == b.boolean);
    case ValueKind::kDateTime:
    case ValueKind::kDate:
    case ValueKind::kTime:
      return is(TimeOrder::kSame, compare(a.instant(), b.instant()));
    case ValueKind::kDuration:
      return truth(compare(a.duration(), b.duration()) == TimeOrder::kSame);
    default:
      return Truth::kError;
  }
}

Truth less(const Value& a, const Value& b) {
  if (a.is_numeric() && b.is_numeric()) return truth(compare_numbers(a, b) == Order::kLess);
  if (a.kind != b.kind) return Truth::kError;
  switch (a.kind) {
    case ValueKind::kString:
      return truth(a.text < b.text);
    case ValueKind::kBoolean:
      return truth(!a.boolean && b.boolean);
    case ValueKind::kDateTime:
    case ValueKind::kDate:
    case ValueKind::kTime:
      return is(TimeOrder::kBefore, compare(a.instant(), b.instant()));
    case ValueKind::kDuration:
      return is(TimeOrder::kBefore, compare(a.duration(), b.duration()));
    default:
      return Truth::kError;
  }
}

namespace {

int three_way(std::string_view a, std::string_view b) { return a < b ? -1 : b < a ? 1 : 0; }

int rank(const Value& value) {
  switch (value.kind) {
    case ValueKind::kError:
      return 0;
    case ValueKind::kBlank:
      return 1;
    case ValueKind::kIri:
      return 2;
    default:
      return 3;
  }
}

// Groups of literals that `<` can compare with each other.
int family(const Value& value) {
  return value.is_numeric() ? static_cast<int>(ValueKind::kInteger) : static_cast<int>(value.kind);
}

}  // namespace

int order(graph::Id left, graph::Id right, const TermSpace& space) {
  if (left == right) return 0;
  const Value a = value_of(left, space);
  const Value b = value_of(right, space);
  if (rank(a) != rank(b)) return rank(a) - rank(b);
  switch (rank(a)) {
    case 0:
      return 0;
    case 1:
      // Blank nodes have no order of their own; any will do that stays the same.
      return left.value < right.value ? -1 : 1;
    case 2:
      return three_way(text_of(a, space), text_of(b, space));
    default:
      break;
  }
  if (family(a) != family(b)) return family(a) - family(b);
  if (less(a, b) == Truth::kTrue) return -1;
  if (less(b, a) == Truth::kTrue) return 1;
  // Equal values are equal here, so that the next sort key decides between 1 and 1.0.
  if (equals(a, b, space) == Truth::kTrue) return 0;
  // NaN stands before all other numbers, or the order would not be one.
  if (a.is_numeric()) {
    const bool nan_a = !is_exact(a) && std::isnan(a.real);
    const bool nan_b = !is_exact(b) && std::isnan(b.real);
    if (nan_a != nan_b) return nan_a ? -1 : 1;
  }
  if (const int result = three_way(space.datatype(left), space.datatype(right))) return result;
  if (const int result = three_way(space.text(left), space.text(right))) return result;
  return three_way(space.language(left), space.language(right));
}

}  // namespace sinew::rdf::sparql::values
