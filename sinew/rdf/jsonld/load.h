// Loads a model: a JSON-LD file to quads, each node and property with its place in the file.
//
// A model must mean what it says. What the standard drops in silence is an error here (a key or
// type that no context defines, a relative IRI without base, a value that stands nowhere), with a
// remedy; and a context that the catalogue does not have is an error, because nothing is fetched
// from a network.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/terms.h"
#include "sinew/rdf/catalogue/catalogue.h"
#include "sinew/rdf/jsonld/to_rdf.h"

namespace sinew::jsonld {

class RemoteDocuments;

struct LoadOptions {
  std::string base;            // base IRI for relative identifiers; empty: there is none
  bool lenient = false;        // what would be dropped is a warning and not an error
  bool local_contexts = true;  // a relative reference to a context may name a file beside the model
};

// Loads model files one after the other; contexts are read and parsed once for all of them.
class Loader {
 public:
  explicit Loader(const catalogue::Catalogue& catalogue, LoadOptions options = {});
  ~Loader();
  Loader(Loader&&) noexcept;
  Loader& operator=(Loader&&) noexcept;

  // `file` is the path of the file, or the name to report for a text that comes from elsewhere.
  // Quads go to the sink in the order of the text; `places` may be null. Faults of the model go to
  // the report, and loading goes on; those after which it cannot go on (not JSON, a context that is
  // missing or broken) are thrown as Error. After errors in the report, the quads are incomplete.
  void load(std::string_view text, std::string_view file, graph::Terms& terms, const QuadSink& sink,
            graph::Places* places, Report& report);

 private:
  LoadOptions options_;
  std::unique_ptr<RemoteDocuments> contexts_;
};

}  // namespace sinew::jsonld
