// Query models: from JSON-LD, in a file or shipped with Sinew, to plain values.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/rdf/catalogue/catalogue.h"
#include "sinew/synthesis/query.h"

namespace sinew::synthesis {

// The queries of solvers/: "fpk", "fvk", "fak", "rnea", "gravity", ...
std::vector<std::string> named_queries();
// Error that lists the names when there is none of this name.
Query named_query(std::string_view name);

// The one node of type sq:Query of a JSON-LD text. Faults are thrown with their places.
Query parse_query(std::string_view text, const std::string& file,
                  const catalogue::Catalogue& catalogue);

// A query that is in a graph already.
Query read_query(const graph::View& view, graph::Id node, const graph::Places* places,
                 Report& report);

// A hand-written sweep configuration: which steps, in which sweeps. In JSON-LD, of type
// sq:SweepConfiguration.
struct SweepNames {
  std::string direction;  // "outward", "inward"
  std::vector<std::string> steps;
};
struct SweepConfiguration {
  std::string iri;
  std::vector<SweepNames> sweeps;
};

// One that ships with Sinew, by its IRI or the last segment of it.
SweepConfiguration named_sweeps(std::string_view name);
SweepConfiguration parse_sweeps(std::string_view text, const std::string& file,
                                const catalogue::Catalogue& catalogue);

}  // namespace sinew::synthesis
