#include "sinew/rdf/jsonld/load.h"

#include <filesystem>

#include "sinew/graph/store.h"
#include "sinew/rdf/iri/iri.h"
#include "sinew/rdf/jsonld/expander.h"

namespace sinew::jsonld {

Loader::Loader(const catalogue::Catalogue& catalogue, LoadOptions options)
    : options_(std::move(options)),
      contexts_(std::make_unique<RemoteDocuments>(catalogue, options_.local_contexts)) {}

Loader::~Loader() = default;
Loader::Loader(Loader&&) noexcept = default;
Loader& Loader::operator=(Loader&&) noexcept = default;

void Loader::load(std::string_view text, std::string_view file, graph::Terms& terms,
                  const QuadSink& sink, graph::Places* places, Report& report) {
  const json::Document document = json::read(text, file);
  const std::string url =
      options_.local_contexts ? rdf::file_iri(std::filesystem::absolute(file).string()) : "";
  const Source source{document.file, url};

  Options options;
  options.base = options_.base;
  ModelCheck check(report, options_.lenient);
  ContextProcessor contexts(*document.arena, *contexts_, options);
  Expander expander(contexts, source, &check);
  const json::Value expanded = expander.document(contexts.initial(options.base), document.root);

  ToRdfContext context{terms, options, source, Numbers::kExact, places, 0, &check};
  if (places != nullptr) context.file = places->add_file(document.file);
  ToRdf(context, sink).document(expanded);
}

}  // namespace sinew::jsonld
