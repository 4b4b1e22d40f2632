// The shapes that values take in expanded form.
#pragma once

#include "sinew/rdf/json/value.h"
#include "sinew/rdf/jsonld/keywords.h"

namespace sinew::jsonld {

inline bool is_value_object(const json::Value& value) {
  return value.find(keyword::kValue) != nullptr;
}
inline bool is_list_object(const json::Value& value) {
  return value.find(keyword::kList) != nullptr;
}

// An object that is none of @value, @list and @set.
bool is_node_object(const json::Value& value);

// { "@graph": … } with at most "@id" and "@index" beside it; a simple one has no "@id".
bool is_graph_object(const json::Value& value);
bool is_simple_graph_object(const json::Value& value);

// The value itself if it is an array, else an array that holds it.
json::Value as_array(const json::Value& value, json::Arena& arena);

// Adds to the values of a property, which are always an array ("add value" with "as array").
void add_value(json::Value& object, const json::Value& key, const json::Value& value,
               json::Arena& arena);

inline json::Value keyword_value(std::string_view keyword) { return json::Value::string(keyword); }

}  // namespace sinew::jsonld
