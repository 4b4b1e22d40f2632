// Expansion of the entries of a node whose key is a property (steps 13.5 to 13.14), with the maps
// that a term's @container turns values into.
#include <fmt/format.h>

#include "sinew/rdf/jsonld/expander.h"
#include "sinew/rdf/jsonld/iri_expansion.h"

namespace sinew::jsonld {

void Expander::expand_property(Node& node, std::string_view property, const json::Member& entry) {
  static constexpr TermDefinition kNoTerm;
  const TermDefinition* definition = node.active->terms.find(entry.name());
  const TermDefinition& term = definition == nullptr ? kNoTerm : *definition;
  const json::Value& value = entry.value;
  const json::Value key = json::Value::string(property, entry.key.position());

  json::Value expanded;
  if (term.type == keyword::kJson) {
    expanded = json::Value::object(arena_, value.position());
    expanded.add(arena_, keyword_value(keyword::kValue), value);
    expanded.add(arena_, keyword_value(keyword::kType), keyword_value(keyword::kJson));
  } else if (value.is_object() && term.containers.has(Containers::kLanguage)) {
    expanded = expand_language_map(node, term, value);
  } else if (value.is_object() &&
             term.containers.has(Containers::kIndex | Containers::kType | Containers::kId)) {
    expanded = expand_index_map(node, entry.name(), term, value);
  } else {
    expanded = expand(node.active, entry.name(), value);
  }
  if (expanded.is_null()) return;

  if (term.containers.has(Containers::kList) && !is_list_object(expanded)) {
    json::Value list = json::Value::object(arena_, value.position());
    list.add(arena_, keyword_value(keyword::kList), as_array(expanded, arena_));
    expanded = list;
  }
  if (term.containers.has(Containers::kGraph) &&
      !term.containers.has(Containers::kId | Containers::kIndex)) {
    expanded = as_graph_objects(expanded);
  }
  if (term.reverse) {
    add_reverse(node, key, expanded);
  } else {
    add_value(node.result, key, expanded, arena_);
  }
}

json::Value Expander::as_graph_objects(const json::Value& values) {
  json::Value result = json::Value::array(arena_, values.position());
  for (const json::Value& value : as_array(values, arena_).items()) {
    json::Value graph = json::Value::object(arena_, value.position());
    graph.add(arena_, keyword_value(keyword::kGraph), as_array(value, arena_));
    result.append(arena_, graph);
  }
  return result;
}

json::Value Expander::expand_language_map(Node& node, const TermDefinition& term,
                                          const json::Value& map) {
  const Setting& direction = term.direction.is_absent() ? node.active->direction : term.direction;
  json::Value result = json::Value::array(arena_, map.position());
  for (const json::Member* entry : members(map)) {
    const bool none = iri(*node.active, entry->name(), kAsProperty) == keyword::kNone;
    const auto items = entry->value.is_array() ? entry->value.items() : std::span(&entry->value, 1);
    for (const json::Value& item : items) {
      if (item.is_null()) continue;
      if (!item.is_string()) {
        fail_at(code::kInvalidLanguageMapValue, node, item,
                fmt::format("a map by language holds {}", describe(item)), "strings");
      }
      json::Value value = json::Value::object(arena_, item.position());
      value.add(arena_, keyword_value(keyword::kValue), item);
      if (!none) value.add(arena_, keyword_value(keyword::kLanguage), entry->key);
      if (direction.has_text()) {
        value.add(arena_, keyword_value(keyword::kDirection), json::Value::string(direction.text));
      }
      result.append(arena_, value);
    }
  }
  return result;
}

json::Value Expander::expand_index_map(Node& node, Property key, const TermDefinition& term,
                                       const json::Value& map) {
  json::Value result = json::Value::array(arena_, map.position());
  for (const json::Member* entry : members(map)) {
    const json::Value items = expand_index_entry(node, key, term, *entry);
    for (const json::Value& item : items.items()) result.append(arena_, item);
  }
  return result;
}

json::Value Expander::expand_index_entry(Node& node, Property key, const TermDefinition& term,
                                         const json::Member& entry) {
  const bool by_index = term.containers.has(Containers::kIndex);
  const bool by_id = term.containers.has(Containers::kId);
  const bool by_type = term.containers.has(Containers::kType);
  const Context* context = node.active;
  if ((by_id || by_type) && context->previous != nullptr) context = context->previous;
  if (by_type) {
    context = apply_scoped(context, context->terms.find(entry.name()), false, true);
  }
  const std::string_view index = iri(*node.active, entry.name(), kAsProperty);
  const bool none = index == keyword::kNone;
  const auto text = [&](std::string_view value) {
    return json::Value::string(value, entry.key.position());
  };

  json::Value result = json::Value::array(arena_, entry.value.position());
  const json::Value values = as_array(entry.value, arena_);
  const json::Value expanded = as_array(expand(context, key, values, /*from_map=*/true), arena_);
  for (json::Value item : expanded.items()) {
    if (term.containers.has(Containers::kGraph) && !is_graph_object(item)) {
      json::Value graph = json::Value::object(arena_, item.position());
      graph.add(arena_, keyword_value(keyword::kGraph), as_array(item, arena_));
      item = graph;
    }
    if (by_index && !term.index.empty() && !none) {
      add_index_property(node, term, entry.key, item);
    } else if (by_index && !none && item.find(keyword::kIndex) == nullptr) {
      item.add(arena_, keyword_value(keyword::kIndex), entry.key);
    } else if (by_id && !none && item.find(keyword::kId) == nullptr) {
      const std::string_view id = iri(*node.active, entry.name(), kAsId);
      if (check_ != nullptr && !is_iri_or_blank_node(id)) {
        check_->relative_id(source_, entry.key, std::string(id));
      }
      item.add(arena_, keyword_value(keyword::kId), text(id));
    } else if (by_type && !none) {
      json::Value types = json::Value::array(arena_, entry.key.position());
      const std::string_view type = iri(*node.active, entry.name(), kAsType);
      if (check_ != nullptr && !means_something(*node.active, entry.name())) {
        check_->undefined_term(*node.active, source_, entry.key, "type", blamed_node());
      }
      types.append(arena_, text(type));
      if (const json::Value* earlier = item.find(keyword::kType)) {
        for (const json::Value& type_of_item : as_array(*earlier, arena_).items()) {
          types.append(arena_, type_of_item);
        }
      }
      item.set(arena_, keyword_value(keyword::kType), types);
    }
    result.append(arena_, item);
  }
  return result;
}

// The key of the map becomes the first value of the property that the term's "@index" names.
void Expander::add_index_property(Node& node, const TermDefinition& term, const json::Value& index,
                                  json::Value& item) {
  const std::string_view property = iri(*node.active, term.index, kAsProperty);
  json::Value values = json::Value::array(arena_, index.position());
  values.append(arena_, expand_value(*node.active, term.index, index));
  if (const json::Value* earlier = item.find(property)) {
    for (const json::Value& value : as_array(*earlier, arena_).items()) {
      values.append(arena_, value);
    }
  }
  item.set(arena_, json::Value::string(property, index.position()), values);
  if (is_value_object(item)) {
    fail_at(code::kInvalidValueObject, node, index,
            "a map by property holds a value, which cannot have properties", "node objects");
  }
}

}  // namespace sinew::jsonld
