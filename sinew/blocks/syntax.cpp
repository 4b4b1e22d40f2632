#include "sinew/blocks/syntax.h"

#include <algorithm>

namespace sinew::blocks {

const std::string& Node::text(std::string_view name) const {
  static const std::string none;
  for (const Text& text : texts) {
    if (text.name == name) return text.value;
  }
  return none;
}

Place Node::place_of(std::string_view name) const {
  for (const Text& text : texts) {
    if (text.name == name) return text.place;
  }
  return place;
}

bool Node::has(std::string_view name) const {
  return std::any_of(texts.begin(), texts.end(),
                     [&](const Text& text) { return text.name == name; });
}

std::vector<std::string> Node::all(std::string_view name) const {
  std::vector<std::string> values;
  for (const Text& text : texts) {
    if (text.name == name) values.push_back(text.value);
  }
  return values;
}

const Node* Node::child(std::string_view wanted) const {
  for (const Node& node : children) {
    if (node.kind == wanted) return &node;
  }
  return nullptr;
}

void Node::add(std::string name, std::string value, Place at) {
  texts.push_back({std::move(name), std::move(value), std::move(at)});
}

bool same(const Node& a, const Node& b) {
  const auto same_text = [](const Text& x, const Text& y) {
    return x.name == y.name && x.value == y.value;
  };
  return a.kind == b.kind && a.comments == b.comments && a.remark == b.remark &&
         a.end_comments == b.end_comments &&
         std::equal(a.texts.begin(), a.texts.end(), b.texts.begin(), b.texts.end(), same_text) &&
         std::equal(a.children.begin(), a.children.end(), b.children.begin(), b.children.end(),
                    same);
}

}  // namespace sinew::blocks
