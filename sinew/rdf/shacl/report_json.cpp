#include <string>

#include "sinew/rdf/json/writer.h"
#include "sinew/rdf/shacl/report.h"

namespace sinew::rdf::shacl {
namespace {

using json::Value;

class JsonWriter {
 public:
  JsonWriter(const graph::Terms& terms, const graph::Places* places)
      : terms_(terms), places_(places) {}

  std::string write(const ValidationReport& report) {
    Value whole = Value::object(arena_);
    add(whole, "conforms", Value::boolean(report.conforms()));
    add(whole, "results", array(report.results));
    return json::to_pretty_text(whole) + "\n";
  }

 private:
  Value array(const std::vector<Result>& results) {
    Value all = Value::array(arena_);
    for (const Result& result : results) all.append(arena_, write(result));
    return all;
  }

  Value write(const Result& result) {
    Value object = Value::object(arena_);
    add(object, "focusNode", term(result.focus_node));
    if (result.path) add(object, "path", text(to_sparql(*result.path, terms_)));
    if (result.value) add(object, "value", term(result.value));
    add(object, "severity", text(terms_.text(result.severity)));
    add(object, "component", text(terms_.text(result.component_iri)));
    add(object, "shape", term(result.source_shape));
    if (result.source_constraint) add(object, "constraint", term(result.source_constraint));
    if (!result.messages.empty()) {
      Value messages = Value::array(arena_);
      for (const Message& message : result.messages) messages.append(arena_, write(message));
      add(object, "messages", messages);
    }
    add(object, "problem", text(result.what));
    if (!result.remedy.empty()) add(object, "remedy", text(result.remedy));
    add_place(object, result);
    if (!result.details.empty()) add(object, "details", array(result.details));
    return object;
  }

  Value write(const Message& message) {
    Value object = Value::object(arena_);
    add(object, "text", text(message.text));
    if (!message.language.empty()) add(object, "language", text(message.language));
    return object;
  }

  void add_place(Value& object, const Result& result) {
    if (!places_) return;
    const bool single = result.path && result.path->kind == Path::Kind::kPredicate;
    const Place place = places_->find(result.focus_node, single ? result.path->predicate : Id{});
    if (place.file.empty()) return;
    add(object, "file", text(place.file));
    if (place.line > 0) {
      add(object, "line", Value::number(arena_.copy(std::to_string(place.line))));
    }
  }

  Value term(Id id) {
    Value object = Value::object(arena_);
    add(object, "type",
        text(terms_.is_iri(id)     ? "uri"
             : terms_.is_blank(id) ? "bnode"
                                   : "literal"));
    add(object, "value", text(terms_.text(id)));
    if (terms_.is_literal(id)) {
      const std::string_view language = terms_.language(id);
      if (language.empty()) {
        add(object, "datatype", text(terms_.text(terms_.datatype(id))));
      } else {
        add(object, "xml:lang", text(language));
      }
    }
    return object;
  }

  Value text(std::string_view characters) { return Value::string(arena_.copy(characters)); }
  void add(Value& object, std::string_view key, Value value) {
    object.add(arena_, Value::string(key), value);
  }

  const graph::Terms& terms_;
  const graph::Places* places_;
  json::Arena arena_;
};

}  // namespace

std::string to_json(const ValidationReport& report, const graph::Terms& terms,
                    const graph::Places* places) {
  return JsonWriter(terms, places).write(report);
}

}  // namespace sinew::rdf::shacl
