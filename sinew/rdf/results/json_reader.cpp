// Result sets from JSON.
#include <fmt/format.h>

#include "sinew/rdf/iri/characters.h"
#include "sinew/rdf/iri/iri.h"
#include "sinew/rdf/json/reader.h"
#include "sinew/rdf/results/codecs.h"
#include "sinew/rdf/turtle/blank_scope.h"

namespace sinew::rdf {
namespace {

using graph::Id;
using json::Value;

class JsonReader {
 public:
  JsonReader(std::string_view file, graph::Terms& terms)
      : file_(file), terms_(terms), blanks_(terms) {}

  ResultSet read(const Value& root) {
    const Value& head = member(root, "head", "the results");
    if (const Value* vars = head.find("vars")) {
      for (const Value& name : list(*vars, "\"vars\"")) {
        builder_.add_column(string(name, "a variable"), place(name));
      }
    }
    if (const Value* boolean = root.find("boolean")) {
      if (!boolean->is_boolean()) fail(*boolean, "\"boolean\" is neither true nor false");
      builder_.set_boolean(boolean->is_true(), place(*boolean));
    }
    const Value* results = root.find("results");
    if (results != nullptr) {
      if (root.find("boolean") != nullptr) fail(root, "there are both \"results\" and \"boolean\"");
      const Value& bindings = member(*results, "bindings", "\"results\"");
      for (const Value& row : list(bindings, "\"bindings\"")) solution(row);
    }
    return builder_.finish(place(root), results != nullptr);
  }

 private:
  void solution(const Value& row) {
    if (!row.is_object()) fail(row, "a solution is not an object");
    builder_.add_row(place(row));
    for (const json::Member& binding : row.members()) {
      const std::size_t column = builder_.column(binding.name(), place(binding.key));
      builder_.bind(column, term(binding.value), place(binding.key));
    }
  }

  Id term(const Value& value) {
    const std::string_view type = string(member(value, "type", "a term"), "\"type\"");
    const Value& content = member(value, "value", "a term");
    const std::string_view text = string(content, "\"value\"");
    if (type == "uri") {
      if (const auto fault = fault_of_iri(text)) fail(content, *fault);
      return terms_.iri(text);
    }
    if (type == "bnode") return blanks_.node(text);
    // "typed-literal" was the name in the working drafts, and is still written.
    if (type != "literal" && type != "typed-literal") {
      fail(value, fmt::format("\"{}\" is no type of terms", type));
    }
    const Value* language = value.find("xml:lang");
    const Value* datatype = value.find("datatype");
    if (language != nullptr) {
      const std::string_view tag = string(*language, "\"xml:lang\"");
      if (!is_language_tag(tag)) fail(*language, fmt::format("\"{}\" is no language tag", tag));
      return terms_.literal(text, {}, tag);
    }
    if (datatype == nullptr) return terms_.literal(text);
    const std::string_view iri = string(*datatype, "\"datatype\"");
    if (const auto fault = fault_of_iri(iri)) fail(*datatype, *fault);
    return terms_.literal(text, iri);
  }

  const Value& member(const Value& object, std::string_view name, const char* what) {
    const Value* found = object.find(name);
    if (found == nullptr) fail(object, fmt::format("{} has no member \"{}\"", what, name));
    return *found;
  }

  std::span<const Value> list(const Value& value, const char* what) {
    if (!value.is_array()) fail(value, fmt::format("{} is not an array", what));
    return value.items();
  }

  std::string_view string(const Value& value, const char* what) {
    if (!value.is_string()) fail(value, fmt::format("{} is not a string", what));
    return value.text();
  }

  Place place(const Value& value) const {
    return {file_, value.position().line, value.position().column};
  }

  [[noreturn]] void fail(const Value& value, std::string what) {
    fail_at(place(value), std::move(what),
            "write what SPARQL 1.1 Query Results JSON Format asks for");
  }

  std::string file_;
  graph::Terms& terms_;
  BlankScope blanks_;
  ResultBuilder builder_;
};

}  // namespace

ResultSet read_json(std::string_view text, std::string_view file, graph::Terms& terms) {
  const json::Document document = json::read(text, file);
  return JsonReader(file, terms).read(document.root);
}

}  // namespace sinew::rdf
