// Finding triples in the dataset of a plan. Private to this folder.
#pragma once

#include <algorithm>
#include <utility>

#include "sinew/rdf/sparql/eval/evaluator.h"

namespace sinew::rdf::sparql::eval {

inline bool Evaluator::is_named_graph(Id graph) const {
  const plan::DatasetPlan& dataset = plan_->dataset;
  return !dataset.named_restricted ||
         std::find(dataset.named.begin(), dataset.named.end(), graph) != dataset.named.end();
}

// Several FROM: the merge of these graphs, in which each triple is once.
template <typename Visit>
bool Evaluator::match_merged(Id subject, Id predicate, Id object, Visit&& visit) {
  const auto& graphs = plan_->dataset.merged;
  for (std::size_t i = 0; i < graphs.size(); ++i) {
    const bool go_on =
        view_.match_in(subject, predicate, object, graphs[i], [&](const graph::Quad& quad) {
          for (std::size_t earlier = 0; earlier < i; ++earlier) {
            if (view_.contains_in({quad.subject, quad.predicate, quad.object, graphs[earlier]})) {
              return true;
            }
          }
          return static_cast<bool>(visit(quad));
        });
    if (!go_on) return false;
  }
  return true;
}

template <typename Visit>
bool Evaluator::match(plan::GraphKind kind, Slot graph, Id subject, Id predicate, Id object,
                      Visit&& visit) {
  // A term that only this evaluation knows is in no graph.
  if (((subject.value | predicate.value | object.value) & values::kLocalBit) != 0) return true;
  using Default = plan::DatasetPlan::Default;
  if (kind == plan::GraphKind::kDefault) {
    switch (plan_->dataset.kind) {
      case Default::kUnion:
        return view_.match(subject, predicate, object, graph::Dataset::kUnion,
                           std::forward<Visit>(visit));
      case Default::kUnnamed:
        return view_.match(subject, predicate, object, graph::Dataset::kDefault,
                           std::forward<Visit>(visit));
      case Default::kMerge:
        return match_merged(subject, predicate, object, std::forward<Visit>(visit));
    }
  }
  const Id name = slots_[graph];
  if (name) {
    if (values::is_local(name) || !is_named_graph(name)) return true;
    return view_.match_in(subject, predicate, object, name, std::forward<Visit>(visit));
  }
  return view_.match_named(subject, predicate, object, [&](const graph::Quad& quad) {
    return !is_named_graph(quad.graph) || visit(quad);
  });
}

}  // namespace sinew::rdf::sparql::eval
