// "@container" in the definition of a term: which keywords may stand together.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <utility>

#include "sinew/rdf/jsonld/keywords.h"
#include "sinew/rdf/jsonld/term_definer.h"

namespace sinew::jsonld {
namespace {

constexpr std::array<std::pair<std::string_view, std::uint8_t>, 7> kContainers = {{
    {keyword::kGraph, Containers::kGraph},
    {keyword::kId, Containers::kId},
    {keyword::kIndex, Containers::kIndex},
    {keyword::kLanguage, Containers::kLanguage},
    {keyword::kList, Containers::kList},
    {keyword::kSet, Containers::kSet},
    {keyword::kType, Containers::kType},
}};

std::uint8_t bit_of(const json::Value& name) {
  for (const auto& [text, bit] : kContainers) {
    if (name.is_string(text)) return bit;
  }
  return 0;
}

// One alone; @set with one other than @list; @graph with one of @id and @index, and @set.
bool may_stand_together(std::uint8_t bits) {
  if (std::has_single_bit(bits)) return true;
  const auto others = static_cast<std::uint8_t>(bits & ~Containers::kSet);
  if (others & Containers::kList) return false;
  if (std::has_single_bit(others)) return true;
  return others == (Containers::kGraph | Containers::kId) ||
         others == (Containers::kGraph | Containers::kIndex);
}

}  // namespace

void TermDefiner::define_containers(TermDefinition& definition, const json::Value& value) {
  const json::Value* entry = value.find(keyword::kContainer);
  if (entry == nullptr || (entry->is_null() && definition.reverse)) return;
  const auto refuse = [&] {
    fail_at(code::kInvalidContainerMapping, *entry,
            fmt::format("the container is {}, which is not one, or not one combination, of those "
                        "that exist",
                        describe(*entry)),
            "@graph, @id, @index, @language, @list, @set, @type, or an array such as [\"@index\", "
            "\"@set\"]");
  };
  const auto names = entry->is_array() ? entry->items() : std::span(entry, 1);
  std::uint8_t bits = 0;
  for (const json::Value& name : names) {
    const std::uint8_t bit = bit_of(name);
    if (bit == 0) refuse();
    bits |= bit;
  }
  if (bits == 0 || !may_stand_together(bits)) refuse();
  constexpr std::uint8_t kNewInJsonLd11 = Containers::kGraph | Containers::kId | Containers::kType;
  if (json_ld_10() && (entry->is_array() || (bits & kNewInJsonLd11))) refuse();

  definition.containers.bits = bits;
  if (definition.containers.has(Containers::kType)) {
    if (definition.type.empty()) definition.type = keyword::kId;
    if (definition.type != keyword::kId && definition.type != keyword::kVocab) {
      fail_at(code::kInvalidTypeMapping, *entry,
              fmt::format("the keys of a map by type have the type <{}>", definition.type),
              "\"@id\" or \"@vocab\"");
    }
  }
}

}  // namespace sinew::jsonld
