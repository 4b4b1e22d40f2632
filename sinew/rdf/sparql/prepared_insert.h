// Prepared insertions: an INSERT { ... } WHERE { ... } that is parsed and planned once and run many
// times with bound parameters. It gives the triples and changes nothing: what becomes of them is up
// to the caller.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/rdf/sparql/syntax/limits.h"

namespace sinew::rdf::sparql {

class PreparedInsert {
 public:
  ~PreparedInsert();

  // The triples of all solutions, in their order; blank nodes of the template are new for each
  // solution. Terms that expressions compute are added to the store's dictionary.
  std::vector<graph::Quad> triples(const graph::View& view,
                                   std::span<const graph::Id> parameters) const;

 private:
  friend std::shared_ptr<const PreparedInsert> prepare_insert(graph::Store&, std::string_view,
                                                              std::span<const std::string_view>,
                                                              const Limits&);
  PreparedInsert();
  struct Data;
  std::unique_ptr<Data> data_;
};

// Throws Error with line and column, also where the text is more than one INSERT, or deletes.
// Matches the union of all graphs unless the text has USING. `store` must outlive the result.
std::shared_ptr<const PreparedInsert> prepare_insert(graph::Store& store, std::string_view text,
                                                     std::span<const std::string_view> parameters,
                                                     const Limits& limits = {});

}  // namespace sinew::rdf::sparql
