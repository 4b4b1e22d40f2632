#include "sinew/rdf/sparql/syntax/operators.h"

#include <algorithm>

namespace sinew::rdf::sparql {
namespace {

using enum Operator;

// Sorted by name.
constexpr Builtin kBuiltins[] = {
    {"ABS", kAbs, 1, 1},
    {"AVG", kAverage, 1, 1},
    {"BNODE", kBnode, 0, 1},
    {"BOUND", kBound, 1, 1},
    {"CEIL", kCeil, 1, 1},
    {"COALESCE", kCoalesce, 0, kAnyNumber},
    {"CONCAT", kConcat, 0, kAnyNumber},
    {"CONTAINS", kContains, 2, 2},
    {"COUNT", kCount, 1, 1},
    {"DATATYPE", kDatatype, 1, 1},
    {"DAY", kDay, 1, 1},
    {"ENCODE_FOR_URI", kEncodeForUri, 1, 1},
    {"FLOOR", kFloor, 1, 1},
    {"GROUP_CONCAT", kGroupConcat, 1, 1},
    {"HOURS", kHours, 1, 1},
    {"IF", kIf, 3, 3},
    {"IRI", Operator::kIri, 1, 1},
    {"ISBLANK", kIsBlank, 1, 1},
    {"ISIRI", kIsIri, 1, 1},
    {"ISLITERAL", kIsLiteral, 1, 1},
    {"ISNUMERIC", kIsNumeric, 1, 1},
    {"ISURI", kIsIri, 1, 1},
    {"LANG", kLang, 1, 1},
    {"LANGMATCHES", kLangMatches, 2, 2},
    {"LCASE", kLCase, 1, 1},
    {"MAX", kMaximum, 1, 1},
    {"MD5", kMd5, 1, 1},
    {"MIN", kMinimum, 1, 1},
    {"MINUTES", kMinutes, 1, 1},
    {"MONTH", kMonth, 1, 1},
    {"NOW", kNow, 0, 0},
    {"RAND", kRand, 0, 0},
    {"REGEX", kRegex, 2, 3},
    {"REPLACE", kReplace, 3, 4},
    {"ROUND", kRound, 1, 1},
    {"SAMETERM", kSameTerm, 2, 2},
    {"SAMPLE", kSample, 1, 1},
    {"SECONDS", kSeconds, 1, 1},
    {"SHA1", kSha1, 1, 1},
    {"SHA256", kSha256, 1, 1},
    {"SHA384", kSha384, 1, 1},
    {"SHA512", kSha512, 1, 1},
    {"STR", kStr, 1, 1},
    {"STRAFTER", kStrAfter, 2, 2},
    {"STRBEFORE", kStrBefore, 2, 2},
    {"STRDT", kStrDt, 2, 2},
    {"STRENDS", kStrEnds, 2, 2},
    {"STRLANG", kStrLang, 2, 2},
    {"STRLEN", kStrLen, 1, 1},
    {"STRSTARTS", kStrStarts, 2, 2},
    {"STRUUID", kStrUuid, 0, 0},
    {"SUBSTR", kSubStr, 2, 3},
    {"SUM", kSum, 1, 1},
    {"TIMEZONE", kTimezone, 1, 1},
    {"TZ", kTz, 1, 1},
    {"UCASE", kUCase, 1, 1},
    {"URI", Operator::kIri, 1, 1},
    {"UUID", kUuid, 0, 0},
    {"YEAR", kYear, 1, 1},
};

}  // namespace

const Builtin* find_builtin(std::string_view name) {
  const auto less = [](const Builtin& builtin, std::string_view key) { return builtin.name < key; };
  const Builtin* found = std::lower_bound(std::begin(kBuiltins), std::end(kBuiltins), name, less);
  return found != std::end(kBuiltins) && found->name == name ? found : nullptr;
}

std::string_view name_of(Operator op) {
  switch (op) {
    case kConstant:
      return "constant";
    case kVariable:
      return "variable";
    case kUnbound:
      return "unbound";
    case kOr:
      return "||";
    case kAnd:
      return "&&";
    case kNot:
      return "!";
    case kIn:
      return "IN";
    case kNotIn:
      return "NOT IN";
    case kExists:
      return "EXISTS";
    case kNotExists:
      return "NOT EXISTS";
    case kEqual:
      return "=";
    case kNotEqual:
      return "!=";
    case kLess:
      return "<";
    case kGreater:
      return ">";
    case kLessOrEqual:
      return "<=";
    case kGreaterOrEqual:
      return ">=";
    case kAdd:
      return "+";
    case kSubtract:
      return "-";
    case kMultiply:
      return "*";
    case kDivide:
      return "/";
    case kPlus:
      return "+";
    case kNegate:
      return "-";
    case kCall:
      return "call";
    default:
      break;
  }
  for (const Builtin& builtin : kBuiltins) {
    if (builtin.op == op) return builtin.name;
  }
  return "?";
}

}  // namespace sinew::rdf::sparql
