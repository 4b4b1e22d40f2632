// Uses the installed graph and query engine the way an embedding program would.
#include <cstdio>

#include "sinew/graph/store.h"
#include "sinew/rdf/sparql/prepared.h"

int main() {
  sinew::graph::Store store;
  auto& terms = store.terms();
  store.add({terms.iri("urn:a"), terms.iri("urn:knows"), terms.iri("urn:b")});
  const auto query =
      sinew::rdf::sparql::prepare(store, "SELECT ?x WHERE { ?who <urn:knows> ?x }", {"who"});
  const sinew::graph::Id who[] = {terms.iri("urn:a")};
  std::size_t rows = 0;
  query->select(store.view(), who, [&](std::span<const sinew::graph::Id> row) {
    std::printf("%s\n", terms.to_string(row[0]).c_str());
    ++rows;
    return true;
  });
  return rows == 1 ? 0 : 1;
}
