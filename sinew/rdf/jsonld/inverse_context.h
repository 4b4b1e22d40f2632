// The way back from an IRI to a term (JSON-LD 1.1 API, sections 4.3 and 4.4): for an IRI, the terms
// that mean it, by their container and by the type or language of the values that they are made
// for.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sinew/rdf/jsonld/context.h"

namespace sinew::jsonld {

// By what a term is chosen for a value.
enum class Selection : std::uint8_t { kLanguage, kType, kAny };

class InverseContext {
 public:
  InverseContext(const Context& context, json::Arena& arena);

  bool knows(std::string_view iri) const { return iris_.contains(iri); }

  // The first term for the first of the containers, and for the first of the preferred values, for
  // which there is one; empty if there is none.
  std::string_view select(std::string_view iri, std::span<const Containers> containers,
                          Selection selection, std::span<const std::string_view> preferred) const;

  // Terms that may stand before the ':' of a compact IRI.
  struct Prefix {
    std::string_view term, iri;
  };
  std::span<const Prefix> prefixes() const { return prefixes_; }

  // What "no language" means here: the default language and direction, or @none.
  std::string_view default_language() const { return default_language_; }

 private:
  using Choices = std::vector<std::pair<std::string_view, std::string_view>>;  // value, term
  struct ForContainer {
    Containers containers;
    Choices by_language, by_type;
    std::string_view any;
  };
  void add(std::string_view term, const TermDefinition& definition, const Context& context,
           json::Arena& arena);

  std::unordered_map<std::string_view, std::vector<ForContainer>> iris_;
  std::vector<Prefix> prefixes_;
  std::string_view default_language_;
};

// "en_ltr", "en", "_ltr", as a key of the inverse context; in lower case.
std::string_view language_and_direction(std::string_view language, std::string_view direction,
                                        json::Arena& arena);

}  // namespace sinew::jsonld
