#include "sinew/rdf/jsonld/flatten.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "sinew/rdf/json/writer.h"
#include "sinew/rdf/jsonld/iri_expansion.h"

namespace sinew::jsonld {
namespace {

// From here on, values are looked up and not compared one by one.
constexpr std::size_t kManyValues = 32;

std::vector<json::Member> members_of(const json::Value& object, bool ordered) {
  std::vector<json::Member> result(object.members().begin(), object.members().end());
  if (ordered) {
    std::sort(result.begin(), result.end(),
              [](const auto& a, const auto& b) { return a.name() < b.name(); });
  }
  return result;
}

bool says_something(const json::Value& node) {
  return node.members().size() > 1 || node.find(keyword::kId) == nullptr;
}

}  // namespace

NodeMap::NodeMap(json::Arena& arena, const Source& source)
    : arena_(arena),
      source_(source),
      graphs_(json::Value::object(arena)),
      default_graph_(json::Value::object(arena)) {}

void NodeMap::add(const json::Value& expanded) {
  Site top;
  top.graph = default_graph_;
  add_element(expanded, top);
}

json::Value NodeMap::new_label(json::Position position) {
  return json::Value::string(arena_.copy(fmt::format("_:b{}", next_label_++)), position);
}

json::Value NodeMap::label(const json::Value& id) {
  if (!is_blank_node(id.text())) return id;
  const auto found = labels_.find(id.text());
  if (found != labels_.end()) return json::Value::string(found->second, id.position());
  const json::Value result = new_label(id.position());
  labels_.emplace(id.text(), result.text());
  return result;
}

json::Value NodeMap::graph_named(const json::Value& id) {
  if (const json::Value* graph = graphs_.find(id.text())) return *graph;
  return *graphs_.add(arena_, id, json::Value::object(arena_));
}

json::Value NodeMap::node_in(json::Value& graph, const json::Value& id) {
  if (const json::Value* node = graph.find(id.text())) return *node;
  json::Value node = json::Value::object(arena_, id.position());
  node.add(arena_, keyword_value(keyword::kId), id);
  return *graph.add(arena_, id, node);
}

void NodeMap::add_new(json::Value& node, const json::Value& key, const json::Value& value) {
  const json::Value* values = node.find(key.text());
  if (values != nullptr && values->items().size() >= kManyValues) {
    const auto [entry, is_new] = large_.try_emplace(values->identity());
    if (is_new) {
      for (const json::Value& known : values->items()) {
        entry->second.insert(json::to_canonical_text(known));
      }
    }
    if (!entry->second.insert(json::to_canonical_text(value)).second) return;
  } else if (values != nullptr) {
    for (const json::Value& known : values->items()) {
      if (json::equal(known, value)) return;
    }
  }
  add_value(node, key, value, arena_);
}

void NodeMap::add_element(const json::Value& element, const Site& site) {
  if (element.is_array()) {
    for (const json::Value& item : element.items()) add_element(item, site);
  } else if (is_value_object(element)) {
    json::Value subject = site.subject, list = site.list;
    if (!list.is_null()) {
      list.append(arena_, element);
    } else if (!subject.is_null()) {
      add_new(subject, site.property, element);
    }
  } else if (is_list_object(element)) {
    add_list(element, site);
  } else {
    add_node(element, site);
  }
}

void NodeMap::add_list(const json::Value& element, const Site& site) {
  json::Value result = json::Value::object(arena_, element.position());
  Site inside = site;
  inside.list = json::Value::array(arena_, element.position());
  result.add(arena_, keyword_value(keyword::kList), inside.list);
  add_element(*element.find(keyword::kList), inside);
  json::Value subject = site.subject, list = site.list;
  if (!list.is_null()) {
    list.append(arena_, result);
  } else if (!subject.is_null()) {
    // Two lists are never merged, even if they have the same items.
    add_value(subject, site.property, result, arena_);
  }
}

void NodeMap::add_node(const json::Value& element, const Site& site) {
  const json::Value* given = element.find(keyword::kId);
  Site at = site;
  const auto reference_to = [&](const json::Value& target) {
    json::Value reference = json::Value::object(arena_, target.position());
    reference.add(arena_, keyword_value(keyword::kId), target);
    return reference;
  };
  if (given != nullptr && given->is_null()) {
    // An identifier that means nothing: there is no node to say anything about.
    if (!at.list.is_null()) {
      at.list.append(arena_, reference_to(*given));
    } else if (!at.subject.is_null() && !at.reverse) {
      add_new(at.subject, at.property, reference_to(*given));
    }
    return;
  }
  const json::Value id = given == nullptr ? new_label(element.position()) : label(*given);
  json::Value node = node_in(at.graph, id);
  if (at.reverse) {
    add_new(node, at.property, reference_to(*at.subject.find(keyword::kId)));
  } else if (!at.list.is_null()) {
    at.list.append(arena_, reference_to(id));
  } else if (!at.subject.is_null()) {
    add_new(at.subject, at.property, reference_to(id));
  }

  if (const json::Value* types = element.find(keyword::kType)) {
    for (const json::Value& type : as_array(*types, arena_).items()) {
      add_new(node, keyword_value(keyword::kType), label(type));
    }
  }
  if (const json::Value* index = element.find(keyword::kIndex)) add_index(node, *index);
  if (const json::Value* map = element.find(keyword::kReverse)) add_reverse(*map, node, at);
  Site top;
  if (const json::Value* graph = element.find(keyword::kGraph)) {
    top.graph = graph_named(id);
    add_element(*graph, top);
  }
  if (const json::Value* included = element.find(keyword::kIncluded)) {
    top.graph = at.graph;
    add_element(*included, top);
  }
  for (const json::Member& member : members_of(element, true)) {
    if (is_keyword(member.name())) continue;
    Site inside;
    inside.graph = at.graph;
    inside.subject = node;
    inside.property = label(member.key);
    if (node.find(inside.property.text()) == nullptr) {
      node.add(arena_, inside.property, json::Value::array(arena_, member.key.position()));
    }
    add_element(member.value, inside);
  }
}

void NodeMap::add_index(json::Value& node, const json::Value& index) {
  const json::Value* known = node.find(keyword::kIndex);
  if (known == nullptr) {
    node.add(arena_, keyword_value(keyword::kIndex), index);
  } else if (!json::equal(*known, index)) {
    fail(code::kConflictingIndexes, place_in(source_, index.position()),
         std::string(node.find(keyword::kId)->text()),
         fmt::format("the node has the \"@index\" {} and {}", describe(*known), describe(index)),
         "one \"@index\" for one node");
  }
}

void NodeMap::add_reverse(const json::Value& map, const json::Value& node, const Site& site) {
  for (const json::Member& member : map.members()) {
    Site inside;
    inside.graph = site.graph;
    inside.subject = node;
    inside.property = member.key;
    inside.reverse = true;
    add_element(member.value, inside);
  }
}

json::Value NodeMap::flattened(bool ordered) {
  for (const json::Member& named : members_of(graphs_, ordered)) {
    json::Value entry = node_in(default_graph_, named.key);
    json::Value nodes = json::Value::array(arena_);
    for (const json::Member& node : members_of(named.value, ordered)) {
      if (says_something(node.value)) nodes.append(arena_, node.value);
    }
    entry.set(arena_, keyword_value(keyword::kGraph), nodes);
  }
  json::Value result = json::Value::array(arena_);
  for (const json::Member& node : members_of(default_graph_, ordered)) {
    if (says_something(node.value)) result.append(arena_, node.value);
  }
  return result;
}

}  // namespace sinew::jsonld
