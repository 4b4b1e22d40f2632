// Expansion (JSON-LD 1.1 API, section 5): every term becomes the IRI that it stands for, every
// value an object that says all about itself, and no context is left. Values keep the positions of
// what they were made from.
#pragma once

#include <string_view>
#include <vector>

#include "sinew/rdf/jsonld/context_processor.h"
#include "sinew/rdf/jsonld/expanded.h"
#include "sinew/rdf/jsonld/model_check.h"

namespace sinew::jsonld {

class Expander {
 public:
  // `source` is the document's. With a check, what the standard would drop is reported to it.
  Expander(ContextProcessor& contexts, const Source& source, ModelCheck* check = nullptr)
      : contexts_(contexts),
        arena_(contexts.arena()),
        options_(contexts.options()),
        source_(source),
        check_(check) {}

  // The expanded document: always an array.
  json::Value document(const Context* context, const json::Value& document);

 private:
  // A null view (data() == nullptr) stands for no property.
  using Property = std::string_view;

  // One node on its way into expanded form. `element` changes while nested ("@nest") objects are
  // unfolded into the same result.
  struct Node {
    const Context* active;
    const Context* type_scoped;
    Property property;  // that the node is a value of
    const json::Value* element;
    json::Value result;
  };

  json::Value expand(const Context* active, Property property, const json::Value& element,
                     bool from_map = false);
  json::Value expand_scalar(const Context* active, Property property, const json::Value& scalar);
  json::Value expand_array(const Context* active, Property property, const json::Value& array,
                           bool from_map);
  json::Value expand_object(const Context* active, Property property, const json::Value& object,
                            bool from_map);
  json::Value expand_value(const Context& active, Property property, const json::Value& value);

  bool keeps_previous_context(const Context& active, const json::Value& object) const;
  const Context* apply_scoped(const Context* active, const TermDefinition* definition,
                              bool override_protected, bool propagate);
  const Context* apply_types(const Context* active, const json::Value& object);
  bool is_json_literal(const Context& active, const json::Value& object) const;

  void expand_entries(Node& node);
  void expand_nests(Node& node, const std::vector<const json::Member*>& nests);
  json::Value finish(Node& node);
  json::Value finish_value_object(Node& node);
  json::Value finish_set_or_list(Node& node);

  // Entries whose key is a keyword.
  void expand_keyword(Node& node, std::string_view keyword, const json::Member& entry);
  json::Value expand_id(Node& node, const json::Value& value);
  json::Value expand_types(Node& node, const json::Value& value);
  json::Value expand_included(Node& node, const json::Value& value);
  void expand_value_entry(Node& node, const json::Member& entry);
  void expand_reverse(Node& node, const json::Member& entry);

  // Entries whose key is a property.
  void expand_property(Node& node, std::string_view iri, const json::Member& entry);
  json::Value expand_language_map(Node& node, const TermDefinition& term, const json::Value& map);
  json::Value expand_index_map(Node& node, Property key, const TermDefinition& term,
                               const json::Value& map);
  json::Value expand_index_entry(Node& node, Property key, const TermDefinition& term,
                                 const json::Member& entry);
  void add_index_property(Node& node, const TermDefinition& term, const json::Value& index,
                          json::Value& item);
  void add_reverse(Node& node, const json::Value& iri, const json::Value& values);
  json::Value as_graph_objects(const json::Value& values);

  // The members of an object: in code point order where the standard or the options ask for it.
  std::vector<const json::Member*> sorted(const json::Value& object) const;
  std::vector<const json::Member*> members(const json::Value& object) const;

  std::string_view iri(const Context& active, std::string_view text, IriUse use) const {
    return expand_iri(active, text, use, arena_);
  }
  // True when the text is a term, a compact IRI or an IRI, and not merely relative to the document.
  bool means_something(const Context& active, std::string_view text) const;
  // For messages: the IRI of a node, of the node whose entries are being expanded.
  std::string node_iri(const Node& node) const;
  std::string blamed_node() const;
  [[noreturn]] void fail_at(std::string_view code, const Node& node, const json::Value& at,
                            std::string what, std::string remedy) const;
  bool json_ld_10() const { return options_.processing_mode == ProcessingMode::kJsonLd10; }

  ContextProcessor& contexts_;
  json::Arena& arena_;
  const Options& options_;
  Source source_;
  ModelCheck* check_;
  const Node* innermost_ = nullptr;  // whose entries are being expanded
};

}  // namespace sinew::jsonld
