// The blank nodes of one document: the same label is the same node here, and nowhere else.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include "sinew/graph/terms.h"

namespace sinew::rdf {

class BlankScope {
 public:
  explicit BlankScope(graph::Terms& terms) : terms_(terms) {}

  graph::Id node(std::string_view label) {
    const auto known = nodes_.find(label);
    if (known != nodes_.end()) return known->second;
    return nodes_.emplace(label, terms_.fresh_blank()).first->second;
  }

 private:
  struct Hash {
    using is_transparent = void;
    std::size_t operator()(std::string_view text) const {
      return std::hash<std::string_view>{}(text);
    }
  };
  graph::Terms& terms_;
  std::unordered_map<std::string, graph::Id, Hash, std::equal_to<>> nodes_;
};

}  // namespace sinew::rdf
