// Prepared queries: parsed and planned once, run many times with bound parameters and without allocation.
//
//   const auto query = prepare(store, "SELECT ?child WHERE { ?node ^:a/:a ?child }", {"node"});
//   query->select(view, {frame}, [&](std::span<const Id> row) { ...; return true; });
//
// The text is SPARQL 1.1. Parameters are variables that are bound to a term before the query runs. This is what
// synthesis, normalisation and the world model use; `engine.h` is the general entry point (any query
// form, any result format).
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/graph/store.h"

namespace sinew::rdf::sparql {

class Prepared {
 public:
  virtual ~Prepared() = default;
  // Names of the projected variables, in the order of a row's ids; empty for ASK.
  virtual const std::vector<std::string>& columns() const = 0;
  // Calls visit for each solution; unbound variables are the null Id. The row is valid during the call.
  // Returns the number of solutions visited.
  virtual std::size_t select(const graph::View& view, std::span<const graph::Id> parameters,
                             const std::function<bool(std::span<const graph::Id>)>& visit) const = 0;
  virtual bool ask(const graph::View& view, std::span<const graph::Id> parameters) const = 0;
};

// Parses and plans; throws Error with line and column of the fault. `store` gives terms and statistics.
// Matches the union of all graphs unless the text has FROM clauses or `dataset` says otherwise.
// Cached by text and parameters in a cache that belongs to the store's user (see engine.h).
std::shared_ptr<const Prepared> prepare(graph::Store& store, std::string_view text,
                                        std::initializer_list<std::string_view> parameters = {},
                                        graph::Dataset dataset = graph::Dataset::kUnion);

}  // namespace sinew::rdf::sparql
