// From quads to expanded form (JSON-LD 1.1 API, section 8.4): one object for every subject of every
// graph, well-formed lists as lists.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "sinew/graph/terms.h"
#include "sinew/rdf/jsonld/expanded.h"
#include "sinew/rdf/jsonld/options.h"

namespace sinew::graph {
struct Quad;
}

namespace sinew::jsonld {

// What goes beyond the standard, for documents that people read.
struct FromRdfStyle {
  // Numbers and booleans in JSON's notation, and every value with its datatype beside it, so that
  // the terms of a context can be chosen by datatype. Numbers keep their value, and xsd:decimal its
  // text.
  bool typed_native_values = false;
  // A blank node that is used once is written where it is used, without a label.
  bool embed_blank_nodes = false;
};

// Blank nodes are embedded in each other up to this depth; deeper ones get labels.
inline constexpr std::size_t kMaxEmbedding = 40;

class FromRdf {
 public:
  FromRdf(const graph::Terms& terms, const Options& options, json::Arena& arena,
          FromRdfStyle style = {});

  // No quad may come twice. Throws Error where lists are nested deeper than a JSON document may be
  // (json::kMaxDepth). Nodes come in the order in which the quads first mention them; with
  // Options::ordered, sorted by their identifiers.
  json::Value document(std::span<const graph::Quad> quads);

 private:
  // A value that refers to a node: the node and the property that it is a value of, and the value
  // itself, which becomes a list if it turns out to be one.
  struct Usage {
    graph::Id graph;
    graph::Id subject;
    graph::Id property;
    json::Value value;
  };
  struct Graph {
    graph::Id name;
    std::vector<graph::Id> order;
    std::unordered_map<graph::Id, json::Value> nodes;
    std::vector<Usage> ends;  // usages of rdf:nil
    std::vector<graph::Id> compound_literals;
    // Of a list's cells, which are no nodes any more: the subject that has the list as a value.
    std::unordered_map<graph::Id, graph::Id> holder;
  };
  // The only usage of a blank node so far; empty when there are several.
  using OnlyUsage = std::optional<Usage>;

  Graph& graph(graph::Id name);
  json::Value node(Graph& graph, graph::Id id);
  void add(const graph::Quad& quad);
  void make_lists(Graph& graph);
  void make_compound_literals(Graph& graph);
  void embed(Graph& graph);
  void embed_into(Graph& graph, graph::Id node, const Usage& usage);
  const Usage* only_usage(const Graph& graph, graph::Id node) const;
  // The node in whose lists a cell has ended up.
  static graph::Id home(Graph& graph, graph::Id cell);
  bool is_list_cell(const json::Value& node) const;
  json::Value nodes_of(const Graph& graph);
  json::Value document_of_graphs();

  json::Value identifier(graph::Id id);
  json::Value object(graph::Id id);
  void literal(json::Value& result, graph::Id id);
  void typed_native(json::Value& result, graph::Id id);
  bool native(json::Value& result, std::string_view lexical, std::string_view datatype);
  bool directed(json::Value& result, std::string_view lexical, std::string_view datatype);
  json::Value text(std::string_view text) { return json::Value::string(text); }

  const graph::Terms& terms_;
  const Options& options_;
  json::Arena& arena_;
  FromRdfStyle style_;
  std::vector<Graph> graphs_;  // the default graph first
  std::unordered_map<graph::Id, std::size_t> graph_index_;
  std::unordered_map<graph::Id, OnlyUsage> usages_;
  graph::Id rdf_type_, rdf_rest_, rdf_nil_, rdf_direction_;
};

}  // namespace sinew::jsonld
