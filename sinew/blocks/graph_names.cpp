#include "sinew/blocks/graph_names.h"

#include "sinew/blocks/schema.h"

namespace sinew::blocks {

std::string join_scope(const std::string& scope, const std::string& name) {
  return scope.empty() ? name : scope + "." + name;
}

std::string outer_scope(const std::string& scope) {
  const std::size_t dot = scope.rfind('.');
  return dot == std::string::npos ? "" : scope.substr(0, dot);
}

void ItemNames::collect(const Node& parent, const std::string& scope) {
  for (const Node& node : parent.children) {
    if (node.kind == "module") {
      collect(node, join_scope(scope, node.text("name")));
    } else if (const KindRow* row = find_kind(node.kind); row && row->named) {
      add(node.kind, join_scope(scope, node.text("name")));
    }
  }
}

bool ItemNames::has(const std::string& kind, const std::string& full) const {
  const auto names = names_.find(kind);
  return names != names_.end() && names->second.count(full) > 0;
}

std::string ItemNames::resolve(const std::string& kind, const std::string& name,
                               const std::string& scope) const {
  for (std::string at = scope;; at = outer_scope(at)) {
    std::string full = join_scope(at, name);
    if (has(kind, full)) return full;
    if (at.empty()) return {};
  }
}

std::string ItemNames::shorten(const std::string& kind, const std::string& full,
                               const std::string& scope) const {
  for (std::size_t dot = full.size();
       (dot = full.rfind('.', dot - 1)) != std::string::npos && dot > 0;) {
    const std::string name = full.substr(dot + 1);
    if (resolve(kind, name, scope) == full) return name;
  }
  return full;
}

}  // namespace sinew::blocks
