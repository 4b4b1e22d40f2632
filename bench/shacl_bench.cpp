// SHACL: all our shapes against the published Gen3 models.
//   bench/bench_shacl
#include <benchmark/benchmark.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "sinew/rdf/shacl/report.h"
#include "sinew/rdf/shacl/shapes.h"
#include "sinew/rdf/shacl/validation.h"
#include "sinew/rdf/turtle/reader.h"
#include "sparql_data.h"

namespace {

using namespace sinew;
using namespace sinew::rdf;
namespace fs = std::filesystem;

// Every Turtle file of metamodels/, in one named graph.
graph::Id load_shapes(graph::Store& store) {
  const graph::Id name = store.terms().iri("https://w3id.org/sinew/shapes");
  graph::Transaction transaction = store.begin();
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(SINEW_SOURCE_DIR) / "metamodels")) {
    if (entry.path().extension() != ".ttl") continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    read_rdf(text, Syntax::kTurtle, {entry.path().string(), "", name}, store.terms(),
             [&](const graph::Quad& quad, std::size_t, std::size_t) { transaction.add(quad); });
  }
  transaction.commit();
  return name;
}

void ParseShapes(benchmark::State& state) {
  graph::Store store;
  const graph::Id name = load_shapes(store);
  std::size_t count = 0;
  for (auto _ : state) {
    count = shacl::parse_shapes(store, shacl::GraphReader(store.view(), name)).shapes.size();
  }
  state.counters["shapes"] = static_cast<double>(count);
}
BENCHMARK(ParseShapes)->Unit(benchmark::kMicrosecond);

void ValidateRobots(benchmark::State& state) {
  graph::Store store;
  if (!bench::load_robots(store, static_cast<std::size_t>(state.range(0)))) {
    return state.SkipWithError("no published models here");
  }
  const std::size_t triples = store.view().size();
  const graph::Id name = load_shapes(store);
  const shacl::Shapes shapes = shacl::parse_shapes(store, shacl::GraphReader(store.view(), name));
  const shacl::GraphReader data(store.view());
  std::size_t results = 0;
  for (auto _ : state) results = shacl::validate(shapes, data).results.size();
  state.counters["results"] = static_cast<double>(results);
  state.counters["triples"] = static_cast<double>(triples);
}
BENCHMARK(ValidateRobots)->Arg(1)->Arg(8)->Unit(benchmark::kMicrosecond);

}  // namespace
