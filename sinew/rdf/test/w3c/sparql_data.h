// What the SPARQL suite's tests read besides queries: data, and expected results in every form that
// the suite uses.
#pragma once

#include <filesystem>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/rdf/results/result_set.h"

namespace sinew::rdf::w3c {

// The triples of a .ttl, .nt or .rdf file, whose own IRI is their base.
std::vector<graph::Quad> read_data(const std::filesystem::path& file, graph::Terms& terms);

struct Expected {
  bool is_graph = false;
  std::vector<graph::Quad> graph;  // of CONSTRUCT and DESCRIBE
  ResultSet results;
  bool ordered = false;  // the file says in which order the rows must come
};

// A file of a result format, or a graph, which may describe a result set in the vocabulary
// http://www.w3.org/2001/sw/DataAccess/tests/result-set#.
Expected read_expected(const std::filesystem::path& file, graph::Terms& terms);

// The same rows with every decimal, float and double in one form for each value, because the
// standard leaves open whether a sum is written 2, 2.0 or 2.0E0; and with language tags in lower
// case, because an implementation may keep them as they are or convert them (RDF 1.1 Concepts,
// section 3.3).
ResultSet with_plain_literals(const ResultSet& results, graph::Terms& terms);
std::vector<graph::Quad> with_plain_literals(const std::vector<graph::Quad>& quads,
                                             graph::Terms& terms);

}  // namespace sinew::rdf::w3c
