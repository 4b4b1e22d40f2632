// Compaction of the values of a property, and the maps that a term's @container makes of them (step
// 12.8).
#include <fmt/format.h>

#include "sinew/rdf/jsonld/compactor.h"
#include "sinew/rdf/jsonld/iri_expansion.h"

namespace sinew::jsonld {

void Compactor::compact_item(Node& node, const json::Member& entry, const json::Value& item) {
  const bool reverse = node.property == keyword::kReverse;
  const Property term = compact_iri(*node.active, entry.name(), true, &item, reverse);
  json::Value& result = nest(node, term);
  const Containers container = definition(*node.active, term).containers;
  const bool as_array = container.has(Containers::kSet) || term == keyword::kGraph ||
                        term == keyword::kList || !options_.compact_arrays;
  const bool is_list = is_list_object(item);
  const bool is_graph = !is_list && is_graph_object(item);
  const json::Value& content = is_list    ? *item.find(keyword::kList)
                               : is_graph ? *item.find(keyword::kGraph)
                                          : item;
  const json::Value compacted = compact(node.active, term, content);
  constexpr std::uint8_t kMaps =
      Containers::kLanguage | Containers::kIndex | Containers::kId | Containers::kType;
  if (is_list) {
    add_list(node, result, term, item, compacted, as_array);
  } else if (is_graph) {
    add_graph(node, result, term, item, compacted, as_array);
  } else if (container.has(kMaps) && !container.has(Containers::kGraph)) {
    add_to_map(node, result, term, item, compacted, as_array);
  } else {
    add(result, term, compacted, as_array);
  }
}

void Compactor::add_list(Node& node, json::Value& result, Property term, const json::Value& item,
                         json::Value compacted, bool as_array) {
  const json::Value items = jsonld::as_array(compacted, arena_);
  if (definition(*node.active, term).containers.has(Containers::kList)) {
    if (options_.processing_mode == ProcessingMode::kJsonLd10 && result.find(term) != nullptr) {
      fail(code::kCompactionToListOfLists, {}, "",
           fmt::format("the property \"{}\" has two lists", term), "one list");
    }
    result.set(arena_, json::Value::string(term), items);
    return;
  }
  json::Value list = json::Value::object(arena_);
  list.add(arena_, json::Value::string(keyword(*node.active, keyword::kList)), items);
  if (const json::Value* index = item.find(keyword::kIndex)) {
    list.add(arena_, json::Value::string(keyword(*node.active, keyword::kIndex)), *index);
  }
  add(result, term, list, as_array);
}

json::Value* Compactor::map_of(json::Value& result, Property term) {
  if (json::Value* map = result.find(term)) return map;
  return result.add(arena_, json::Value::string(term), json::Value::object(arena_));
}

void Compactor::add_graph(Node& node, json::Value& result, Property term, const json::Value& item,
                          json::Value compacted, bool as_array) {
  const Context& active = *node.active;
  const Containers container = definition(active, term).containers;
  const json::Value* id = item.find(keyword::kId);
  const json::Value* index = item.find(keyword::kIndex);
  if (container.has(Containers::kGraph) && container.has(Containers::kId)) {
    const std::string_view key =
        id == nullptr ? keyword(active, keyword::kNone) : compact_iri(active, id->text(), false);
    add(*map_of(result, term), key, compacted, as_array);
  } else if (container.has(Containers::kGraph) && container.has(Containers::kIndex) &&
             is_simple_graph_object(item)) {
    const std::string_view key = index == nullptr ? keyword(active, keyword::kNone) : index->text();
    add(*map_of(result, term), key, compacted, as_array);
  } else if (container.has(Containers::kGraph) && is_simple_graph_object(item)) {
    // Several nodes of one graph; written plainly they would be read as several graphs.
    if (compacted.is_array() && compacted.items().size() > 1) {
      json::Value included = json::Value::object(arena_);
      included.add(arena_, json::Value::string(keyword(active, keyword::kIncluded)), compacted);
      compacted = included;
    }
    add(result, term, compacted, as_array);
  } else {
    json::Value graph = json::Value::object(arena_);
    graph.add(arena_, json::Value::string(keyword(active, keyword::kGraph)), compacted);
    if (id != nullptr && id->is_string()) {
      graph.add(arena_, json::Value::string(keyword(active, keyword::kId)),
                json::Value::string(compact_iri(active, id->text(), false)));
    }
    if (index != nullptr) {
      graph.add(arena_, json::Value::string(keyword(active, keyword::kIndex)), *index);
    }
    add(result, term, graph, as_array);
  }
}

// Removes the first value of a property and returns it; null if there is none, or if it is not a
// string.
json::Value Compactor::take_first(json::Value& object, std::string_view key) {
  const json::Value* values = object.find(key);
  if (values == nullptr) return {};
  const json::Value all = jsonld::as_array(*values, arena_);
  if (all.items().empty() || !all.items()[0].is_string()) return {};
  const json::Value first = all.items()[0];
  object.erase(key);
  for (const json::Value& value : all.items().subspan(1)) add(object, key, value, false);
  return first;
}

void Compactor::add_to_map(Node& node, json::Value& result, Property term, const json::Value& item,
                           json::Value compacted, bool as_array) {
  const Context& active = *node.active;
  const TermDefinition& found = definition(active, term);
  const auto text_of = [&](std::string_view key) {
    const json::Value* value = item.find(key);
    return value == nullptr ? std::string_view{} : value->text();
  };
  std::string_view key;
  bool has_key = false;
  const auto use = [&](const json::Value& value) {
    has_key = value.is_string();
    key = value.text();
  };
  if (found.containers.has(Containers::kLanguage)) {
    if (const json::Value* value = item.find(keyword::kValue)) compacted = *value;
    key = text_of(keyword::kLanguage);
    has_key = item.find(keyword::kLanguage) != nullptr;
  } else if (found.containers.has(Containers::kIndex) && found.index.empty()) {
    key = text_of(keyword::kIndex);
    has_key = item.find(keyword::kIndex) != nullptr;
  } else if (found.containers.has(Containers::kIndex)) {
    const std::string_view property = expand_iri(active, found.index, kAsProperty, arena_);
    for (const json::Member& member : compacted.members()) {
      if (expand_iri(active, member.name(), kAsProperty, arena_) != property) continue;
      use(take_first(compacted, member.name()));
      break;
    }
  } else if (found.containers.has(Containers::kId)) {
    const std::string_view alias = keyword(active, keyword::kId);
    if (const json::Value* id = compacted.find(alias)) {
      use(*id);
      compacted.erase(alias);
    }
  } else if (found.containers.has(Containers::kType)) {
    use(take_first(compacted, keyword(active, keyword::kType)));
    const auto members = compacted.members();
    if (members.size() == 1 &&
        expand_iri(active, members[0].name(), kAsProperty, arena_) == keyword::kId) {
      json::Value reference = json::Value::object(arena_);
      reference.add(arena_, keyword_value(keyword::kId), *item.find(keyword::kId));
      compacted = compact(node.active, term, reference);
    }
  }
  if (!has_key) key = keyword(active, keyword::kNone);
  add(*map_of(result, term), key, compacted, as_array);
}

}  // namespace sinew::jsonld
