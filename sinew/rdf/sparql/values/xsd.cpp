#include "sinew/rdf/sparql/values/xsd.h"

namespace sinew::rdf::sparql::values {

Datatype datatype_of(std::string_view iri) {
  if (iri == kRdfLangString) return Datatype::kLangString;
  if (!iri.starts_with(kXsd)) return Datatype::kOther;
  struct Row {
    std::string_view name;
    Datatype datatype;
  };
  // The ones that occur most come first.
  static constexpr Row kRows[] = {
      {"string", Datatype::kString},
      {"integer", Datatype::kInteger},
      {"decimal", Datatype::kDecimal},
      {"double", Datatype::kDouble},
      {"boolean", Datatype::kBoolean},
      {"float", Datatype::kFloat},
      {"dateTime", Datatype::kDateTime},
      {"date", Datatype::kDate},
      {"time", Datatype::kTime},
      {"duration", Datatype::kDuration},
      {"dayTimeDuration", Datatype::kDayTimeDuration},
      {"yearMonthDuration", Datatype::kYearMonthDuration},
      {"int", Datatype::kInteger},
      {"long", Datatype::kInteger},
      {"short", Datatype::kInteger},
      {"byte", Datatype::kInteger},
      {"nonNegativeInteger", Datatype::kInteger},
      {"positiveInteger", Datatype::kInteger},
      {"nonPositiveInteger", Datatype::kInteger},
      {"negativeInteger", Datatype::kInteger},
      {"unsignedLong", Datatype::kInteger},
      {"unsignedInt", Datatype::kInteger},
      {"unsignedShort", Datatype::kInteger},
      {"unsignedByte", Datatype::kInteger},
      {"dateTimeStamp", Datatype::kDateTime},
  };
  const std::string_view name = iri.substr(kXsd.size());
  for (const Row& row : kRows) {
    if (row.name == name) return row.datatype;
  }
  return Datatype::kOther;
}

std::string_view iri_of(Datatype datatype) {
  switch (datatype) {
    case Datatype::kString:
      return kXsdString;
    case Datatype::kLangString:
      return kRdfLangString;
    case Datatype::kBoolean:
      return kXsdBoolean;
    case Datatype::kInteger:
      return kXsdInteger;
    case Datatype::kDecimal:
      return kXsdDecimal;
    case Datatype::kFloat:
      return kXsdFloat;
    case Datatype::kDouble:
      return kXsdDouble;
    case Datatype::kDateTime:
      return kXsdDateTime;
    case Datatype::kDate:
      return kXsdDate;
    case Datatype::kTime:
      return kXsdTime;
    case Datatype::kDuration:
      return kXsdDuration;
    case Datatype::kDayTimeDuration:
      return kXsdDayTimeDuration;
    case Datatype::kYearMonthDuration:
      return kXsdYearMonthDuration;
    case Datatype::kOther:
      break;
  }
  return {};
}

}  // namespace sinew::rdf::sparql::values
