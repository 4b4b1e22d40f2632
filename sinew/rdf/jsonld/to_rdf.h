// From expanded form to quads (JSON-LD 1.1 API, section 8), without the detour over a node map: the
// store merges what several objects say about one node.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "sinew/graph/places.h"
#include "sinew/graph/terms.h"
#include "sinew/rdf/json/value.h"
#include "sinew/rdf/jsonld/errors.h"
#include "sinew/rdf/jsonld/model_check.h"
#include "sinew/rdf/jsonld/options.h"

namespace sinew::graph {
struct Quad;
}

namespace sinew::jsonld {

using QuadSink = std::function<void(const graph::Quad&)>;

// How numbers become literals.
enum class Numbers : std::uint8_t {
  // Doubles in the canonical form of XML Schema with at most 16 digits, whatever their datatype.
  kStandard,
  // Doubles in the shortest text that reads back to the same value; xsd:decimal as it is written,
  // or with all digits in the place of an exponent; a number with a point or an exponent is a
  // double even if it is whole.
  kExact,
};

struct ToRdfContext {
  graph::Terms& terms;
  const Options& options;
  Source source;
  Numbers numbers = Numbers::kStandard;
  graph::Places* places = nullptr;  // where it is noted which line said what
  std::uint32_t file = 0;           // the source, in `places`
  ModelCheck* check = nullptr;
};

class ToRdf {
 public:
  ToRdf(const ToRdfContext& context, const QuadSink& sink);

  // `expanded` is the array that expansion gives.
  void document(const json::Value& expanded);

 private:
  graph::Id node(const json::Value& node, graph::Id graph);
  graph::Id node_id(const json::Value& node);
  void node_entries(const json::Value& node, graph::Id subject, graph::Id graph);
  void types(const json::Value& types, graph::Id subject, graph::Id graph);
  void property(std::string_view iri, json::Position position, const json::Value& values,
                graph::Id subject, graph::Id graph);
  void reverse(const json::Value& map, graph::Id subject, graph::Id graph);
  graph::Id object(const json::Value& value, graph::Id graph);
  graph::Id list(const json::Value& items, graph::Id graph);
  graph::Id literal(const json::Value& value);
  graph::Id number_literal(const json::Value& number, std::string_view datatype);
  graph::Id directed_literal(const json::Value& text, std::string_view language,
                             std::string_view direction);
  graph::Id json_literal(const json::Value& value);

  // 0 where the text is no well-formed IRI, which is reported.
  graph::Id iri(std::string_view text, json::Position position, std::string_view role,
                graph::Id subject);
  graph::Id blank(std::string_view label);
  graph::Id predicate(std::string_view text, json::Position position, graph::Id subject);
  void emit(graph::Id subject, graph::Id predicate, graph::Id object, graph::Id graph,
            json::Position position);
  void check_index(const json::Value& node, graph::Id subject);

  ToRdfContext context_;
  const QuadSink& sink_;
  graph::Terms& terms_;
  graph::Id current_graph_;  // in which compound literals are described
  std::unordered_map<std::string_view, graph::Id> blanks_;
  std::unordered_map<std::uint32_t, json::Value> indexes_;  // "@index" of each node that has one
  graph::Id rdf_type_, rdf_first_, rdf_rest_, rdf_nil_;
};

}  // namespace sinew::jsonld
