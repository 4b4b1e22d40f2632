#include "sinew/world/copy_declarations.h"

#include <algorithm>
#include <string>
#include <unordered_set>
#include <vector>

#include "sinew/graph/standard_iris.h"
#include "sinew/world/symbols.h"

namespace sinew::world {

std::size_t copy_declarations(const graph::Store& from, graph::Store& to) {
  const graph::View view = from.view();
  const graph::Terms& terms = from.terms();
  std::vector<graph::Id> open;
  std::unordered_set<std::uint32_t> seen;
  const auto reach = [&](graph::Id node) {
    if (seen.insert(node.value).second) open.push_back(node);
  };
  const graph::Id is_a = terms.find_iri(graph::kRdfType);
  // What is said of a declaration in a node of its own, that may have a name.
  std::vector<graph::Id> inner;
  for (const char* property : {"precondition", "threshold", "every"}) {
    if (const auto id = terms.find_iri(std::string(kWorldNamespace) + property))
      inner.push_back(id);
  }
  for (const char* type :
       {"Component", "Allowance", "Prohibition", "SingleWriter", "Action", "Trigger"}) {
    const graph::Id of = terms.find_iri(std::string(kWorldNamespace) + type);
    if (!of || !is_a) continue;
    view.match({}, is_a, of, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
      reach(quad.subject);
      return true;
    });
  }
  while (!open.empty()) {
    const graph::Id node = open.back();
    open.pop_back();
    view.match(node, {}, {}, graph::Dataset::kUnion, [&](const graph::Quad& quad) {
      const bool is_inner = std::find(inner.begin(), inner.end(), quad.predicate) != inner.end();
      if (terms.is_blank(quad.object) || is_inner) reach(quad.object);
      return true;
    });
  }
  std::size_t count = 0;
  copy_facts(view, to, [&](const graph::Quad& quad) {
    const bool copied = seen.contains(quad.subject.value);
    count += copied;
    return copied;
  });
  return count;
}

}  // namespace sinew::world
