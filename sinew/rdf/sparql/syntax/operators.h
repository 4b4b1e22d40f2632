// The operators and functions of SPARQL expressions (sections 17.3, 17.4, 18.5.1), and the table by
// which the parser knows the ones that have a name.
#pragma once

#include <cstdint>
#include <string_view>

namespace sinew::rdf::sparql {

enum class Operator : std::uint8_t {
  // Leaves.
  kConstant,
  kVariable,
  kUnbound,
  // Forms that look at their arguments' errors themselves.
  kOr,
  kAnd,
  kNot,
  kBound,
  kIf,
  kCoalesce,
  kIn,
  kNotIn,
  kExists,
  kNotExists,
  // Comparison and arithmetic.
  kEqual,
  kNotEqual,
  kLess,
  kGreater,
  kLessOrEqual,
  kGreaterOrEqual,
  kSameTerm,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kPlus,
  kNegate,
  // Terms.
  kIsIri,
  kIsBlank,
  kIsLiteral,
  kIsNumeric,
  kStr,
  kLang,
  kDatatype,
  kIri,
  kBnode,
  kStrDt,
  kStrLang,
  kUuid,
  kStrUuid,
  // Strings.
  kStrLen,
  kSubStr,
  kUCase,
  kLCase,
  kStrStarts,
  kStrEnds,
  kContains,
  kStrBefore,
  kStrAfter,
  kEncodeForUri,
  kConcat,
  kLangMatches,
  kRegex,
  kReplace,
  // Numbers.
  kAbs,
  kRound,
  kCeil,
  kFloor,
  kRand,
  // Times.
  kNow,
  kYear,
  kMonth,
  kDay,
  kHours,
  kMinutes,
  kSeconds,
  kTimezone,
  kTz,
  // Digests.
  kMd5,
  kSha1,
  kSha256,
  kSha384,
  kSha512,
  // A function named by an IRI; its first argument is that IRI as a constant.
  kCall,
  // Aggregates.
  kCount,
  kSum,
  kMinimum,
  kMaximum,
  kAverage,
  kSample,
  kGroupConcat,
};

constexpr bool is_aggregate(Operator op) { return op >= Operator::kCount; }

struct Builtin {
  std::string_view name;  // in capitals
  Operator op;
  std::uint8_t minimum_arguments;
  std::uint8_t maximum_arguments;
};
inline constexpr std::uint8_t kAnyNumber = 255;

// Null when no function has this name.
const Builtin* find_builtin(std::string_view name_in_capitals);
// For messages and explanations: "STRLEN", "+", "count".
std::string_view name_of(Operator op);

}  // namespace sinew::rdf::sparql
