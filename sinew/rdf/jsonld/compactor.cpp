#include "sinew/rdf/jsonld/compactor.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "sinew/graph/standard_iris.h"
#include "sinew/rdf/json/reader.h"
#include "sinew/rdf/jsonld/iri_expansion.h"
#include "sinew/rdf/jsonld/rdf_names.h"

namespace sinew::jsonld {
namespace {

bool tells_its_datatype(const json::Value& object, const Context& active,
                        const TermDefinition& term) {
  const json::Value* value = object.find(keyword::kValue);
  const json::Value* type = object.find(keyword::kType);
  if (value == nullptr || type == nullptr || object.members().size() != 2) return false;
  switch (value->kind()) {
    case json::Kind::kBoolean:
      return type->is_string(graph::kXsdBoolean);
    case json::Kind::kNumber: {
      const bool integer = value->text().find_first_of(".eE") == std::string_view::npos;
      return type->is_string(integer ? graph::kXsdInteger : graph::kXsdDouble);
    }
    case json::Kind::kString: {
      const auto none = [](const Setting& of_term, const Setting& of_context) {
        return !(of_term.is_absent() ? of_context : of_term).has_text();
      };
      return type->is_string(graph::kXsdString) && none(term.language, active.language) &&
             none(term.direction, active.direction);
    }
    default:
      return false;
  }
}

}  // namespace

const TermDefinition& Compactor::definition(const Context& active, Property term) const {
  static const TermDefinition kNoTerm;
  const TermDefinition* found = term.empty() ? nullptr : active.terms.find(term);
  return found == nullptr ? kNoTerm : *found;
}

// "Add value" (section 3.2 of the standard's terms): a second value makes an array.
void Compactor::add(json::Value& object, std::string_view key, const json::Value& value,
                    bool as_array) {
  json::Value* values = object.find(key);
  if (as_array && values == nullptr) {
    values = object.add(arena_, json::Value::string(key), json::Value::array(arena_));
  } else if (as_array && !values->is_array()) {
    *values = jsonld::as_array(*values, arena_);
  }
  if (value.is_array()) {
    for (const json::Value& item : value.items()) add(object, key, item, as_array);
  } else if (values == nullptr) {
    object.add(arena_, json::Value::string(key), value);
  } else {
    if (!values->is_array()) *values = jsonld::as_array(*values, arena_);
    values->append(arena_, value);
  }
}

json::Value Compactor::document(const Context* context, const json::Value& expanded,
                                bool always_graph) {
  const json::Value compacted = compact(context, {}, expanded);
  if (compacted.is_object() && !always_graph) return compacted;
  json::Value result = json::Value::object(arena_);
  if (compacted.is_null() || (compacted.is_array() && compacted.items().empty())) return result;
  result.add(arena_, json::Value::string(keyword(*context, keyword::kGraph)),
             jsonld::as_array(compacted, arena_));
  return result;
}

json::Value Compactor::compact(const Context* active, Property property,
                               const json::Value& element) {
  if (element.is_scalar() || element.is_null()) return element;
  if (++depth_ > json::kMaxDepth) {
    fail(code::kLoadingDocumentFailed, {}, "",
         fmt::format("nodes and lists are nested more than {} deep", json::kMaxDepth),
         "a flatter graph");
  }
  const json::Value result = element.is_array() ? compact_array(active, property, element)
                                                : compact_object(active, property, element);
  --depth_;
  return result;
}

json::Value Compactor::compact_array(const Context* active, Property property,
                                     const json::Value& array) {
  json::Value result = json::Value::array(arena_);
  for (const json::Value& item : array.items()) {
    const json::Value compacted = compact(active, property, item);
    if (!compacted.is_null()) result.append(arena_, compacted);
  }
  const bool keep =
      result.items().size() != 1 || !options_.compact_arrays || property == keyword::kGraph ||
      property == keyword::kSet ||
      definition(*active, property).containers.has(Containers::kList | Containers::kSet);
  return keep ? result : result.items()[0];
}

const Context* Compactor::apply_types(const Context* active, const json::Value& types) {
  const Context* type_scoped = active;
  std::vector<std::string_view> terms;
  const auto list = types.is_array() ? types.items() : std::span(&types, 1);
  for (const json::Value& type : list) {
    if (type.is_string()) terms.push_back(compact_iri(*type_scoped, type.text(), true));
  }
  std::sort(terms.begin(), terms.end());
  for (const std::string_view term : terms) {
    const TermDefinition& scope = definition(*type_scoped, term);
    if (!scope.has_context) continue;
    active = contexts_.process(active, scope.context, scope.source,
                               {.override_protected = false, .propagate = false});
  }
  return active;
}

json::Value Compactor::compact_object(const Context* active, Property property,
                                      const json::Value& object) {
  const Context* type_scoped = active;
  const TermDefinition& scope = definition(*active, property);
  const bool only_id = object.members().size() == 1 && object.find(keyword::kId) != nullptr;
  if (active->previous != nullptr && !is_value_object(object) && !only_id) {
    active = active->previous;
  }
  if (scope.has_context) {
    active = contexts_.process(active, scope.context, scope.source,
                               {.override_protected = true, .propagate = true});
  }
  if (is_value_object(object) || object.find(keyword::kId) != nullptr) {
    const json::Value compacted = compact_value(*active, property, object);
    const bool is_json = definition(*active, property).type == keyword::kJson;
    if (compacted.is_scalar() || compacted.is_null() || is_json) return compacted;
  }
  if (is_list_object(object) && definition(*active, property).containers.has(Containers::kList)) {
    return compact(active, property, *object.find(keyword::kList));
  }

  if (const json::Value* types = object.find(keyword::kType)) {
    // The types of a value are datatypes, and have no context.
    if (!is_value_object(object)) {
      type_scoped = active;
      active = apply_types(active, *types);
    }
  }
  Node node{active, type_scoped, property, json::Value::object(arena_)};
  if (options_.ordered) {
    std::vector<const json::Member*> entries;
    for (const json::Member& entry : object.members()) entries.push_back(&entry);
    std::sort(entries.begin(), entries.end(),
              [](const auto* a, const auto* b) { return a->name() < b->name(); });
    for (const json::Member* entry : entries) compact_entry(node, *entry);
  } else {
    for (const json::Member& entry : object.members()) compact_entry(node, entry);
  }
  return node.result;
}

void Compactor::compact_entry(Node& node, const json::Member& entry) {
  const std::string_view name = entry.name();
  const json::Value& value = entry.value;
  const auto put = [&](const json::Value& compacted) {
    node.result.set(arena_, json::Value::string(keyword(*node.active, name)), compacted);
  };
  if (name == keyword::kId) {
    put(value.is_string() ? json::Value::string(compact_iri(*node.active, value.text(), false))
                          : value);
  } else if (name == keyword::kType) {
    compact_types(node, value);
  } else if (name == keyword::kReverse) {
    compact_reverse(node, value);
  } else if (name == keyword::kIndex &&
             definition(*node.active, node.property).containers.has(Containers::kIndex)) {
    return;  // the key of the map that the node goes into
  } else if (name == keyword::kDirection || name == keyword::kIndex || name == keyword::kLanguage ||
             name == keyword::kValue) {
    put(value);
  } else if (value.is_array() && value.items().empty()) {
    const bool reverse = node.property == keyword::kReverse;
    const Property term = compact_iri(*node.active, name, true, &value, reverse);
    add(nest(node, term), term, value, true);
  } else {
    const auto items = value.is_array() ? value.items() : std::span(&value, 1);
    for (const json::Value& item : items) compact_item(node, entry, item);
  }
}

void Compactor::compact_types(Node& node, const json::Value& types) {
  const auto compact_type = [&](const json::Value& type) {
    return type.is_string() ? json::Value::string(compact_iri(*node.type_scoped, type.text(), true))
                            : type;
  };
  json::Value compacted = types;
  if (types.is_array()) {
    compacted = json::Value::array(arena_);
    for (const json::Value& type : types.items()) compacted.append(arena_, compact_type(type));
    if (compacted.items().size() == 1) compacted = compacted.items()[0];
  } else {
    compacted = compact_type(types);
  }
  const std::string_view alias = keyword(*node.active, keyword::kType);
  const bool as_set = definition(*node.active, alias).containers.has(Containers::kSet) &&
                      options_.processing_mode == ProcessingMode::kJsonLd11;
  add(node.result, alias, compacted, as_set || !options_.compact_arrays);
}

void Compactor::compact_reverse(Node& node, const json::Value& map) {
  const json::Value compacted = compact(node.active, keyword::kReverse, map);
  json::Value remaining = json::Value::object(arena_);
  for (const json::Member& member : compacted.members()) {
    const TermDefinition& term = definition(*node.active, member.name());
    if (term.reverse) {
      const bool as_array = term.containers.has(Containers::kSet) || !options_.compact_arrays;
      add(node.result, member.name(), member.value, as_array);
    } else {
      remaining.add(arena_, member.key, member.value);
    }
  }
  if (remaining.members().empty()) return;
  node.result.set(arena_, json::Value::string(keyword(*node.active, keyword::kReverse)), remaining);
}

json::Value& Compactor::nest(Node& node, Property term) {
  const TermDefinition& found = definition(*node.active, term);
  if (found.nest.empty()) return node.result;
  if (expand_iri(*node.active, found.nest, kAsProperty, arena_) != keyword::kNest) {
    fail(code::kInvalidNestValue, place_in(found.source, found.position), "",
         fmt::format("\"{}\" is nested in \"{}\", which is no alias of @nest", term, found.nest),
         "\"@nest\" or an alias of it");
  }
  json::Value* nested = node.result.find(found.nest);
  if (nested == nullptr) {
    nested = node.result.add(arena_, json::Value::string(found.nest), json::Value::object(arena_));
  }
  return *nested;
}

json::Value Compactor::compact_value(const Context& active, Property property,
                                     const json::Value& value) {
  const TermDefinition& term = definition(active, property);
  const json::Value* id = value.find(keyword::kId);
  const json::Value* type = value.find(keyword::kType);
  const json::Value* index = value.find(keyword::kIndex);
  json::Value result = value;
  if (id != nullptr && value.members().size() == (index == nullptr ? 1u : 2u)) {
    if (term.type == keyword::kId && id->is_string()) {
      result = json::Value::string(compact_iri(active, id->text(), false));
    } else if (term.type == keyword::kVocab && id->is_string()) {
      result = json::Value::string(compact_iri(active, id->text(), true));
    }
  } else if (type != nullptr && type->is_string() && type->text() == term.type) {
    return *value.find(keyword::kValue);
  } else if (plain_values_ && term.type.empty() && id == nullptr && index == nullptr &&
             tells_its_datatype(value, active, term)) {
    return *value.find(keyword::kValue);
  } else if (term.type == keyword::kNone || type != nullptr) {
    if (type != nullptr) {
      result = json::Value::object(arena_);
      for (const json::Member& member : value.members())
        result.add(arena_, member.key, member.value);
      json::Value& types = *result.find(keyword::kType);
      const auto compact_type = [&](const json::Value& t) {
        return t.is_string() ? json::Value::string(compact_iri(active, t.text(), true)) : t;
      };
      if (types.is_array()) {
        json::Value list = json::Value::array(arena_);
        for (const json::Value& item : types.items()) list.append(arena_, compact_type(item));
        types = list;
      } else {
        types = compact_type(types);
      }
    }
  } else if (const json::Value* content = value.find(keyword::kValue)) {
    const bool index_goes = index == nullptr || term.containers.has(Containers::kIndex);
    const auto matches = [&](std::string_view key, const Setting& of_term,
                             const Setting& of_context) {
      const Setting& wanted = of_term.is_absent() ? of_context : of_term;
      const json::Value* found = value.find(key);
      if (!wanted.has_text()) return found == nullptr;
      return found != nullptr && language_and_direction(found->text(), {}, arena_) ==
                                     language_and_direction(wanted.text, {}, arena_);
    };
    const bool plain =
        !content->is_string() || (matches(keyword::kLanguage, term.language, active.language) &&
                                  matches(keyword::kDirection, term.direction, active.direction));
    if (plain && index_goes) return *content;
  }
  if (!result.is_object()) return result;
  json::Value renamed = json::Value::object(arena_);
  for (const json::Member& member : result.members()) {
    renamed.add(arena_, json::Value::string(compact_iri(active, member.name(), true)),
                member.value);
  }
  return renamed;
}

}  // namespace sinew::jsonld
