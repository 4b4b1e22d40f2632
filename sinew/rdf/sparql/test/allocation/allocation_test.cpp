// A prepared query allocates nothing once it has run, also after the graph has changed as long as
// its dictionary has not grown.
#include <gtest/gtest.h>

#include "allocations.h"
#include "sinew/graph/store.h"
#include "sinew/rdf/sparql/prepared.h"

namespace sinew::rdf::sparql {
namespace {

class Allocation : public testing::TestWithParam<const char*> {};

TEST_P(Allocation, IsNoneOnceTheQueryHasRun) {
  graph::Store store;
  graph::Terms& terms = store.terms();
  std::vector<graph::Id> nodes;
  for (int i = 0; i < 100; ++i) nodes.push_back(terms.iri("http://e/n" + std::to_string(i)));
  const graph::Id p = terms.iri("http://e/p"), q = terms.iri("http://e/q");
  graph::Transaction transaction = store.begin();
  for (int i = 0; i < 100; ++i) {
    transaction.add({nodes[i], p, nodes[(i + 1) % 100]});
    transaction.add({nodes[i], q, terms.integer(i)});
  }
  transaction.commit();
  const auto query = prepare(store, std::string("PREFIX : <http://e/> ") + GetParam(), {"start"});
  const graph::View view = store.view();
  std::size_t rows = 0;
  const auto run = [&] {
    for (const graph::Id node : nodes) {
      const graph::Id parameters[] = {node};
      if (query->is_ask()) {
        rows += query->ask(view, parameters) ? 1 : 0;
      } else {
        query->select(view, parameters, [&](std::span<const graph::Id> row) {
          rows += row.size();
          return true;
        });
      }
    }
  };
  run();
  const std::size_t before = allocations();
  run();
  EXPECT_EQ(allocations() - before, 0u);
  store.remove({nodes[50], p, nodes[51]});
  const std::size_t after_change = allocations();
  run();
  EXPECT_EQ(allocations() - after_change, 0u);
  EXPECT_GT(rows, 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Queries, Allocation,
    testing::Values(
        "SELECT ?x { ?start :p/:p ?x }", "SELECT ?x { ?start (:p|^:p)+ ?x }",
        "SELECT ?x { ?start :p* ?x . ?x :q 7 }", "SELECT ?x { ?start (:p/^:p/:p)+ ?x }",
        "SELECT ?x ?n { ?start :p ?x OPTIONAL { ?x :q ?n FILTER(?n > 50) } }",
        "SELECT ?x { { ?start :p ?x } UNION { ?x :p ?start } }",
        "SELECT ?x { ?start :p ?x FILTER NOT EXISTS { ?x :p ?start } FILTER(?x != ?start) }",
        "SELECT ?x { ?start :p ?x MINUS { ?x :q 3 } }",
        "SELECT ?x ?y { VALUES ?y { :n1 :n2 } ?start :p ?x BIND(?x AS ?z) }",
        "SELECT DISTINCT ?p { ?start ?p ?o }", "ASK { ?start :p/:p/:p ?x }",
        "ASK { ?start :q ?n FILTER(?n + 1 < 50) }"));

}  // namespace
}  // namespace sinew::rdf::sparql
