// Expansion of the entries of a node whose key is a keyword or an alias of one (step 13.4).
#include <fmt/format.h>

#include "sinew/rdf/jsonld/expander.h"
#include "sinew/rdf/jsonld/iri_expansion.h"

namespace sinew::jsonld {

void Expander::expand_keyword(Node& node, std::string_view key, const json::Member& entry) {
  const json::Value& value = entry.value;
  if (node.property == keyword::kReverse) {
    fail_at(code::kInvalidReversePropertyMap, node, entry.key,
            fmt::format("\"{}\" inside \"@reverse\"", entry.name()), "properties only");
  }
  const bool may_repeat = (key == keyword::kIncluded || key == keyword::kType) && !json_ld_10();
  if (node.result.find(key) != nullptr && !may_repeat) {
    fail_at(code::kCollidingKeywords, node, entry.key, fmt::format("\"{}\" a second time", key),
            "each keyword once, aliases included");
  }

  json::Value expanded;
  if (key == keyword::kId) {
    expanded = expand_id(node, value);
  } else if (key == keyword::kType) {
    expanded = expand_types(node, value);
  } else if (key == keyword::kGraph) {
    expanded = as_array(expand(node.active, keyword::kGraph, value), arena_);
    if (expanded.items().size() == 1 && expanded.items()[0].is_null()) {
      expanded = json::Value::array(arena_, value.position());
    }
  } else if (key == keyword::kIncluded) {
    if (json_ld_10()) return;
    expanded = expand_included(node, value);
  } else if (key == keyword::kValue) {
    expand_value_entry(node, entry);
    return;
  } else if (key == keyword::kLanguage) {
    if (!value.is_string()) {
      fail_at(code::kInvalidLanguageTaggedString, node, value,
              fmt::format("\"@language\" is {}", describe(value)), "a language tag");
    }
    expanded = value;
  } else if (key == keyword::kDirection) {
    if (json_ld_10()) return;
    if (!value.is_string("ltr") && !value.is_string("rtl")) {
      fail_at(code::kInvalidBaseDirection, node, value,
              fmt::format("\"@direction\" is {}", describe(value)), "\"ltr\" or \"rtl\"");
    }
    expanded = value;
  } else if (key == keyword::kIndex) {
    if (!value.is_string()) {
      fail_at(code::kInvalidIndexValue, node, value,
              fmt::format("\"@index\" is {}", describe(value)), "a string");
    }
    expanded = value;
  } else if (key == keyword::kList) {
    const bool free = node.property.data() == nullptr || node.property == keyword::kGraph;
    if (free) {
      if (check_ != nullptr) {
        check_->dropped_value(source_, value, blamed_node(),
                              "a list stands where a node is expected",
                              "the list in a property of a node");
      }
      return;
    }
    expanded = expand(node.active, node.property, value);
    expanded = expanded.is_null() ? json::Value::array(arena_, value.position())
                                  : as_array(expanded, arena_);
  } else if (key == keyword::kSet) {
    expanded = expand(node.active, node.property, value);
  } else if (key == keyword::kReverse) {
    expand_reverse(node, entry);
    return;
  }
  // An "@id" that means nothing stays: the node is not one without identifier.
  if (!expanded.is_null() || key == keyword::kId) {
    node.result.set(arena_, json::Value::string(key, entry.key.position()), expanded);
  }
}

json::Value Expander::expand_id(Node& node, const json::Value& value) {
  if (!value.is_string()) {
    fail_at(code::kInvalidIdValue, node, value, fmt::format("\"@id\" is {}", describe(value)),
            "one IRI");
  }
  const std::string_view id = iri(*node.active, value.text(), kAsId);
  if (check_ != nullptr && !is_iri_or_blank_node(id))
    check_->relative_id(source_, value, std::string(id));
  if (id.data() == nullptr) return {};
  return json::Value::string(id, value.position());
}

json::Value Expander::expand_types(Node& node, const json::Value& value) {
  const auto expand_type = [&](const json::Value& type) -> json::Value {
    if (!type.is_string()) {
      fail_at(code::kInvalidTypeValue, node, type, fmt::format("\"@type\" is {}", describe(type)),
              "a term or an IRI, or an array of them");
    }
    const std::string_view expanded = iri(*node.type_scoped, type.text(), kAsType);
    if (check_ != nullptr && expanded != keyword::kJson &&
        !means_something(*node.type_scoped, type.text())) {
      check_->undefined_term(*node.type_scoped, source_, type, "type", blamed_node());
    }
    if (expanded.data() == nullptr) return {};
    return json::Value::string(expanded, type.position());
  };
  json::Value types;
  if (value.is_array()) {
    types = json::Value::array(arena_, value.position());
    for (const json::Value& type : value.items()) {
      const json::Value expanded = expand_type(type);
      if (!expanded.is_null()) types.append(arena_, expanded);
    }
  } else {
    types = expand_type(value);
  }
  const json::Value* earlier = node.result.find(keyword::kType);
  if (earlier == nullptr || types.is_null()) return types;
  json::Value all = json::Value::array(arena_, value.position());
  for (const json::Value& type : as_array(*earlier, arena_).items()) all.append(arena_, type);
  for (const json::Value& type : as_array(types, arena_).items()) all.append(arena_, type);
  return all;
}

json::Value Expander::expand_included(Node& node, const json::Value& value) {
  const json::Value expanded = as_array(expand(node.active, {}, value), arena_);
  for (const json::Value& item : expanded.items()) {
    if (is_node_object(item)) continue;
    fail_at(code::kInvalidIncludedValue, node, value, "\"@included\" holds what is not a node",
            "node objects");
  }
  const json::Value* earlier = node.result.find(keyword::kIncluded);
  if (earlier == nullptr) return expanded;
  json::Value all = json::Value::array(arena_, value.position());
  for (const json::Value& item : earlier->items()) all.append(arena_, item);
  for (const json::Value& item : expanded.items()) all.append(arena_, item);
  return all;
}

// Unlike other entries, a null is kept: whether there is an @value decides what @type means.
void Expander::expand_value_entry(Node& node, const json::Member& entry) {
  const json::Value& value = entry.value;
  const bool json_literal = is_json_literal(*node.active, *node.element) && !json_ld_10();
  if (!json_literal && !value.is_scalar() && !value.is_null()) {
    fail_at(code::kInvalidValueObjectValue, node, value,
            fmt::format("\"@value\" is {}", describe(value)),
            "a string, a number, true, false or null");
  }
  node.result.set(arena_, json::Value::string(keyword::kValue, entry.key.position()), value);
}

void Expander::expand_reverse(Node& node, const json::Member& entry) {
  if (!entry.value.is_object()) {
    fail_at(code::kInvalidReverseValue, node, entry.value,
            fmt::format("\"@reverse\" is {}", describe(entry.value)), "an object with properties");
  }
  json::Value expanded = expand(node.active, keyword::kReverse, entry.value);
  // Reversed twice is not reversed.
  if (const json::Value* twice = expanded.find(keyword::kReverse)) {
    for (const json::Member& member : twice->members()) {
      add_value(node.result, member.key, member.value, arena_);
    }
  }
  for (const json::Member& member : expanded.members()) {
    if (member.name() != keyword::kReverse) add_reverse(node, member.key, member.value);
  }
}

void Expander::add_reverse(Node& node, const json::Value& iri, const json::Value& values) {
  json::Value* map = node.result.find(keyword::kReverse);
  if (map == nullptr) {
    map = node.result.add(arena_, json::Value::string(keyword::kReverse, iri.position()),
                          json::Value::object(arena_, iri.position()));
  }
  for (const json::Value& value : as_array(values, arena_).items()) {
    if (is_value_object(value) || is_list_object(value)) {
      fail_at(code::kInvalidReversePropertyValue, node, value,
              fmt::format("the reverse of <{}> holds a value or a list", iri.text()),
              "nodes, because only they can have properties");
    }
    add_value(*map, iri, value, arena_);
  }
}

}  // namespace sinew::jsonld
