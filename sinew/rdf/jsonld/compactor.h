// Compaction (JSON-LD 1.1 API, section 6): the shortest way to write an expanded document with the
// terms of a context.
#pragma once

#include <optional>
#include <string_view>
#include <unordered_map>

#include "sinew/rdf/jsonld/context_processor.h"
#include "sinew/rdf/jsonld/expanded.h"
#include "sinew/rdf/jsonld/inverse_context.h"

namespace sinew::jsonld {

class Compactor {
 public:
  // With `plain_values`, a value that JSON's notation tells the datatype of is written plainly for
  // every term without a type of its own: 1.5 and 1.0 are xsd:double, 1 is xsd:integer.
  explicit Compactor(ContextProcessor& contexts, bool plain_values = false)
      : contexts_(contexts),
        arena_(contexts.arena()),
        options_(contexts.options()),
        plain_values_(plain_values) {}

  // An object, without its "@context". With `always_graph`, its nodes are under "@graph" even if
  // there is only one.
  json::Value document(const Context* context, const json::Value& expanded, bool always_graph);

  // A term, a compact IRI, a relative reference, or the IRI itself. `value` is what the IRI is a
  // property of, where that decides between terms.
  std::string_view compact_iri(const Context& active, std::string_view iri, bool vocab,
                               const json::Value* value = nullptr, bool reverse = false);

 private:
  using Property = std::string_view;

  // The node whose entries are being compacted.
  struct Node {
    const Context* active;
    const Context* type_scoped;
    Property property;
    json::Value result;
  };

  json::Value compact(const Context* active, Property property, const json::Value& element);
  json::Value compact_array(const Context* active, Property property, const json::Value& array);
  json::Value compact_object(const Context* active, Property property, const json::Value& object);
  json::Value compact_value(const Context& active, Property property, const json::Value& value);
  const Context* apply_types(const Context* active, const json::Value& types);

  void compact_entry(Node& node, const json::Member& entry);
  void compact_types(Node& node, const json::Value& types);
  void compact_reverse(Node& node, const json::Value& map);
  void compact_item(Node& node, const json::Member& entry, const json::Value& item);
  void add_list(Node& node, json::Value& result, Property term, const json::Value& item,
                json::Value compacted, bool as_array);
  void add_graph(Node& node, json::Value& result, Property term, const json::Value& item,
                 json::Value compacted, bool as_array);
  void add_to_map(Node& node, json::Value& result, Property term, const json::Value& item,
                  json::Value compacted, bool as_array);
  json::Value take_first(json::Value& object, std::string_view key);
  // Where the property's values go: the node itself, or the object that its "@nest" names.
  json::Value& nest(Node& node, Property term);
  json::Value* map_of(json::Value& result, Property term);

  const TermDefinition& definition(const Context& active, Property term) const;
  const InverseContext& inverse(const Context& active);
  std::string_view select_term(const Context& active, std::string_view iri,
                               const json::Value* value, bool reverse);
  std::string_view keyword(const Context& active, std::string_view keyword) {
    return compact_iri(active, keyword, true);
  }
  void add(json::Value& object, std::string_view key, const json::Value& value, bool as_array);

  ContextProcessor& contexts_;
  json::Arena& arena_;
  const Options& options_;
  bool plain_values_;
  std::unordered_map<const Context*, InverseContext> inverse_;
  std::size_t depth_ = 0;
};

}  // namespace sinew::jsonld
