// Any text as a query: it is parsed, planned, explained and run on a tiny graph, or refused with an
// Error.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "sinew/base/error.h"
#include "sinew/rdf/sparql/engine.h"
#include "sinew/rdf/sparql/fuzz/tiny_graph.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sinew;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  graph::Store store;
  rdf::sparql::fill_tiny_graph(store);
  const rdf::sparql::QueryOptions options = rdf::sparql::tiny_options();
  try {
    rdf::sparql::explain(store.view(), store.terms(), text, options);
    rdf::sparql::query(store.view(), store.terms(), text, options);
  } catch (const Error&) {  // an answer too
  }
  return 0;
}
