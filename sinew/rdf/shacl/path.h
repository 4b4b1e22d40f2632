// SHACL property paths (section 2.3.1): their structure, the nodes they lead to, and their text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sinew/rdf/shacl/graph_reader.h"

namespace sinew::rdf::shacl {

struct Path {
  enum class Kind : std::uint8_t {
    kPredicate,
    kInverse,  // one part, as the next three
    kZeroOrMore,
    kOneOrMore,
    kZeroOrOne,
    kSequence,  // two parts or more, as the next
    kAlternative,
  };
  Kind kind = Kind::kPredicate;
  Id predicate = {};  // of kPredicate
  std::vector<Path> parts = {};
  bool operator==(const Path&) const = default;

  static Path of(Id predicate) { return {Kind::kPredicate, predicate, {}}; }
};

// Deeper paths are ill-formed.
inline constexpr std::size_t kMaxPathDepth = 64;

// Every node that the path leads to from `start`, each once, in the order in which they are found.
std::vector<Id> nodes_at(const Path& path, Id start, const GraphReader& data);

// As a property path of SPARQL 1.1.
std::string to_sparql(const Path& path, const graph::Terms& terms);

}  // namespace sinew::rdf::shacl
