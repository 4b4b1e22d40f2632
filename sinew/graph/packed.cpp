#include "sinew/graph/packed.h"

#include <algorithm>

namespace sinew::graph {

// A counting sort by node, which keeps the order of what is equal.
Adjacency::Adjacency(const View& view, Id predicate, Direction direction) {
  struct Edge {
    std::uint32_t node;
    Id item;
  };
  std::vector<Edge> edges;
  edges.reserve(view.estimate({}, predicate, {}));
  std::uint32_t last = 0;
  view.match({}, predicate, {}, Dataset::kUnion, [&](const Quad& quad) {
    const bool out = direction == Direction::kOut;
    const Edge edge{out ? quad.subject.value : quad.object.value, out ? quad.object : quad.subject};
    first_ = edges.empty() ? edge.node : std::min(first_, edge.node);
    last = std::max(last, edge.node);
    edges.push_back(edge);
    return true;
  });
  if (edges.empty()) return;
  ends_.assign(last - first_ + 2, 0);
  for (const Edge& edge : edges) ++ends_[edge.node - first_ + 1];
  for (std::size_t at = 1; at < ends_.size(); ++at) ends_[at] += ends_[at - 1];
  items_.resize(edges.size());
  std::vector<std::uint32_t> next(ends_.begin(), ends_.end() - 1);
  for (const Edge& edge : edges) items_[next[edge.node - first_]++] = edge.item;
}

}  // namespace sinew::graph
