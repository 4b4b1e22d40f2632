#include "sinew/rdf/jsonld/expanded.h"

namespace sinew::jsonld {

bool is_node_object(const json::Value& value) {
  return value.is_object() && !is_value_object(value) && !is_list_object(value) &&
         value.find(keyword::kSet) == nullptr;
}

bool is_graph_object(const json::Value& value) {
  if (value.find(keyword::kGraph) == nullptr) return false;
  for (const json::Member& member : value.members()) {
    const std::string_view name = member.name();
    if (name != keyword::kGraph && name != keyword::kId && name != keyword::kIndex &&
        name != keyword::kContext) {
      return false;
    }
  }
  return true;
}

bool is_simple_graph_object(const json::Value& value) {
  return is_graph_object(value) && value.find(keyword::kId) == nullptr;
}

json::Value as_array(const json::Value& value, json::Arena& arena) {
  if (value.is_array()) return value;
  json::Value result = json::Value::array(arena, value.position());
  result.append(arena, value);
  return result;
}

void add_value(json::Value& object, const json::Value& key, const json::Value& value,
               json::Arena& arena) {
  json::Value* values = object.find(key.text());
  if (values == nullptr) {
    values = object.add(arena, key, json::Value::array(arena, key.position()));
  } else if (!values->is_array()) {
    *values = as_array(*values, arena);
  }
  if (value.is_array()) {
    for (const json::Value& item : value.items()) values->append(arena, item);
  } else {
    values->append(arena, value);
  }
}

}  // namespace sinew::jsonld
