// IRI expansion (JSON-LD 1.1 API, section 5.2), shared by documents, where all terms are defined,
// and by contexts under construction, where a term may have to be defined first.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sinew/rdf/iri/iri.h"
#include "sinew/rdf/jsonld/context_processor.h"
#include "sinew/rdf/jsonld/keywords.h"

namespace sinew::jsonld {

inline bool is_blank_node(std::string_view text) { return text.starts_with("_:"); }
inline bool is_iri_or_blank_node(std::string_view text) {
  return is_blank_node(text) || rdf::is_absolute_iri(text);
}

// Calls define_first(term) before it looks a term up.
template <typename DefineFirst>
std::string_view expand_iri_with(const Context& context, std::string_view text, IriUse use,
                                 json::Arena& arena, DefineFirst&& define_first) {
  if (text.starts_with('@')) {
    if (is_keyword(text)) return text;
    if (has_keyword_form(text)) return {};
  }
  define_first(text);
  const TermDefinition* definition = context.terms.find(text);
  if (definition != nullptr && (use.vocab || is_keyword(definition->iri))) {
    return definition->iri.empty() ? std::string_view{} : definition->iri;
  }
  const std::size_t colon = text.find(':', 1);
  if (colon != std::string_view::npos) {
    const std::string_view prefix = text.substr(0, colon);
    const std::string_view suffix = text.substr(colon + 1);
    if (prefix == "_" || suffix.starts_with("//")) return text;
    define_first(prefix);
    definition = context.terms.find(prefix);
    if (definition != nullptr && definition->prefix && !definition->iri.empty()) {
      return arena.concat(definition->iri, suffix);
    }
    if (rdf::is_absolute_iri(text)) return text;
  }
  if (use.vocab && context.vocab.has_text()) return arena.concat(context.vocab.text, text);
  if (use.document_relative && context.base.has_text()) {
    const std::optional<std::string> resolved = rdf::resolve_iri(text, context.base.text);
    if (resolved) return arena.copy(*resolved);
  }
  return text;
}

}  // namespace sinew::jsonld
