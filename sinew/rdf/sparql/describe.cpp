#include "sinew/rdf/sparql/describe.h"

#include <set>
#include <unordered_set>

namespace sinew::rdf::sparql {

using graph::Id;

std::vector<graph::Quad> describe(const graph::View& view, const plan::DatasetPlan& dataset,
                                  std::span<const Id> nodes) {
  std::vector<graph::Quad> result;
  std::set<graph::Quad> seen;
  std::unordered_set<Id> known;
  std::vector<Id> queue;
  const auto add = [&](Id node) {
    if (node && known.insert(node).second) queue.push_back(node);
  };
  for (const Id node : nodes) add(node);
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const auto visit = [&](const graph::Quad& quad) {
      const graph::Quad triple{quad.subject, quad.predicate, quad.object};
      if (!seen.insert(triple).second) return true;
      result.push_back(triple);
      if (view.terms().is_blank(quad.object)) add(quad.object);
      return true;
    };
    using Default = plan::DatasetPlan::Default;
    if (dataset.kind == Default::kMerge) {
      for (const Id graph : dataset.merged) view.match_in(queue[i], {}, {}, graph, visit);
    } else {
      view.match(
          queue[i], {}, {},
          dataset.kind == Default::kUnion ? graph::Dataset::kUnion : graph::Dataset::kDefault,
          visit);
    }
  }
  return result;
}

}  // namespace sinew::rdf::sparql
