// Prepared queries: parsed and planned once, run many times with bound parameters and without
// allocation.
//
//   const auto query = prepare(store, "SELECT ?child WHERE { ?node ^:a/:a ?child }", {"node"});
//   query->select(view, {{frame}}, [&](std::span<const Id> row) { ...; return true; });
//
// The text is a SPARQL 1.1 SELECT or ASK. Parameters are variables that are bound to a term before
// the query runs; they keep that value everywhere in it, also in nested groups, EXISTS and
// sub-selects. This is what synthesis, normalisation and the world model use; `engine.h` is the
// general entry point (any query form, any result format).
//
// What closures of properties, (^a/b)+, lead to from a node is remembered as long as the same
// version of the graph is asked, in memory that is set apart when the query first runs.
//
// The plan follows the graph: when the graph has grown or shrunk to a quarter or to four times its
// size since it was planned, the next run plans anew.
#pragma once

#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/rdf/sparql/eval/function_ref.h"
#include "sinew/rdf/sparql/syntax/limits.h"

namespace sinew::rdf::sparql {

// Called for each row with one id for each column; the null Id where unbound. False stops the
// query.
using RowVisitor = FunctionRef<bool(std::span<const graph::Id>)>;

class Prepared {
 public:
  ~Prepared();
  // Names of the projected variables, in the order of a row's ids; empty for ASK.
  const std::vector<std::string>& columns() const;
  bool is_ask() const;

  // Calls visit for each solution; unbound variables are the null Id. The row is valid during the
  // call, which may run queries, this one too, and may add to the store. Returns the number of
  // solutions visited. Any thread may call it; terms that expressions compute are added to the
  // store's dictionary, which only one thread at a time may do.
  std::size_t select(const graph::View& view, std::span<const graph::Id> parameters,
                     RowVisitor visit) const;
  std::size_t select(const graph::View& view, std::initializer_list<graph::Id> parameters,
                     RowVisitor visit) const {
    return select(view, std::span(parameters.begin(), parameters.size()), visit);
  }
  // Whether there is a solution; stops at the first.
  bool ask(const graph::View& view, std::span<const graph::Id> parameters) const;
  bool ask(const graph::View& view, std::initializer_list<graph::Id> parameters) const {
    return ask(view, std::span(parameters.begin(), parameters.size()));
  }
  // The operators in their order, with the rows that the planner expects.
  std::string explain(const graph::Terms& terms) const;

 private:
  friend std::shared_ptr<const Prepared> prepare(graph::Store&, std::string_view,
                                                 std::span<const std::string_view>, graph::Dataset,
                                                 const Limits&);
  Prepared();
  struct Data;
  std::unique_ptr<Data> data_;
};

// Parses and plans; throws Error with line and column of the fault. `store` gives terms and
// statistics, and must outlive the result. Matches the union of all graphs unless the text has FROM
// clauses or `dataset` says otherwise.
std::shared_ptr<const Prepared> prepare(graph::Store& store, std::string_view text,
                                        std::span<const std::string_view> parameters,
                                        graph::Dataset dataset = graph::Dataset::kUnion,
                                        const Limits& limits = {});
inline std::shared_ptr<const Prepared> prepare(
    graph::Store& store, std::string_view text,
    std::initializer_list<std::string_view> parameters = {},
    graph::Dataset dataset = graph::Dataset::kUnion) {
  return prepare(store, text, std::span(parameters.begin(), parameters.size()), dataset);
}

}  // namespace sinew::rdf::sparql
