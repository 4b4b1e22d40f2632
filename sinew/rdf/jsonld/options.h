// The options of the JSON-LD 1.1 API (section 9.3), by its names and with its defaults.
#pragma once

#include <string>

#include "sinew/rdf/json/value.h"

namespace sinew::jsonld {

enum class ProcessingMode : std::uint8_t { kJsonLd10, kJsonLd11 };

// How the base direction of a string is written in RDF, which has no place for it.
enum class RdfDirection : std::uint8_t { kNone, kI18nDatatype, kCompoundLiteral };

struct Options {
  std::string base;  // the base IRI where it is not the document's own
  bool compact_arrays = true;
  bool compact_to_relative = true;
  json::Value expand_context;  // null: none
  bool ordered = false;
  ProcessingMode processing_mode = ProcessingMode::kJsonLd11;
  bool produce_generalized_rdf = false;
  RdfDirection rdf_direction = RdfDirection::kNone;
  bool use_native_types = false;
  bool use_rdf_type = false;
};

}  // namespace sinew::jsonld
