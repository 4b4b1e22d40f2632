#include "sinew/rdf/iri/prefixes.h"

#include <algorithm>

#include "sinew/rdf/iri/characters.h"

namespace sinew::rdf {

Prefixes::Prefixes(std::initializer_list<Prefix> list) {
  for (const Prefix& prefix : list) set(prefix.name, prefix.iri);
}

void Prefixes::set(std::string_view name, std::string_view iri) {
  const auto known = std::ranges::find(list_, name, &Prefix::name);
  if (known != list_.end()) {
    known->iri = iri;
  } else {
    list_.push_back({std::string(name), std::string(iri)});
  }
}

void Prefixes::add_missing(const Prefixes& others) {
  for (const Prefix& prefix : others.list_) {
    if (!find(prefix.name)) list_.push_back(prefix);
  }
}

std::optional<std::string_view> Prefixes::find(std::string_view name) const {
  const auto known = std::ranges::find(list_, name, &Prefix::name);
  if (known == list_.end()) return std::nullopt;
  return known->iri;
}

std::optional<std::string> Prefixes::shorten(std::string_view iri) const {
  const Prefix* best = nullptr;
  for (const Prefix& prefix : list_) {
    if (!iri.starts_with(prefix.iri)) continue;
    if (best != nullptr && best->iri.size() >= prefix.iri.size()) continue;
    if (is_plain_local_name(iri.substr(prefix.iri.size()))) best = &prefix;
  }
  if (best == nullptr) return std::nullopt;
  return best->name + ":" + std::string(iri.substr(best->iri.size()));
}

std::optional<std::string> Prefixes::expand(std::string_view short_name) const {
  const std::size_t colon = short_name.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const auto iri = find(short_name.substr(0, colon));
  if (!iri) return std::nullopt;
  return std::string(*iri) + std::string(short_name.substr(colon + 1));
}

}  // namespace sinew::rdf
