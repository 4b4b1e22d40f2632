// The datatypes that expressions compute with.
#pragma once

#include <cstdint>
#include <string_view>

#include "sinew/graph/standard_iris.h"

namespace sinew::rdf::sparql::values {

using graph::kRdfLangString;
using graph::kXsd;
using graph::kXsdBoolean;
using graph::kXsdDecimal;
using graph::kXsdDouble;
using graph::kXsdInteger;
using graph::kXsdString;
inline constexpr std::string_view kXsdFloat = "http://www.w3.org/2001/XMLSchema#float";
inline constexpr std::string_view kXsdDateTime = "http://www.w3.org/2001/XMLSchema#dateTime";
inline constexpr std::string_view kXsdDate = "http://www.w3.org/2001/XMLSchema#date";
inline constexpr std::string_view kXsdTime = "http://www.w3.org/2001/XMLSchema#time";
inline constexpr std::string_view kXsdDuration = "http://www.w3.org/2001/XMLSchema#duration";
inline constexpr std::string_view kXsdDayTimeDuration =
    "http://www.w3.org/2001/XMLSchema#dayTimeDuration";
inline constexpr std::string_view kXsdYearMonthDuration =
    "http://www.w3.org/2001/XMLSchema#yearMonthDuration";

enum class Datatype : std::uint8_t {
  kOther,
  kString,
  kLangString,
  kBoolean,
  kInteger,
  kDecimal,
  kFloat,
  kDouble,
  kDateTime,
  kDate,
  kTime,
  kDuration,
  kDayTimeDuration,
  kYearMonthDuration,
};

// Subtypes of xsd:integer are kInteger; all that is not listed is kOther.
Datatype datatype_of(std::string_view iri);
// Of any but kOther.
std::string_view iri_of(Datatype datatype);

}  // namespace sinew::rdf::sparql::values
