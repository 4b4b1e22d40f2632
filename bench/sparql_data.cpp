#include "sparql_data.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "sinew/rdf/jsonld/load.h"

namespace sinew::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRobot = "https://comp-rob2b.github.io/robots/kinova/gen3/7dof/";

std::string read(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

bool load_robots(graph::Store& store, std::size_t copies) {
  const fs::path folder = fs::path(SINEW_SHARED_DIR) / "models/kinova/gen3/7dof";
  if (!fs::exists(folder)) return false;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());

  const catalogue::Catalogue catalogue;
  jsonld::Loader loader(catalogue);
  Report report;
  graph::Terms& terms = store.terms();
  std::vector<graph::Quad> quads;
  for (const fs::path& file : files) {
    loader.load(
        read(file), file.string(), terms, [&](const graph::Quad& quad) { quads.push_back(quad); },
        nullptr, report);
  }
  report.throw_if_errors();

  graph::Transaction transaction = store.begin();
  for (std::size_t copy = 0; copy < copies; ++copy) {
    std::map<graph::Id, graph::Id> blanks;
    const auto copied = [&](graph::Id id) {
      if (!id) return id;
      if (terms.is_blank(id)) {
        graph::Id& blank = blanks[id];
        if (!blank) blank = terms.fresh_blank();
        return blank;
      }
      if (!terms.is_iri(id) || !terms.text(id).starts_with(kRobot)) return id;
      return terms.iri(std::string(kRobot) + std::to_string(copy) + "/" +
                       std::string(terms.text(id).substr(kRobot.size())));
    };
    for (const graph::Quad& quad : quads) {
      transaction.add(
          {copied(quad.subject), quad.predicate, copied(quad.object), copied(quad.graph)});
    }
  }
  transaction.commit();
  return true;
}

std::vector<QueryFile> query_files() {
  const fs::path folder = fs::path(SINEW_SOURCE_DIR) / "bench/sparql";
  const std::string prefixes = read(folder / "prefixes.rq");
  std::vector<QueryFile> result;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".rq" || entry.path().stem() == "prefixes") continue;
    QueryFile file;
    file.name = entry.path().stem().string();
    file.text = prefixes + read(entry.path());
    std::istringstream lines(file.text);
    for (std::string line; std::getline(lines, line);) {
      constexpr std::string_view kParameters = "# parameters:", kAnchors = "# anchors:";
      if (line.starts_with(kParameters)) {
        std::istringstream names(line.substr(kParameters.size()));
        for (std::string name; names >> name;) file.parameters.push_back(name);
      } else if (line.starts_with(kAnchors)) {
        file.anchors = prefixes + line.substr(kAnchors.size());
      }
    }
    result.push_back(std::move(file));
  }
  std::sort(result.begin(), result.end(),
            [](const QueryFile& a, const QueryFile& b) { return a.name < b.name; });
  return result;
}

}  // namespace sinew::bench
