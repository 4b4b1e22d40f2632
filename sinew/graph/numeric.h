// The numeric datatypes of XML Schema 1.1 part 2, their lexical forms and values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sinew::graph {

enum class NumericType : std::uint8_t {
  kNone,  // not a numeric datatype
  kDecimal,
  kDouble,
  kFloat,
  kInteger,
  kLong,
  kInt,
  kShort,
  kByte,
  kNonNegativeInteger,
  kPositiveInteger,
  kNonPositiveInteger,
  kNegativeInteger,
  kUnsignedLong,
  kUnsignedInt,
  kUnsignedShort,
  kUnsignedByte,
};

inline bool is_integer(NumericType type) { return type >= NumericType::kInteger; }

// The type of "decimal", "unsignedByte", … (the name behind the namespace of XML Schema).
NumericType numeric_type(std::string_view local_name);

// The value of a literal of this type, rounded to double; empty if the text is not in its lexical
// space or the value is out of its range.
std::optional<double> parse_number(std::string_view lexical, NumericType type);

// The value of an integer literal; empty also when it does not fit in 64 bits.
std::optional<std::int64_t> parse_integer(std::string_view lexical, NumericType type);

// Shortest text of xsd:double that reads back to the same value; INF, -INF, NaN.
std::string double_text(double value);

}  // namespace sinew::graph
