#include "sinew/rdf/jsonld/expander.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sinew/rdf/jsonld/iri_expansion.h"

namespace sinew::jsonld {
namespace {

bool is_top_level(std::string_view property) {
  return property.data() == nullptr || property == keyword::kGraph;
}

bool only_entry(const json::Value& object, std::string_view key) {
  return object.members().size() == 1 && object.find(key) != nullptr;
}

}  // namespace

void Expander::fail_at(std::string_view error_code, const Node& node, const json::Value& at,
                       std::string what, std::string remedy) const {
  fail(error_code, place_in(source_, at.position()), node_iri(node), std::move(what),
       std::move(remedy));
}

std::string Expander::node_iri(const Node& node) const {
  if (const json::Value* id = node.result.find(keyword::kId)) return std::string(id->text());
  for (const json::Member& member : node.element->members()) {
    if (!member.value.is_string()) continue;
    if (iri(*node.active, member.name(), kAsProperty) != keyword::kId) continue;
    return std::string(iri(*node.active, member.value.text(), kAsId));
  }
  return {};
}

std::string Expander::blamed_node() const {
  const bool known = innermost_ != nullptr && check_ != nullptr && check_->wants_details();
  return known ? node_iri(*innermost_) : std::string();
}

bool Expander::means_something(const Context& active, std::string_view text) const {
  return is_iri_or_blank_node(iri(active, text, kAsProperty));
}

std::vector<const json::Member*> Expander::sorted(const json::Value& object) const {
  std::vector<const json::Member*> result;
  for (const json::Member& member : object.members()) result.push_back(&member);
  // UTF-8 sorts like the code points that it stands for.
  std::sort(result.begin(), result.end(),
            [](const json::Member* a, const json::Member* b) { return a->name() < b->name(); });
  return result;
}

std::vector<const json::Member*> Expander::members(const json::Value& object) const {
  if (options_.ordered) return sorted(object);
  std::vector<const json::Member*> result;
  for (const json::Member& member : object.members()) result.push_back(&member);
  return result;
}

json::Value Expander::document(const Context* context, const json::Value& document) {
  json::Value result = expand(context, {}, document);
  if (only_entry(result, keyword::kGraph)) result = *result.find(keyword::kGraph);
  if (result.is_null()) return json::Value::array(arena_, document.position());
  return as_array(result, arena_);
}

json::Value Expander::expand(const Context* active, Property property, const json::Value& element,
                             bool from_map) {
  switch (element.kind()) {
    case json::Kind::kNull:
      return element;
    case json::Kind::kArray:
      return expand_array(active, property, element, from_map);
    case json::Kind::kObject:
      return expand_object(active, property, element, from_map);
    default:
      return expand_scalar(active, property, element);
  }
}

const Context* Expander::apply_scoped(const Context* active, const TermDefinition* definition,
                                      bool override_protected, bool propagate) {
  if (definition == nullptr || !definition->has_context) return active;
  return contexts_.process(active, definition->context, definition->source,
                           {override_protected, propagate});
}

json::Value Expander::expand_scalar(const Context* active, Property property,
                                    const json::Value& scalar) {
  if (is_top_level(property)) {
    if (check_ != nullptr) {
      check_->dropped_value(source_, scalar, blamed_node(),
                            fmt::format("{} stands where a node is expected", describe(scalar)),
                            "an object, with the value in one of its properties");
    }
    return {};
  }
  active = apply_scoped(active, active->terms.find(property), true, true);
  return expand_value(*active, property, scalar);
}

json::Value Expander::expand_array(const Context* active, Property property,
                                   const json::Value& array, bool from_map) {
  const TermDefinition* definition =
      property.data() == nullptr ? nullptr : active->terms.find(property);
  const bool in_list = definition != nullptr && definition->containers.has(Containers::kList);
  json::Value result = json::Value::array(arena_, array.position());
  for (const json::Value& item : array.items()) {
    json::Value expanded = expand(active, property, item, from_map);
    if (in_list && expanded.is_array()) {
      json::Value list = json::Value::object(arena_, item.position());
      list.add(arena_, keyword_value(keyword::kList), expanded);
      expanded = list;
    }
    if (expanded.is_array()) {
      for (const json::Value& value : expanded.items()) result.append(arena_, value);
    } else if (!expanded.is_null()) {
      result.append(arena_, expanded);
    }
  }
  return result;
}

// A context that does not propagate ends at the next node object; values and references to nodes
// are none.
bool Expander::keeps_previous_context(const Context& active, const json::Value& object) const {
  if (active.previous == nullptr) return false;
  for (const json::Member& member : object.members()) {
    const std::string_view key = iri(active, member.name(), kAsProperty);
    if (key == keyword::kValue) return false;
    if (key == keyword::kId && object.members().size() == 1) return false;
  }
  return true;
}

// The contexts of all types of the node apply, each on top of the one before, in the order of the
// types' names.
const Context* Expander::apply_types(const Context* active, const json::Value& object) {
  const Context* type_scoped = active;
  std::vector<const json::Member*> type_entries;
  for (const json::Member& member : object.members()) {
    if (iri(*active, member.name(), kAsProperty) == keyword::kType) type_entries.push_back(&member);
  }
  std::sort(type_entries.begin(), type_entries.end(),
            [](const json::Member* a, const json::Member* b) { return a->name() < b->name(); });
  for (const json::Member* entry : type_entries) {
    std::vector<std::string_view> types;
    if (entry->value.is_string()) types.push_back(entry->value.text());
    for (const json::Value& type : entry->value.items()) {
      if (type.is_string()) types.push_back(type.text());
    }
    std::sort(types.begin(), types.end());
    for (const std::string_view type : types) {
      active = apply_scoped(active, type_scoped->terms.find(type), false, false);
    }
  }
  return active;
}

// By the last value of the first entry that means @type.
bool Expander::is_json_literal(const Context& active, const json::Value& object) const {
  const json::Member* first = nullptr;
  for (const json::Member& member : object.members()) {
    if (first != nullptr && first->name() < member.name()) continue;
    if (iri(active, member.name(), kAsProperty) == keyword::kType) first = &member;
  }
  if (first == nullptr) return false;
  const json::Value* type = &first->value;
  if (type->is_array() && !type->items().empty()) type = &type->items().back();
  return type->is_string() && iri(active, type->text(), kAsProperty) == keyword::kJson;
}

json::Value Expander::expand_object(const Context* active, Property property,
                                    const json::Value& object, bool from_map) {
  const TermDefinition* scope = property.data() == nullptr ? nullptr : active->terms.find(property);
  if (!from_map && keeps_previous_context(*active, object)) active = active->previous;
  active = apply_scoped(active, scope, true, true);
  if (const json::Value* local = object.find(keyword::kContext)) {
    active = contexts_.process(active, *local, source_);
  }
  const Context* type_scoped = active;
  active = apply_types(active, object);

  Node node{active, type_scoped, property, &object, json::Value::object(arena_, object.position())};
  expand_entries(node);
  return finish(node);
}

void Expander::expand_entries(Node& node) {
  const Node* const outer = std::exchange(innermost_, &node);
  std::vector<const json::Member*> nests;
  const auto expand_entry = [&](const json::Member& entry) {
    if (entry.name() == keyword::kContext) return;
    const std::string_view key = iri(*node.active, entry.name(), kAsProperty);
    if (is_keyword(key)) {
      if (key == keyword::kNest) {
        nests.push_back(&entry);
      } else {
        expand_keyword(node, key, entry);
      }
    } else if (key.find(':') != std::string_view::npos) {
      expand_property(node, key, entry);
    } else if (check_ != nullptr) {
      // A term that a context maps to null is left out on purpose.
      const TermDefinition* definition = node.active->terms.find(entry.name());
      if (definition == nullptr || !definition->iri.empty()) {
        check_->undefined_key(*node.active, source_, entry.key, blamed_node());
      }
    }
  };
  if (options_.ordered) {
    for (const json::Member* entry : sorted(*node.element)) expand_entry(*entry);
  } else {
    for (const json::Member& entry : node.element->members()) expand_entry(entry);
  }
  if (!nests.empty()) expand_nests(node, nests);
  innermost_ = outer;
}

// The properties of a nested object belong to the node itself.
void Expander::expand_nests(Node& node, const std::vector<const json::Member*>& nests) {
  for (const json::Member* nest : nests) {
    const auto values = nest->value.is_array() ? nest->value.items() : std::span(&nest->value, 1);
    for (const json::Value& value : values) {
      const Context* active =
          apply_scoped(node.active, node.active->terms.find(nest->name()), true, true);
      const bool has_value = std::any_of(
          value.members().begin(), value.members().end(), [&](const json::Member& member) {
            return iri(*active, member.name(), kAsProperty) == keyword::kValue;
          });
      if (!value.is_object() || has_value) {
        fail_at(code::kInvalidNestValue, node, value,
                fmt::format("\"{}\" holds {}", nest->name(),
                            has_value ? "a value object" : describe(value)),
                "an object with properties of the node");
      }
      Node inner = node;  // shares the result
      inner.active = active;
      inner.property = nest->name();
      inner.element = &value;
      expand_entries(inner);
    }
  }
}

json::Value Expander::finish(Node& node) {
  json::Value& result = node.result;
  if (result.find(keyword::kValue) != nullptr) {
    const json::Value value = finish_value_object(node);
    if (value.is_null()) return value;
  } else if (json::Value* type = result.find(keyword::kType)) {
    *type = as_array(*type, arena_);
  } else if (result.find(keyword::kSet) != nullptr || result.find(keyword::kList) != nullptr) {
    const json::Value value = finish_set_or_list(node);
    if (!value.is_object()) return value;
  }
  if (only_entry(result, keyword::kLanguage)) return {};
  if (!is_top_level(node.property)) return result;

  const bool empty = result.members().empty();
  const bool free_value =
      result.find(keyword::kValue) != nullptr || result.find(keyword::kList) != nullptr;
  if (empty || free_value || only_entry(result, keyword::kId)) {
    if (check_ != nullptr && free_value) {
      check_->dropped_value(source_, *node.element, blamed_node(),
                            "a value stands where a node is expected",
                            "the value in a property of a node");
    }
    return {};
  }
  return result;
}

json::Value Expander::finish_value_object(Node& node) {
  json::Value& result = node.result;
  const json::Value* type = result.find(keyword::kType);
  const json::Value* language = result.find(keyword::kLanguage);
  const json::Value* direction = result.find(keyword::kDirection);
  for (const json::Member& member : result.members()) {
    const std::string_view name = member.name();
    if (name == keyword::kDirection || name == keyword::kIndex || name == keyword::kLanguage ||
        name == keyword::kType || name == keyword::kValue) {
      continue;
    }
    fail_at(code::kInvalidValueObject, node, member.key,
            fmt::format("\"{}\" beside \"@value\"", name),
            "only @type, @language, @direction and @index");
  }
  if (type != nullptr && (language != nullptr || direction != nullptr)) {
    fail_at(code::kInvalidValueObject, node, *node.element,
            "\"@type\" beside \"@language\" or \"@direction\"", "one or the other");
  }
  const json::Value& value = *result.find(keyword::kValue);
  if (type != nullptr && type->is_string(keyword::kJson)) return result;
  if (value.is_null() || (value.is_array() && value.items().empty())) return {};
  if (!value.is_string() && language != nullptr) {
    fail_at(code::kInvalidLanguageTaggedValue, node, value,
            fmt::format("{} has a language", describe(value)), "a string");
  }
  if (type != nullptr && (!type->is_string() || rdf::fault_of_iri(type->text()))) {
    fail_at(code::kInvalidTypedValue, node, *node.element,
            fmt::format("the datatype of a value is {}", describe(*type)), "one IRI");
  }
  return result;
}

json::Value Expander::finish_set_or_list(Node& node) {
  const bool both = node.result.find(keyword::kSet) != nullptr && is_list_object(node.result);
  for (const json::Member& member : node.result.members()) {
    const std::string_view name = member.name();
    const bool container = name == keyword::kSet || name == keyword::kList;
    if ((container && !both) || name == keyword::kIndex) continue;
    fail_at(code::kInvalidSetOrListObject, node, member.key,
            fmt::format("\"{}\" beside \"@set\" or \"@list\"", name), "only \"@index\"");
  }
  if (const json::Value* set = node.result.find(keyword::kSet)) return *set;
  return node.result;
}

json::Value Expander::expand_value(const Context& active, Property property,
                                   const json::Value& value) {
  const TermDefinition* term = active.terms.find(property);
  const std::string_view type = term == nullptr ? std::string_view{} : term->type;
  json::Value result = json::Value::object(arena_, value.position());
  if (value.is_string() && (type == keyword::kId || type == keyword::kVocab)) {
    const bool vocab = type == keyword::kVocab;
    const std::string_view id = iri(active, value.text(), vocab ? kAsType : kAsId);
    if (check_ != nullptr) {
      if (vocab && !means_something(active, value.text())) {
        check_->undefined_term(active, source_, value, "value", blamed_node());
      } else if (!vocab && !is_iri_or_blank_node(id)) {
        check_->relative_id(source_, value, blamed_node());
      }
    }
    result.add(arena_, keyword_value(keyword::kId),
               id.data() == nullptr ? json::Value() : json::Value::string(id, value.position()));
    return result;
  }
  result.add(arena_, keyword_value(keyword::kValue), value);
  if (!type.empty() && type != keyword::kId && type != keyword::kVocab && type != keyword::kNone) {
    result.add(arena_, keyword_value(keyword::kType), json::Value::string(type));
  } else if (value.is_string()) {
    const Setting& language =
        term == nullptr || term->language.is_absent() ? active.language : term->language;
    const Setting& direction =
        term == nullptr || term->direction.is_absent() ? active.direction : term->direction;
    if (language.has_text()) {
      result.add(arena_, keyword_value(keyword::kLanguage), json::Value::string(language.text));
    }
    if (direction.has_text()) {
      result.add(arena_, keyword_value(keyword::kDirection), json::Value::string(direction.text));
    }
  }
  return result;
}

}  // namespace sinew::jsonld
