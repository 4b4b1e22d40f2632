// Expressions: conditions without making values where ids suffice, and the forms that handle errors
// themselves (SPARQL 1.1, section 17.2 and 17.4.1).
#include "sinew/rdf/sparql/eval/state.h"
#include "sinew/rdf/sparql/values/operators.h"

namespace sinew::rdf::sparql::eval {

using graph::TermKind;

Id Evaluator::term(Index index) {
  const plan::Expression& expression = plan_->expressions[index];
  switch (expression.op) {
    case Operator::kConstant:
    case Operator::kVariable:
      return slots_[expression.slot];
    case Operator::kUnbound:
      return {};
    default:
      break;
  }
  const TextMemory::Mark mark = texts_.mark();
  const Id result = values::term_of(value(index), space_);
  texts_.release(mark);
  return result;
}

Truth Evaluator::condition(Index index) {
  const plan::Expression& expression = plan_->expressions[index];
  switch (expression.op) {
    case Operator::kAnd:
      return all_of(expression);
    case Operator::kOr:
      return any_of(expression);
    case Operator::kNot: {
      const Truth inner = condition(plan_->arguments[expression.first]);
      if (inner == Truth::kError) return inner;
      return values::truth(inner == Truth::kFalse);
    }
    case Operator::kBound:
      return values::truth(static_cast<bool>(slots_[expression.slot]));
    case Operator::kExists:
      return values::truth(finds(expression.body));
    case Operator::kNotExists:
      return values::truth(!finds(expression.body));
    case Operator::kIn:
      return in_list(expression);
    case Operator::kNotIn: {
      const Truth inside = in_list(expression);
      if (inside == Truth::kError) return inside;
      return values::truth(inside == Truth::kFalse);
    }
    case Operator::kEqual:
    case Operator::kNotEqual:
    case Operator::kLess:
    case Operator::kGreater:
    case Operator::kLessOrEqual:
    case Operator::kGreaterOrEqual: {
      const TextMemory::Mark mark = texts_.mark();
      const Truth result = compare(expression);
      texts_.release(mark);
      return result;
    }
    default: {
      const TextMemory::Mark mark = texts_.mark();
      const Truth result = values::truth_of(value(index));
      texts_.release(mark);
      return result;
    }
  }
}

// Three-valued: false wins over an error.
Truth Evaluator::all_of(const plan::Expression& expression) {
  Truth result = Truth::kTrue;
  for (std::uint32_t i = 0; i < expression.count; ++i) {
    const Truth part = condition(plan_->arguments[expression.first + i]);
    if (part == Truth::kFalse) return part;
    if (part == Truth::kError) result = part;
  }
  return result;
}

// Three-valued: true wins over an error.
Truth Evaluator::any_of(const plan::Expression& expression) {
  Truth result = Truth::kFalse;
  for (std::uint32_t i = 0; i < expression.count; ++i) {
    const Truth part = condition(plan_->arguments[expression.first + i]);
    if (part == Truth::kTrue) return part;
    if (part == Truth::kError) result = part;
  }
  return result;
}

Truth Evaluator::in_list(const plan::Expression& expression) {
  const Value wanted = argument(expression, 0);
  Truth result = wanted ? Truth::kFalse : Truth::kError;
  for (std::uint32_t i = 1; i < expression.count; ++i) {
    const Truth part = values::equals(wanted, argument(expression, i), space_);
    if (part == Truth::kTrue) return part;
    if (part == Truth::kError) result = part;
  }
  return result;
}

Truth Evaluator::compare(const plan::Expression& expression) {
  const auto opposite = [](Truth truth) {
    return truth == Truth::kError ? truth : values::truth(truth == Truth::kFalse);
  };
  if (expression.op == Operator::kEqual || expression.op == Operator::kNotEqual) {
    const Id left = leaf(expression, 0);
    const Id right = leaf(expression, 1);
    const Truth same =
        left && right ? values::same_without_values(left, right, space_) : Truth::kError;
    if (same != Truth::kError) return expression.op == Operator::kEqual ? same : opposite(same);
  }
  const Value a = argument(expression, 0);
  if (!a) return Truth::kError;
  const Value b = argument(expression, 1);
  const auto or_equal = [&](Truth truth) {
    return truth == Truth::kFalse ? values::equals(a, b, space_) : truth;
  };
  switch (expression.op) {
    case Operator::kEqual:
      return values::equals(a, b, space_);
    case Operator::kNotEqual:
      return opposite(values::equals(a, b, space_));
    case Operator::kLess:
      return values::less(a, b);
    case Operator::kGreater:
      return values::less(b, a);
    case Operator::kLessOrEqual:
      return or_equal(values::less(a, b));
    default:
      return or_equal(values::less(b, a));
  }
}

// The argument's term if it is a variable or a constant; else the null id.
Id Evaluator::leaf(const plan::Expression& call, std::uint32_t number) const {
  const plan::Expression& argument = plan_->expressions[plan_->arguments[call.first + number]];
  const bool is_leaf = argument.op == Operator::kVariable || argument.op == Operator::kConstant;
  return is_leaf ? slots_[argument.slot] : Id{};
}

Value Evaluator::value(Index index) {
  const plan::Expression& expression = plan_->expressions[index];
  switch (expression.op) {
    case Operator::kConstant:
    case Operator::kVariable:
      return values::value_of(slots_[expression.slot], space_);
    case Operator::kUnbound:
      return Value::error();
    case Operator::kOr:
    case Operator::kAnd:
    case Operator::kNot:
    case Operator::kBound:
    case Operator::kExists:
    case Operator::kNotExists:
    case Operator::kIn:
    case Operator::kNotIn:
    case Operator::kEqual:
    case Operator::kNotEqual:
    case Operator::kLess:
    case Operator::kGreater:
    case Operator::kLessOrEqual:
    case Operator::kGreaterOrEqual:
      return values::value_of(condition(index));
    case Operator::kIf:
      switch (condition(plan_->arguments[expression.first])) {
        case Truth::kTrue:
          return argument(expression, 1);
        case Truth::kFalse:
          return argument(expression, 2);
        case Truth::kError:
          return Value::error();
      }
      return Value::error();
    case Operator::kCoalesce:
      for (std::uint32_t i = 0; i < expression.count; ++i) {
        if (Value result = argument(expression, i)) return result;
      }
      return Value::error();
    case Operator::kAdd:
    case Operator::kSubtract:
    case Operator::kMultiply:
    case Operator::kDivide:
      return values::arithmetic(expression.op, argument(expression, 0), argument(expression, 1));
    case Operator::kPlus: {
      const Value number = argument(expression, 0);
      return number.is_numeric() ? number : Value::error();
    }
    case Operator::kNegate:
      return values::negated(argument(expression, 0));
    default:
      return call_builtin(expression);
  }
}

}  // namespace sinew::rdf::sparql::eval
