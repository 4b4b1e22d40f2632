// The graph as JSON-LD text.
#include <filesystem>

#include "sinew/blocks/graph.h"
#include "sinew/blocks/graph_names.h"
#include "sinew/blocks/schema.h"
#include "sinew/rdf/jsonld/load.h"
#include "sinew/rdf/jsonld/write.h"

namespace sinew::blocks {

std::string to_jsonld(const Node& file, const std::string& base) {
  graph::Store store;
  to_graph(file, base, store);
  const catalogue::Catalogue catalogue;
  jsonld::WriteOptions options;
  options.contexts = {std::string(kDataContext)};
  options.prefixes = {{"this", base}, {"prelude", std::string(kPreludeBase)}};
  return jsonld::Writer(catalogue, std::move(options)).write_graph(store.view(), {});
}

Node from_jsonld(std::string_view text, const std::string& name) {
  graph::Store store;
  const catalogue::Catalogue catalogue;
  Report report;
  jsonld::Loader loader(catalogue);
  loader.load(
      text, name, store.terms(), [&](const graph::Quad& quad) { store.add(quad); }, nullptr,
      report);
  report.throw_if_errors();
  return from_graph(store.view(), {}, name);
}

std::string default_base(const std::string& file) {
  return "https://w3id.org/sinew/files/" + std::filesystem::path(file).stem().string() + "/";
}

}  // namespace sinew::blocks
