// The algebra as the standard defines it, bottom-up and without any thought for speed: an oracle
// for the planner and the evaluator. Knows what random_query.h can ask for.
#pragma once

#include <map>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/rdf/sparql/algebra/algebra.h"
#include "sinew/rdf/sparql/values/term_space.h"

namespace sinew::rdf::sparql::reference {

using Solution = std::map<algebra::Variable, graph::Id>;
using Solutions = std::vector<Solution>;

class Reference {
 public:
  // `quads`: the data; what is outside of GRAPH sees the unnamed graph.
  Reference(std::vector<graph::Quad> quads, graph::Terms& terms);
  // The rows of the query, unbound as the null Id, sorted.
  std::vector<std::vector<graph::Id>> rows(const algebra::Query& query);

 private:
  Solutions evaluate(const algebra::Pattern& pattern, graph::Id graph, const Solution& constants);
  Solutions triples(const algebra::Pattern& pattern, graph::Id graph, const Solution& constants);
  Solutions select(const algebra::Select& select, graph::Id graph, const Solution& constants);
  std::vector<std::pair<graph::Id, graph::Id>> path(const syntax::Path& path, graph::Id from,
                                                    graph::Id to, graph::Id graph);
  std::vector<graph::Id> walk(const syntax::Path& path, graph::Id from, graph::Id graph);
  std::vector<graph::Id> nodes(graph::Id graph) const;
  // The value's term, the null Id on error.
  graph::Id value(const algebra::Expression& expression, const Solution& solution, graph::Id graph,
                  const Solution& constants);
  bool holds(const std::vector<algebra::Expression>& conditions, const Solution& solution,
             graph::Id graph, const Solution& constants);

  std::vector<graph::Quad> quads_;
  std::vector<graph::Id> graphs_;
  graph::Terms& terms_;
  values::TermSpace space_;
};

}  // namespace sinew::rdf::sparql::reference
