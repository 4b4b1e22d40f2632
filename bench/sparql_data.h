// Data and queries of the SPARQL benchmarks: the published Gen3 models several times side by side,
// and the queries in bench/sparql/.
#pragma once

#include <string>
#include <vector>

#include "sinew/graph/store.h"

namespace sinew::bench {

// Copy k has the triples of the published robot, each of its own IRIs with "k/" before the last
// part. False where the models are not on this machine.
bool load_robots(graph::Store& store, std::size_t copies);

// A file of bench/sparql/. Its line "# parameters: NAME ..." names what is bound before it runs,
// and
// "# anchors: SELECT ..." finds the terms to bind.
struct QueryFile {
  std::string name;
  std::string text;     // with the prefixes before it
  std::string anchors;  // likewise
  std::vector<std::string> parameters;
};
std::vector<QueryFile> query_files();

}  // namespace sinew::bench
