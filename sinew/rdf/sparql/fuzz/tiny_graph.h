// A graph with a bit of everything, and limits that keep every run short.
#pragma once

#include <chrono>

#include "sinew/graph/store.h"
#include "sinew/rdf/sparql/engine.h"

namespace sinew::rdf::sparql {

inline void fill_tiny_graph(graph::Store& store) {
  graph::Terms& terms = store.terms();
  const graph::Id a = terms.iri("http://e/a"), b = terms.iri("http://e/b");
  const graph::Id p = terms.iri("http://e/p"), q = terms.iri("http://e/q");
  const graph::Id g = terms.iri("http://e/g"), blank = terms.fresh_blank();
  graph::Transaction transaction = store.begin();
  transaction.add({a, p, b});
  transaction.add({b, p, a});
  transaction.add({a, q, terms.literal("text", {}, "en")});
  transaction.add({b, q, terms.integer(3)});
  transaction.add(
      {b, q, terms.literal("2024-02-29T12:00:00Z", "http://www.w3.org/2001/XMLSchema#dateTime")});
  transaction.add({a, p, blank, g});
  transaction.add({blank, q, terms.literal("1.5", "http://www.w3.org/2001/XMLSchema#decimal"), g});
  transaction.commit();
}

inline QueryOptions tiny_options() {
  QueryOptions options;
  options.base = "http://e/";
  options.limits.text_bytes = 1 << 16;
  options.limits.rows = 1000;
  options.limits.path_steps = 10'000;
  options.limits.computed_bytes = 1 << 20;
  options.limits.time = std::chrono::milliseconds(200);
  return options;
}

}  // namespace sinew::rdf::sparql
