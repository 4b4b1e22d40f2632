#include "sinew/rdf/jsonld/model_check.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "sinew/base/spelling.h"

namespace sinew::jsonld {
namespace {

// Calls visit(object) for every context definition in a local context that is written in place.
template <typename Visit>
void each_definition(const json::Value& local, Visit&& visit) {
  if (local.is_object()) visit(local);
  for (const json::Value& item : local.items()) {
    if (item.is_object()) visit(item);
  }
}

// The term inside whose context `key` is defined, when it is not defined outside.
std::string_view scope_of(const Context& active, std::string_view key) {
  std::string_view result;
  for (const TermTable::Entry& entry : active.terms.entries()) {
    if (entry.definition == nullptr || !entry.definition->has_context || !result.empty()) continue;
    each_definition(entry.definition->context, [&](const json::Value& definition) {
      if (definition.find(key) != nullptr) result = entry.term;
    });
  }
  return result;
}

std::string nearest_term(const Context& active, std::string_view text) {
  if (const std::string_view scope = scope_of(active, text); !scope.empty()) {
    return fmt::format("it is defined for nodes of type \"{}\" only: add that type", scope);
  }
  std::vector<std::string> terms;
  for (const TermTable::Entry& entry : active.terms.entries()) {
    if (entry.definition == nullptr || entry.definition->iri.empty()) continue;
    terms.emplace_back(entry.term);
    each_definition(entry.definition->context, [&](const json::Value& definition) {
      for (const json::Member& member : definition.members()) terms.emplace_back(member.name());
    });
  }
  const auto close = close_spellings(text, terms, 1);
  return close.empty() ? "" : fmt::format("did you mean \"{}\"?", close.front());
}

}  // namespace

std::string ModelCheck::remedy_for(const Context& active, std::string_view text) const {
  std::string nearest = wants_details() ? nearest_term(active, text) : "";
  if (!nearest.empty()) return nearest;
  return "a term of the contexts that the file lists; or list the context that defines it";
}

void ModelCheck::add(Place place, std::string node, std::string what, std::string remedy) {
  Problem problem{std::move(place),
                  std::move(node),
                  std::move(what),
                  std::move(remedy),
                  lenient_ ? Severity::kWarning : Severity::kError,
                  ""};
  ++faults_;
  report_.add(std::move(problem));
}

void ModelCheck::undefined_key(const Context& active, const Source& source, const json::Value& key,
                               std::string node) {
  add(place_in(source, key.position()), std::move(node),
      fmt::format("no context defines \"{}\"", key.text()), remedy_for(active, key.text()));
}

void ModelCheck::undefined_term(const Context& active, const Source& source,
                                const json::Value& text, std::string_view role, std::string node) {
  add(place_in(source, text.position()), std::move(node),
      fmt::format("no context defines the {} \"{}\"", role, text.text()),
      remedy_for(active, text.text()));
}

void ModelCheck::relative_id(const Source& source, const json::Value& id, std::string node) {
  add(place_in(source, id.position()), std::move(node),
      fmt::format("\"{}\" is a relative IRI, and nothing says relative to what", id.text()),
      "a prefix that a context defines, an absolute IRI, or \"@base\" in the context");
}

void ModelCheck::dropped_value(const Source& source, const json::Value& value, std::string node,
                               std::string what, std::string remedy) {
  add(place_in(source, value.position()), std::move(node), std::move(what), std::move(remedy));
}

void ModelCheck::dropped_quad(Place place, std::string node, std::string what, std::string remedy) {
  add(std::move(place), std::move(node), std::move(what), std::move(remedy));
}

}  // namespace sinew::jsonld
