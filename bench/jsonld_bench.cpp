// JSON-LD: from the published Gen3 files to quads, and from quads to a file.
//   bench/bench_jsonld --benchmark_filter=Gen3
#include <benchmark/benchmark.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/rdf/json/reader.h"
#include "sinew/rdf/jsonld/load.h"
#include "sinew/rdf/jsonld/write.h"

namespace {

using namespace sinew;
namespace fs = std::filesystem;

struct File {
  std::string name, text;
};

std::vector<File> gen3() {
  std::vector<File> files;
  const fs::path folder = fs::path(SINEW_SHARED_DIR) / "models/kinova/gen3/7dof";
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ifstream stream(entry.path(), std::ios::binary);
    files.push_back({entry.path().string(), {std::istreambuf_iterator<char>(stream), {}}});
  }
  return files;
}

std::size_t bytes(const std::vector<File>& files) {
  std::size_t result = 0;
  for (const File& file : files) result += file.text.size();
  return result;
}

void load(jsonld::Loader& loader, const std::vector<File>& files, graph::Terms& terms,
          const jsonld::QuadSink& sink, graph::Places* places) {
  Report report;
  for (const File& file : files) loader.load(file.text, file.name, terms, sink, places, report);
  report.throw_if_errors();
}

void ReadJson(benchmark::State& state) {
  const std::vector<File> files = gen3();
  if (files.empty()) return state.SkipWithError("no published models here");
  for (auto _ : state) {
    for (const File& file : files) benchmark::DoNotOptimize(json::read(file.text, file.name).root);
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * bytes(files)));
}
BENCHMARK(ReadJson)->Unit(benchmark::kMicrosecond);

// The models' quads, into a new dictionary.
std::size_t count_quads(jsonld::Loader& loader, const std::vector<File>& files) {
  graph::Terms terms;
  graph::Places places;
  std::size_t count = 0;
  load(
      loader, files, terms, [&](const graph::Quad&) { ++count; }, &places);
  return count;
}

// Everything from nothing: catalogue, contexts, dictionary.
void Gen3ToQuadsCold(benchmark::State& state) {
  const std::vector<File> files = gen3();
  if (files.empty()) return state.SkipWithError("no published models here");
  for (auto _ : state) {
    const catalogue::Catalogue catalogue;
    jsonld::Loader loader(catalogue);
    benchmark::DoNotOptimize(count_quads(loader, files));
  }
}
BENCHMARK(Gen3ToQuadsCold)->Unit(benchmark::kMicrosecond);

// The same, with contexts that have been parsed before.
void Gen3ToQuads(benchmark::State& state) {
  const std::vector<File> files = gen3();
  if (files.empty()) return state.SkipWithError("no published models here");
  const catalogue::Catalogue catalogue;
  jsonld::Loader loader(catalogue);
  for (auto _ : state) benchmark::DoNotOptimize(count_quads(loader, files));
}
BENCHMARK(Gen3ToQuads)->Unit(benchmark::kMicrosecond);

void Gen3IntoStore(benchmark::State& state) {
  const std::vector<File> files = gen3();
  if (files.empty()) return state.SkipWithError("no published models here");
  const catalogue::Catalogue catalogue;
  jsonld::Loader loader(catalogue);
  for (auto _ : state) {
    graph::Store store;
    graph::Places places;
    auto transaction = store.begin();
    load(
        loader, files, store.terms(), [&](const graph::Quad& quad) { transaction.add(quad); },
        &places);
    transaction.commit();
  }
}
BENCHMARK(Gen3IntoStore)->Unit(benchmark::kMicrosecond);

// A graph of `triples` triples in the shape of an algorithm model: nodes with a type, references,
// numbers and a list.
std::vector<graph::Quad> algorithm(graph::Terms& terms, std::size_t triples) {
  const std::string algo = "https://w3id.org/sinew/algorithm#";
  const auto iri = [&](const std::string& name) { return terms.iri(algo + name); };
  const graph::Id type = terms.iri("http://www.w3.org/1999/02/22-rdf-syntax-ns#type");
  const graph::Id graph = terms.iri("https://example.org/algorithm");
  const graph::Id represents = iri("represents"), size = iri("size"), role = iri("role");
  std::vector<graph::Quad> quads;
  for (std::size_t i = 0; quads.size() < triples; ++i) {
    const graph::Id node = terms.iri("https://example.org/data-" + std::to_string(i));
    quads.push_back({node, type, iri("DataBlock"), graph});
    quads.push_back({node, represents,
                     terms.iri("https://example.org/joint-" + std::to_string(i % 50)), graph});
    quads.push_back({node, size, terms.integer(static_cast<std::int64_t>(i % 12)), graph});
    quads.push_back({node, role, iri(i % 2 ? "internal" : "input"), graph});
    quads.push_back({node, iri("value"), terms.real(0.1 * static_cast<double>(i)), graph});
  }
  return quads;
}

void WriteModel(benchmark::State& state) {
  graph::Terms terms;
  const auto quads = algorithm(terms, static_cast<std::size_t>(state.range(0)));
  const catalogue::Catalogue catalogue;
  jsonld::WriteOptions options;
  options.contexts = {"https://w3id.org/sinew/algorithm.json"};
  options.prefixes = {{"ex", "https://example.org/"}};
  jsonld::Writer writer(catalogue, options);
  for (auto _ : state) benchmark::DoNotOptimize(writer.write(quads, terms));
}
BENCHMARK(WriteModel)->Arg(5000)->Arg(50000)->Unit(benchmark::kMicrosecond);

void WriteGen3(benchmark::State& state) {
  const std::vector<File> files = gen3();
  if (files.empty()) return state.SkipWithError("no published models here");
  const catalogue::Catalogue catalogue;
  jsonld::Loader loader(catalogue);
  graph::Store store;
  auto transaction = store.begin();
  load(
      loader, files, store.terms(), [&](const graph::Quad& quad) { transaction.add(quad); },
      nullptr);
  transaction.commit();
  jsonld::WriteOptions options;
  for (const char* name :
       {"geometry/structural-entities.json", "kinematic-chain/structural-entities.json",
        "newtonian-rigid-body-dynamics/structural-entities.json",
        "newtonian-rigid-body-dynamics/coordinates.json", "geometry/spatial-relations.json",
        "geometry/coordinates.json", "qudt.json"}) {
    options.contexts.push_back(std::string(catalogue::kPublishedMetamodels) + name);
  }
  jsonld::Writer writer(catalogue, options);
  for (auto _ : state) benchmark::DoNotOptimize(writer.write_all(store.view()));
}
BENCHMARK(WriteGen3)->Unit(benchmark::kMicrosecond);

}  // namespace
