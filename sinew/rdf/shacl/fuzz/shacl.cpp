// Any text as shapes and as data: parsing and validating must end, with a report or with an Error.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "sinew/base/error.h"
#include "sinew/rdf/shacl/report.h"
#include "sinew/rdf/turtle/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace sinew;
  using namespace sinew::rdf;
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  graph::Store store;
  try {
    graph::Transaction transaction = store.begin();
    read_rdf(text, Syntax::kTurtle, {"fuzz", "http://e/", {}}, store.terms(),
             [&](const graph::Quad& quad, std::size_t, std::size_t) { transaction.add(quad); });
    transaction.commit();
    const shacl::GraphReader graph(store.view());
    const shacl::Shapes shapes = shacl::parse_shapes(store, graph);
    const auto report = shacl::validate(shapes, graph, {.max_results = 1000});
    shacl::to_text(report, store.terms());
    shacl::to_json(report, store.terms());
    shacl::to_graph(report, store);
  } catch (const Error&) {  // an answer too
  }
  return 0;
}
