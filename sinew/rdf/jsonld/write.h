// Writes quads as a JSON-LD model, the way a person would: with the terms of the given contexts, a
// blank node where it is used, short arrays on one line.
//
// Whatever is written reads back (load.h) to the same graph: numbers keep their exact value,
// xsd:decimal its text. The same quads in the same order give the same bytes.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sinew/graph/store.h"
#include "sinew/rdf/catalogue/catalogue.h"

namespace sinew::jsonld {

class RemoteDocuments;

struct WriteOptions {
  std::vector<std::string> contexts;  // IRIs of contexts in the catalogue; later ones win
  std::vector<std::pair<std::string, std::string>> prefixes;  // name and namespace, as "rob" and
                                                              // "https://example.org/robot/"
  bool sorted = false;  // the same bytes for the same graph, whatever the order of the quads; else
                        // nodes and properties come in the order of the quads
  std::size_t width = 100;  // columns
};

// Writes models one after the other; contexts are read and parsed once for all of them.
class Writer {
 public:
  explicit Writer(const catalogue::Catalogue& catalogue, WriteOptions options = {});
  ~Writer();
  Writer(Writer&&) noexcept;
  Writer& operator=(Writer&&) noexcept;

  // No quad may come twice. Throws Error where a context is missing or broken.
  std::string write(std::span<const graph::Quad> quads, const graph::Terms& terms);

  // One graph of the store (the unnamed one with graph 0), or all of them.
  std::string write_graph(const graph::View& view, graph::Id graph);
  std::string write_all(const graph::View& view);

 private:
  WriteOptions options_;
  std::unique_ptr<RemoteDocuments> contexts_;
};

}  // namespace sinew::jsonld
