#include "sinew/rdf/jsonld/processor.h"

#include "sinew/graph/store.h"
#include "sinew/rdf/jsonld/compactor.h"
#include "sinew/rdf/jsonld/expander.h"
#include "sinew/rdf/jsonld/flatten.h"
#include "sinew/rdf/jsonld/from_rdf.h"

namespace sinew::jsonld {

Processor::Processor(const catalogue::Catalogue& catalogue, Options options)
    : options_(std::move(options)),
      remote_documents_(catalogue),
      contexts_(arena_, remote_documents_, options_) {}

std::string_view Processor::base(std::string_view url) {
  return options_.base.empty() ? arena_.copy(url) : options_.base;
}

const Context* Processor::initial_context(std::string_view url) {
  const Context* context = contexts_.initial(base(url));
  if (options_.expand_context.is_null()) return context;
  const json::Value* inner = options_.expand_context.find(keyword::kContext);
  return contexts_.process(context, inner == nullptr ? options_.expand_context : *inner,
                           {"expandContext", arena_.copy(url)});
}

json::Value Processor::expand(const json::Document& document, std::string_view url) {
  const Source source{document.file, arena_.copy(url)};
  return Expander(contexts_, source).document(initial_context(url), document.root);
}

json::Value Processor::compact(const json::Document& document, std::string_view url,
                               const json::Document& context) {
  return compact_expanded(expand(document, url), url, context, false);
}

json::Value Processor::compact_expanded(const json::Value& expanded, std::string_view url,
                                        const json::Document& context, bool always_graph) {
  const json::Value* inner = context.root.find(keyword::kContext);
  const json::Value local = inner == nullptr ? context.root : *inner;

  const bool relative = options_.compact_to_relative || !options_.base.empty();
  const Context* active = contexts_.initial(relative ? base(url) : std::string_view{});
  active = contexts_.process(active, local, {context.file, arena_.copy(url)});
  const json::Value compacted = Compactor(contexts_).document(active, expanded, always_graph);

  const bool empty = local.is_null() || (local.is_object() && local.members().empty()) ||
                     (local.is_array() && local.items().empty());
  if (empty) return compacted;
  json::Value result = json::Value::object(arena_);
  result.add(arena_, keyword_value(keyword::kContext), local);
  for (const json::Member& member : compacted.members()) {
    result.add(arena_, member.key, member.value);
  }
  return result;
}

json::Value Processor::flatten(const json::Document& document, std::string_view url,
                               const json::Document& context) {
  NodeMap nodes(arena_, {document.file, url});
  nodes.add(expand(document, url));
  const json::Value flattened = nodes.flattened(options_.ordered);
  if (context.root.is_null()) return flattened;
  return compact_expanded(flattened, url, context, true);
}

json::Value Processor::from_rdf(std::span<const graph::Quad> quads, const graph::Terms& terms) {
  return FromRdf(terms, options_, arena_).document(quads);
}

void Processor::to_rdf(const json::Document& document, std::string_view url, graph::Terms& terms,
                       const QuadSink& sink) {
  const json::Value expanded = expand(document, url);
  ToRdf({terms, options_, {document.file, url}}, sink).document(expanded);
}

}  // namespace sinew::jsonld
