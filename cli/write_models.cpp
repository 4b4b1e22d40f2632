#include "write_models.h"

#include <algorithm>
#include <optional>

#include "prefixes.h"
#include "sinew/rdf/catalogue/catalogue.h"
#include "sinew/rdf/jsonld/write.h"

namespace sinew::cli {
namespace {

std::string metamodel(const std::string& file) {
  return std::string(catalogue::kPublishedMetamodels) + file;
}

// What the IRIs of all named graphs begin with, up to a '/'; empty when there is nothing in common.
std::string common_base(const graph::View& view) {
  std::optional<std::string> common;
  view.named_graphs([&](graph::Id graph) {
    const std::string_view iri = view.terms().text(graph);
    if (!common) common = iri;
    const auto differ = std::mismatch(common->begin(), common->end(), iri.begin(), iri.end()).first;
    common->erase(differ, common->end());
    return true;
  });
  if (!common) return "";
  const auto slash = common->rfind('/');
  // Something must be left beyond "https://host/".
  return slash == std::string::npos || slash < 9 ? "" : common->substr(0, slash + 1);
}

// The contexts of robot models.
std::vector<std::string> model_contexts() {
  return {metamodel("geometry/structural-entities.json"),
          metamodel("geometry/coordinates.json"),
          metamodel("geometry/spatial-relations.json"),
          metamodel("kinematic-chain/structural-entities.json"),
          metamodel("kinematic-chain/state.json"),
          metamodel("newtonian-rigid-body-dynamics/structural-entities.json"),
          metamodel("newtonian-rigid-body-dynamics/coordinates.json"),
          metamodel("qudt.json"),
          "https://w3id.org/sinew/kinematic-chain.json",
          "https://w3id.org/sinew/shape.json"};
}

}  // namespace

std::string models_as_jsonld(const graph::View& view) {
  const catalogue::Catalogue catalogue;
  jsonld::WriteOptions options;
  options.contexts = model_contexts();
  const std::string base = common_base(view);
  if (!base.empty()) options.prefixes = {{"rob", base}};
  return jsonld::Writer(catalogue, options).write_all(view);
}

std::string triples_as_jsonld(std::span<const graph::Quad> triples, const graph::Terms& terms) {
  const catalogue::Catalogue catalogue;
  jsonld::WriteOptions options;
  options.contexts = model_contexts();
  options.sorted = true;
  return jsonld::Writer(catalogue, options).write(triples, terms);
}

std::string algorithm_as_jsonld(const graph::View& view, graph::Id algorithm) {
  const catalogue::Catalogue catalogue;
  jsonld::WriteOptions options;
  options.contexts = {"https://w3id.org/sinew/algorithm.json"};
  for (const char* name : {"geom-op", "kc-op", "dyn-op", "so", "step"}) {
    options.prefixes.emplace_back(name, std::string(*known_prefixes().find(name)));
  }
  options.prefixes.emplace_back("id", "https://w3id.org/sinew/id/");
  return jsonld::Writer(catalogue, options).write_graph(view, algorithm);
}

}  // namespace sinew::cli
