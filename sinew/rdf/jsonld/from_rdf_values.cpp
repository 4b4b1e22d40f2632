// From RDF terms to values (JSON-LD 1.1 API, section 8.5), and literals that are described by
// triples.
#include <array>
#include <charconv>
#include <cmath>

#include "sinew/graph/standard_iris.h"
#include "sinew/rdf/iri/characters.h"
#include "sinew/rdf/json/reader.h"
#include "sinew/rdf/json/writer.h"
#include "sinew/rdf/jsonld/errors.h"
#include "sinew/rdf/jsonld/from_rdf.h"
#include "sinew/rdf/jsonld/rdf_names.h"

namespace sinew::jsonld {

using graph::Id;

json::Value FromRdf::identifier(Id id) {
  if (terms_.is_blank(id)) return text(arena_.concat("_:", terms_.text(id)));
  return text(terms_.text(id));
}

namespace {

// The text of a whole number as a double: "1.0", so that it is not taken for an integer.
std::string double_number(double value) {
  if (value == 0) return std::signbit(value) ? "-0.0" : "0.0";
  std::string result = json::ecmascript_number(value);
  if (result.find_first_of(".e") == std::string::npos) result += ".0";
  return result;
}

}  // namespace

void FromRdf::typed_native(json::Value& result, Id id) {
  const std::string_view lexical = terms_.text(id);
  const std::string_view datatype = terms_.text(terms_.datatype(id));
  json::Value value = text(lexical);
  if (datatype == graph::kXsdBoolean && (lexical == "true" || lexical == "false")) {
    value = json::Value::boolean(lexical == "true");
  } else if (const std::optional<double> number = terms_.number(id)) {
    if (datatype == graph::kXsdDouble && std::isfinite(*number)) {
      value = json::Value::number(arena_.copy(double_number(*number)));
    } else if (datatype != graph::kXsdDouble && json::is_number(lexical)) {
      value = json::Value::number(lexical);
    }
  }
  result.add(arena_, keyword_value(keyword::kValue), value);
  result.add(arena_, keyword_value(keyword::kType), text(datatype));
}

json::Value FromRdf::object(Id id) {
  json::Value result = json::Value::object(arena_);
  if (terms_.is_literal(id)) {
    literal(result, id);
  } else {
    result.add(arena_, keyword_value(keyword::kId), identifier(id));
  }
  return result;
}

void FromRdf::literal(json::Value& result, Id id) {
  const std::string_view lexical = terms_.text(id);
  const std::string_view datatype = terms_.text(terms_.datatype(id));
  const std::string_view language = terms_.language(id);
  if (style_.typed_native_values && language.empty() && datatype != rdf_name::kJson) {
    return typed_native(result, id);
  }
  if (options_.use_native_types && native(result, lexical, datatype)) return;
  if (directed(result, lexical, datatype)) return;
  if (datatype == rdf_name::kJson && options_.processing_mode == ProcessingMode::kJsonLd11) {
    try {
      result.add(arena_, keyword_value(keyword::kValue),
                 json::read_into(lexical, "a JSON literal", arena_));
    } catch (const Error& error) {
      fail(code::kInvalidJsonLiteral, {}, "", error.problems().front().what,
           "valid JSON in every literal of type rdf:JSON");
    }
    result.add(arena_, keyword_value(keyword::kType), keyword_value(keyword::kJson));
    return;
  }
  result.add(arena_, keyword_value(keyword::kValue), text(lexical));
  if (!language.empty()) {
    result.add(arena_, keyword_value(keyword::kLanguage), text(language));
  } else if (datatype != graph::kXsdString) {
    result.add(arena_, keyword_value(keyword::kType), text(datatype));
  }
}

// As a JSON number or boolean, if the literal has exactly that value.
bool FromRdf::native(json::Value& result, std::string_view lexical, std::string_view datatype) {
  json::Value value;
  if (datatype == graph::kXsdBoolean && (lexical == "true" || lexical == "false")) {
    value = json::Value::boolean(lexical == "true");
  } else if (datatype == graph::kXsdInteger || datatype == graph::kXsdDouble) {
    double number = 0;
    std::string_view digits = lexical;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool whole_text = end.ptr == digits.data() + digits.size() && !digits.empty();
    const bool plain = digits.find_first_not_of("0123456789-") == std::string_view::npos;
    if (end.ec != std::errc() || !whole_text || !std::isfinite(number)) return false;
    if (datatype == graph::kXsdInteger && !plain) return false;
    value = json::Value::number(arena_.copy(json::ecmascript_number(number)));
  } else {
    return false;
  }
  result.add(arena_, keyword_value(keyword::kValue), value);
  return true;
}

bool FromRdf::directed(json::Value& result, std::string_view lexical, std::string_view datatype) {
  if (options_.rdf_direction != RdfDirection::kI18nDatatype ||
      !datatype.starts_with(rdf_name::kI18n)) {
    return false;
  }
  const std::string_view name = datatype.substr(rdf_name::kI18n.size());
  const std::size_t underscore = name.find('_');
  result.add(arena_, keyword_value(keyword::kValue), text(lexical));
  if (underscore != 0 && !name.empty()) {
    result.add(arena_, keyword_value(keyword::kLanguage), text(name.substr(0, underscore)));
  }
  if (underscore != std::string_view::npos) {
    result.add(arena_, keyword_value(keyword::kDirection), text(name.substr(underscore + 1)));
  }
  return true;
}

// A node with rdf:value, rdf:direction and perhaps rdf:language, used once, is a string.
void FromRdf::make_compound_literals(Graph& graph) {
  for (const Id id : graph.compound_literals) {
    const Usage* usage = only_usage(graph, id);
    const auto found = graph.nodes.find(id);
    if (usage == nullptr || found == graph.nodes.end()) continue;
    const auto value_of = [&](std::string_view property) -> const json::Value* {
      const json::Value* values = found->second.find(property);
      if (values == nullptr || values->items().empty()) return nullptr;
      return values->items()[0].find(keyword::kValue);
    };
    const json::Value* text = value_of(rdf_name::kValue);
    const json::Value* language = value_of(rdf_name::kLanguage);
    const json::Value* direction = value_of(rdf_name::kDirection);
    if (text == nullptr || direction == nullptr) continue;
    if (language != nullptr && !rdf::is_language_tag(language->text())) {
      fail(code::kInvalidLanguageTaggedString, {}, "", "rdf:language is " + describe(*language),
           "a language tag");
    }
    if (!direction->is_string("ltr") && !direction->is_string("rtl")) {
      fail(code::kInvalidBaseDirection, {}, "", "rdf:direction is " + describe(*direction),
           "\"ltr\" or \"rtl\"");
    }
    json::Value value = usage->value;
    value.erase(keyword::kId);
    value.add(arena_, keyword_value(keyword::kValue), *text);
    if (language != nullptr) value.add(arena_, keyword_value(keyword::kLanguage), *language);
    value.add(arena_, keyword_value(keyword::kDirection), *direction);
    graph.nodes.erase(id);
  }
}

}  // namespace sinew::jsonld
