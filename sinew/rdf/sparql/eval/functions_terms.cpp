// Functions on terms (SPARQL 1.1, section 17.4.2), and the table of all functions.
#include <fmt/format.h>

#include "sinew/rdf/iri/iri.h"
#include "sinew/rdf/sparql/eval/state.h"
#include "sinew/rdf/sparql/values/casts.h"
#include "sinew/rdf/sparql/values/operators.h"

namespace sinew::rdf::sparql::eval {

using values::ValueKind;

Value Evaluator::call_builtin(const plan::Expression& call) {
  switch (call.op) {
    case Operator::kIsIri:
    case Operator::kIsBlank:
    case Operator::kIsLiteral:
    case Operator::kIsNumeric:
    case Operator::kSameTerm:
      return test_term(call);
    case Operator::kStr:
    case Operator::kLang:
    case Operator::kDatatype:
      return part_of_term(call);
    case Operator::kIri:
    case Operator::kBnode:
    case Operator::kStrDt:
    case Operator::kStrLang:
    case Operator::kUuid:
    case Operator::kStrUuid:
      return make_term(call);
    case Operator::kStrLen:
    case Operator::kSubStr:
    case Operator::kUCase:
    case Operator::kLCase:
    case Operator::kStrStarts:
    case Operator::kStrEnds:
    case Operator::kContains:
    case Operator::kStrBefore:
    case Operator::kStrAfter:
    case Operator::kEncodeForUri:
    case Operator::kConcat:
    case Operator::kLangMatches:
      return string_function(call);
    case Operator::kRegex:
    case Operator::kReplace:
      return regex_function(call);
    case Operator::kAbs:
    case Operator::kRound:
    case Operator::kCeil:
    case Operator::kFloor:
    case Operator::kRand:
      return number_function(call);
    case Operator::kNow:
    case Operator::kYear:
    case Operator::kMonth:
    case Operator::kDay:
    case Operator::kHours:
    case Operator::kMinutes:
    case Operator::kSeconds:
    case Operator::kTimezone:
    case Operator::kTz:
      return time_function(call);
    case Operator::kMd5:
    case Operator::kSha1:
    case Operator::kSha256:
    case Operator::kSha384:
    case Operator::kSha512:
      return digest_function(call);
    case Operator::kCall:
      return cast_function(call);
    default:
      return Value::error();
  }
}

Value Evaluator::kept_string(std::string_view text, std::string_view language) {
  return Value::of_string(texts_.keep(text), texts_.keep(language));
}

// A term that has just been made.
Value Evaluator::made(Id id) { return values::value_of(id, space_); }

Value Evaluator::test_term(const plan::Expression& call) {
  const Value of = argument(call, 0);
  if (!of) return of;
  switch (call.op) {
    case Operator::kIsIri:
      return Value::of(of.kind == ValueKind::kIri);
    case Operator::kIsBlank:
      return Value::of(of.kind == ValueKind::kBlank);
    case Operator::kIsLiteral:
      return Value::of(of.is_literal());
    case Operator::kIsNumeric:
      return Value::of(of.is_numeric());
    default:
      break;
  }
  const Value other = argument(call, 1);
  if (!other) return other;
  const Id a = values::term_of(of, space_);
  const Id b = values::term_of(other, space_);
  if (of.is_literal() || other.is_literal()) return Value::of(a == b);
  return Value::of(values::same_node(a, b, space_));
}

Value Evaluator::part_of_term(const plan::Expression& call) {
  const Value of = argument(call, 0);
  switch (call.op) {
    case Operator::kStr: {
      std::string buffer;
      const auto text = values::as_text(of, space_, buffer);
      if (!text) return Value::error();
      return buffer.empty() ? Value::of_string(*text) : kept_string(*text);
    }
    case Operator::kLang:
      return of.is_literal() ? Value::of_string(of.language) : Value::error();
    default: {
      if (!of.is_literal()) return Value::error();
      return made(space_.iri(space_.datatype(values::term_of(of, space_))));
    }
  }
}

Value Evaluator::make_term(const plan::Expression& call) {
  switch (call.op) {
    case Operator::kUuid:
      return made(space_.iri("urn:uuid:" + random_uuid()));
    case Operator::kStrUuid:
      return kept_string(random_uuid());
    case Operator::kBnode:
      if (call.count == 0) return made(space_.blank());
      break;
    default:
      break;
  }
  const Value of = argument(call, 0);
  switch (call.op) {
    case Operator::kBnode:
      return of.kind == ValueKind::kString ? made(space_.blank(of.text)) : Value::error();
    case Operator::kIri: {
      if (of.kind == ValueKind::kIri) return of;
      if (of.kind != ValueKind::kString) return Value::error();
      const auto resolved = plan_->base.empty() ? std::string(of.text)
                                                : resolve_iri(of.text, plan_->base).value_or("");
      // A relative IRI without a base, or one with characters that no IRI holds, is an error.
      if (fault_of_iri(resolved)) return Value::error();
      return made(space_.iri(resolved));
    }
    default:
      break;
  }
  const Value second = argument(call, 1);
  if (of.kind != ValueKind::kString) return Value::error();
  if (call.op == Operator::kStrDt) {
    if (second.kind != ValueKind::kIri) return Value::error();
    const std::string_view datatype = values::text_of(second, space_);
    // A literal of this datatype needs a language, which STRDT cannot give.
    if (datatype == values::kRdfLangString) return Value::error();
    return made(space_.literal(of.text, datatype));
  }
  if (second.kind != ValueKind::kString || second.text.empty()) return Value::error();
  return made(space_.literal(of.text, {}, second.text));
}

Value Evaluator::cast_function(const plan::Expression& call) {
  const std::string_view name = space_.text(call.function);
  const values::Datatype to = values::datatype_of(name);
  const bool is_cast = to != values::Datatype::kOther && to != values::Datatype::kLangString &&
                       values::iri_of(to) == name;
  if (!is_cast || call.count != 1) {
    fail(call.offset,
         is_cast ? fmt::format("<{}> takes one argument", name)
                 : fmt::format("there is no function <{}>", name),
         is_cast ? "give it one"
                 : "the functions named by an IRI are the casts, such as xsd:integer");
  }
  std::string buffer;
  Value result = values::cast(argument(call, 0), to, space_, buffer);
  if (!buffer.empty() && result.kind == ValueKind::kString) return kept_string(buffer);
  return result;
}

}  // namespace sinew::rdf::sparql::eval
