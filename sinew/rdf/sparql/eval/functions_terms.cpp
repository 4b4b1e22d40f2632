// Functions on terms (SPARQL 1.1, section 17.4.2).
#include "sinew/rdf/sparql/eval/state.h"

namespace sinew::rdf::sparql::eval {

Value Evaluator::call_builtin(const plan::Expression& expression) {
  using values::ValueKind;
  switch (expression.op) {
    case Operator::kIsIri:
    case Operator::kIsBlank:
    case Operator::kIsLiteral: {
      const Value of = argument(expression, 0);
      if (!of) return of;
      if (expression.op == Operator::kIsIri) return Value::of(of.kind == ValueKind::kIri);
      if (expression.op == Operator::kIsBlank) return Value::of(of.kind == ValueKind::kBlank);
      return Value::of(of.is_literal());
    }
    case Operator::kSameTerm: {
      const Value a = argument(expression, 0);
      const Value b = argument(expression, 1);
      if (!a || !b) return Value::error();
      return Value::of(values::term_of(a, space_) == values::term_of(b, space_));
    }
    default:
      return Value::error();
  }
}

}  // namespace sinew::rdf::sparql::eval
