// Where in which file a node, or one property of a node, was written; so that any later stage can
// say file:line for what it finds wrong.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/terms.h"

namespace sinew::graph {

class Places {
 public:
  std::uint32_t add_file(std::string name);
  // The first note for a node, and for a node's property, is kept; later ones are ignored.
  void note(Id subject, Id predicate, std::uint32_t file, std::uint32_t line, std::uint32_t column);
  // The property's place if known, else the node's, else an empty place.
  Place find(Id subject, Id predicate = {}) const;

 private:
  struct Entry {
    std::uint32_t file, line, column;
  };
  std::vector<std::string> files_;
  std::unordered_map<std::uint64_t, Entry> entries_;
};

}  // namespace sinew::graph
