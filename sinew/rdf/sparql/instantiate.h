// Templates of CONSTRUCT and updates, filled in from solutions. Private to this folder.
#pragma once

#include <span>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/rdf/sparql/syntax/ast.h"

namespace sinew::rdf::sparql {

// A template whose variables are positions in a row.
class Instantiator {
 public:
  // `columns`: the variables of a row, in its order; all that the template uses are among them.
  Instantiator(const syntax::Template& source, std::span<const std::uint32_t> columns);

  // Appends the quads for one solution. A quad with an unbound variable, a literal as subject or a
  // predicate that is no IRI is left out (SPARQL 1.1, section 16.2); blank nodes are new for each
  // solution. `default_graph`: for quads outside GRAPH.
  void fill(std::span<const graph::Id> row, graph::Id default_graph, graph::Terms& terms,
            std::vector<graph::Quad>& out);

 private:
  graph::Id resolve(syntax::Node node, std::span<const graph::Id> row, graph::Terms& terms);

  syntax::Template template_;
  std::vector<graph::Id> blanks_;
};

}  // namespace sinew::rdf::sparql
