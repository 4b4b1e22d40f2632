// One graph as SHACL sees it: the data graph, or the shapes graph. A view, and which of its triples
// count.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "sinew/graph/view.h"

namespace sinew::rdf::shacl {

using graph::Id;

class GraphReader {
 public:
  // The union of all graphs, or the unnamed graph alone.
  explicit GraphReader(graph::View view, graph::Dataset dataset = graph::Dataset::kUnion)
      : view_(std::move(view)), dataset_(dataset) {}
  // One named graph.
  GraphReader(graph::View view, Id graph)
      : view_(std::move(view)), dataset_(graph::Dataset::kDefault), graph_(graph) {}

  const graph::View& view() const { return view_; }
  const graph::Terms& terms() const { return view_.terms(); }
  graph::Dataset dataset() const { return dataset_; }
  Id graph() const { return graph_; }  // 0 unless it is a named graph

  // As View::match.
  template <typename Visit>
  bool match(Id subject, Id predicate, Id object, Visit&& visit) const {
    return graph_ ? view_.match_in(subject, predicate, object, graph_, visit)
                  : view_.match(subject, predicate, object, dataset_, visit);
  }
  bool contains(Id subject, Id predicate, Id object) const {
    return graph_ ? view_.contains_in({subject, predicate, object, graph_})
                  : view_.contains(subject, predicate, object, dataset_);
  }
  std::vector<Id> objects(Id subject, Id predicate) const {
    std::vector<Id> found;
    match(subject, predicate, {}, [&](const graph::Quad& quad) {
      found.push_back(quad.object);
      return true;
    });
    return found;
  }
  std::vector<Id> subjects(Id predicate, Id object) const {
    std::vector<Id> found;
    match({}, predicate, object, [&](const graph::Quad& quad) {
      found.push_back(quad.subject);
      return true;
    });
    return found;
  }
  Id object(Id subject, Id predicate) const {  // the first, or 0
    Id found;
    match(subject, predicate, {}, [&](const graph::Quad& quad) {
      found = quad.object;
      return false;
    });
    return found;
  }

 private:
  graph::View view_;
  graph::Dataset dataset_;
  Id graph_;
};

}  // namespace sinew::rdf::shacl
