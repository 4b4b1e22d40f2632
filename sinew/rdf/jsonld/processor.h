// The JSON-LD 1.1 API (section 9.2), exactly as the standard has it. For models, which must not
// lose anything on the way, see load.h and write.h.
//
// Results share texts with the documents and contexts that they were made from, and live as long as
// these and the processor. Every failure is an Error whose Problem::code is the standard's name for
// it.
#pragma once

#include <span>
#include <string_view>

#include "sinew/rdf/catalogue/catalogue.h"
#include "sinew/rdf/json/reader.h"
#include "sinew/rdf/jsonld/context_processor.h"
#include "sinew/rdf/jsonld/options.h"
#include "sinew/rdf/jsonld/remote_documents.h"
#include "sinew/rdf/jsonld/to_rdf.h"

namespace sinew::jsonld {

class Processor {
 public:
  // Contexts are found in the catalogue, which must outlive the processor.
  explicit Processor(const catalogue::Catalogue& catalogue, Options options = {});

  // `url` is the document's own IRI: the base IRI unless the options have another, and what
  // relative references to contexts are resolved against. Empty: there is none.
  json::Value expand(const json::Document& document, std::string_view url);

  // `context` is what stands under "@context" in the result, or an object that has it there.
  json::Value compact(const json::Document& document, std::string_view url,
                      const json::Document& context);

  // With a context that is not null, the result is compacted.
  json::Value flatten(const json::Document& document, std::string_view url,
                      const json::Document& context);

  // No quad may come twice. The result is in expanded form.
  json::Value from_rdf(std::span<const graph::Quad> quads, const graph::Terms& terms);

  // Quads to the sink, terms to the dictionary.
  void to_rdf(const json::Document& document, std::string_view url, graph::Terms& terms,
              const QuadSink& sink);

 private:
  json::Value compact_expanded(const json::Value& expanded, std::string_view url,
                               const json::Document& context, bool always_graph);
  const Context* initial_context(std::string_view url);
  std::string_view base(std::string_view url);

  json::Arena arena_;
  Options options_;
  RemoteDocuments remote_documents_;
  ContextProcessor contexts_;
};

}  // namespace sinew::jsonld
