// Any text as an update of a tiny graph: it is run, or refused with an Error that leaves the graph
// as it was.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "sinew/base/error.h"
#include "sinew/rdf/sparql/engine.h"
#include "sinew/rdf/sparql/fuzz/tiny_graph.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sinew;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  graph::Store store;
  rdf::sparql::fill_tiny_graph(store);
  rdf::sparql::UpdateOptions options;
  static_cast<rdf::sparql::QueryOptions&>(options) = rdf::sparql::tiny_options();
  const std::size_t before = store.view().size();
  graph::Transaction transaction = store.begin();
  try {
    rdf::sparql::update(transaction, store.terms(), text, options);
  } catch (const Error&) {
    if (transaction.view().size() != before) std::abort();
  }
  return 0;
}
