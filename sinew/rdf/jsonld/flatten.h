// Flattening (JSON-LD 1.1 API, section 7): all that a document says about one node in one object,
// references everywhere else, and a label for every blank node.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "sinew/rdf/jsonld/errors.h"
#include "sinew/rdf/jsonld/expanded.h"

namespace sinew::jsonld {

// Collects the nodes of expanded documents by graph and identifier.
class NodeMap {
 public:
  NodeMap(json::Arena& arena, const Source& source);

  // `expanded` is the array that expansion gives.
  void add(const json::Value& expanded);

  // The flattened document, still in expanded form. With `ordered`, nodes and graphs are sorted by
  // their identifiers.
  json::Value flattened(bool ordered);

 private:
  // Where a value goes: into a property of a subject, into a list, or nowhere (the top level).
  struct Site {
    json::Value graph;     // identifier to node
    json::Value subject;   // a node; null at the top level
    json::Value property;  // its key
    json::Value list;      // the array to append to; null when not in a list
    bool reverse = false;  // the value is the subject of the property, `subject` its object
  };

  void add_element(const json::Value& element, const Site& site);
  void add_list(const json::Value& list, const Site& site);
  void add_node(const json::Value& element, const Site& site);
  void add_index(json::Value& node, const json::Value& index);
  void add_reverse(const json::Value& map, const json::Value& node, const Site& site);
  // Unless the property has an equal value already.
  void add_new(json::Value& node, const json::Value& key, const json::Value& value);
  json::Value node_in(json::Value& graph, const json::Value& id);
  json::Value graph_named(const json::Value& id);
  json::Value label(const json::Value& id);  // renames blank nodes
  json::Value new_label(json::Position position);

  json::Arena& arena_;
  Source source_;
  json::Value graphs_;         // name to graph
  json::Value default_graph_;  // identifier to node
  std::unordered_map<std::string_view, std::string_view> labels_;
  // The values of properties that have many, by the address of their array.
  std::unordered_map<const void*, std::unordered_set<std::string>> large_;
  std::size_t next_label_ = 0;
};

}  // namespace sinew::jsonld
