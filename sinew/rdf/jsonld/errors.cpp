#include "sinew/rdf/jsonld/errors.h"

#include <fmt/format.h>

namespace sinew::jsonld {

Place place_in(const Source& source, json::Position position) {
  return {std::string(source.file), position.line, position.column};
}

void fail(std::string_view code, Place place, std::string iri, std::string what,
          std::string remedy) {
  throw Error(Problem{std::move(place), std::move(iri), std::move(what), std::move(remedy),
                      Severity::kError, std::string(code)});
}

std::string describe(const json::Value& value) {
  switch (value.kind()) {
    case json::Kind::kNull:
      return "null";
    case json::Kind::kBoolean:
      return value.is_true() ? "true" : "false";
    case json::Kind::kNumber:
      return std::string(value.text());
    case json::Kind::kString:
      return fmt::format("\"{}\"", value.text());
    case json::Kind::kArray:
      return "an array";
    case json::Kind::kObject:
      return "an object";
  }
  return {};
}

}  // namespace sinew::jsonld
