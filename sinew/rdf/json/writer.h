// JSON as text: in one line, as a person would set it out, or in the canonical form of RFC 8785.
#pragma once

#include <cstddef>
#include <string>

#include "sinew/rdf/json/value.h"

namespace sinew::json {

// Without spaces; numbers as they were written.
std::string to_text(const Value& value);

// Indented; an array or object that fits on the rest of its line and holds nothing nested stays on
// that line. The numbers of a longer array fill lines.
std::string to_pretty_text(const Value& value, std::size_t width = 100);

// The JSON Canonicalization Scheme: keys sorted by UTF-16 code units, numbers as ECMAScript prints
// them (as they were written where no double can hold them: the scheme has nothing for them), no
// spaces.
std::string to_canonical_text(const Value& value);

// A finite number as ECMAScript prints it (ECMA-262, Number::toString).
std::string ecmascript_number(double value);

// With quotes and the shortest escapes.
void append_quoted(std::string& out, std::string_view text);

}  // namespace sinew::json
