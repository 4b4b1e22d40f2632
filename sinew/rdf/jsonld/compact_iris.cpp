// IRI compaction (section 6.2): which term, compact IRI or relative reference to write for an IRI.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sinew/rdf/iri/iri.h"
#include "sinew/rdf/jsonld/compactor.h"

namespace sinew::jsonld {
namespace {

constexpr std::string_view kNull = "@null";
constexpr std::string_view kAny = "@any";

bool shorter_or_first(std::string_view a, std::string_view b) {
  return a.size() != b.size() ? a.size() < b.size() : a < b;
}

// What decides between the terms for a value: containers in the order in which they suit it, and
// the type or language that the term must have been made for.
struct Wanted {
  std::array<Containers, 20> containers;
  std::size_t count = 0;
  Selection selection = Selection::kLanguage;
  std::string_view value = kNull;

  void add(std::initializer_list<int> more) {
    for (const int bits : more) containers[count++].bits = static_cast<std::uint8_t>(bits);
  }
  void add_with_set(int bits) { add({bits, bits | Containers::kSet}); }
};

std::string last_segment(std::string_view iri) {
  const std::string_view before_query = iri.substr(0, iri.find_first_of("?#"));
  const std::string_view segment = iri.substr(before_query.rfind('/') + 1);
  const bool is_safe = !segment.empty() && segment.find(':') == std::string_view::npos;
  return std::string(is_safe ? "" : "./").append(segment);
}

std::string_view text_of(const json::Value& object, std::string_view key) {
  const json::Value* found = object.find(key);
  return found == nullptr ? std::string_view{} : found->text();
}

// The type or the language that all items of a list have in common.
void want_for_list(Wanted& wanted, const json::Value& list, std::string_view default_language,
                   json::Arena& arena) {
  if (list.find(keyword::kIndex) == nullptr) wanted.add({Containers::kList});
  const auto items = list.find(keyword::kList)->items();
  std::string_view common_type, common_language;
  if (items.empty()) common_language = default_language;
  for (const json::Value& item : items) {
    std::string_view language = keyword::kNone, type = keyword::kNone;
    if (!is_value_object(item)) {
      type = keyword::kId;
    } else if (item.find(keyword::kDirection) || item.find(keyword::kLanguage)) {
      language = language_and_direction(text_of(item, keyword::kLanguage),
                                        text_of(item, keyword::kDirection), arena);
    } else if (item.find(keyword::kType) != nullptr) {
      type = text_of(item, keyword::kType);
    } else {
      language = kNull;
    }
    if (common_language.empty()) {
      common_language = language;
    } else if (language != common_language && is_value_object(item)) {
      common_language = keyword::kNone;
    }
    if (common_type.empty()) {
      common_type = type;
    } else if (type != common_type) {
      common_type = keyword::kNone;
    }
    if (common_language == keyword::kNone && common_type == keyword::kNone) break;
  }
  if (common_language.empty()) common_language = keyword::kNone;
  if (common_type.empty()) common_type = keyword::kNone;
  if (common_type != keyword::kNone) {
    wanted.selection = Selection::kType;
    wanted.value = common_type;
  } else {
    wanted.value = common_language;
  }
}

void want_for_graph(Wanted& wanted, const json::Value& graph) {
  constexpr int kGraph = Containers::kGraph;
  constexpr int kGraphIndex = kGraph | Containers::kIndex;
  constexpr int kGraphId = kGraph | Containers::kId;
  const bool has_index = graph.find(keyword::kIndex) != nullptr;
  const bool has_id = graph.find(keyword::kId) != nullptr;
  if (has_index) wanted.add_with_set(kGraphIndex);
  if (has_id) wanted.add_with_set(kGraphId);
  wanted.add({kGraph, kGraph | Containers::kSet, Containers::kSet});
  if (!has_index) wanted.add_with_set(kGraphIndex);
  if (!has_id) wanted.add_with_set(kGraphId);
  wanted.add_with_set(Containers::kIndex);
  wanted.selection = Selection::kType;
  wanted.value = keyword::kId;
}

void want_for_value(Wanted& wanted, const json::Value& value, json::Arena& arena) {
  const bool has_index = value.find(keyword::kIndex) != nullptr;
  const bool has_language = value.find(keyword::kLanguage) || value.find(keyword::kDirection);
  if (has_language && !has_index) {
    wanted.value = language_and_direction(text_of(value, keyword::kLanguage),
                                          text_of(value, keyword::kDirection), arena);
    wanted.add_with_set(Containers::kLanguage);
  } else if (const json::Value* type = value.find(keyword::kType)) {
    wanted.value = type->text();
    wanted.selection = Selection::kType;
  }
  wanted.add({Containers::kSet});
}

}  // namespace

const InverseContext& Compactor::inverse(const Context& active) {
  const auto found = inverse_.find(&active);
  if (found != inverse_.end()) return found->second;
  return inverse_.emplace(&active, InverseContext(active, arena_)).first->second;
}

std::string_view Compactor::select_term(const Context& active, std::string_view iri,
                                        const json::Value* value, bool reverse) {
  static const json::Value kNoValue;
  const InverseContext& inverse_context = inverse(active);
  const json::Value& v = value == nullptr ? kNoValue : *value;
  const bool json_ld_11 = options_.processing_mode == ProcessingMode::kJsonLd11;

  Wanted wanted;
  const bool has_index = v.find(keyword::kIndex) != nullptr;
  if (has_index && !is_graph_object(v)) wanted.add_with_set(Containers::kIndex);
  if (reverse) {
    wanted.selection = Selection::kType;
    wanted.value = keyword::kReverse;
    wanted.add({Containers::kSet});
  } else if (is_list_object(v)) {
    want_for_list(wanted, v, inverse_context.default_language(), arena_);
  } else if (is_graph_object(v)) {
    want_for_graph(wanted, v);
  } else if (is_value_object(v)) {
    want_for_value(wanted, v, arena_);
  } else {
    wanted.selection = Selection::kType;
    wanted.value = keyword::kId;
    wanted.add_with_set(Containers::kId);
    wanted.add_with_set(Containers::kType);
    wanted.add({Containers::kSet});
  }
  wanted.add({0});
  if (json_ld_11 && !has_index) wanted.add_with_set(Containers::kIndex);
  if (json_ld_11 && v.members().size() == 1 && is_value_object(v)) {
    wanted.add_with_set(Containers::kLanguage);
  }

  std::array<std::string_view, 6> preferred;
  std::size_t count = 0;
  const auto prefer = [&](std::string_view item) { preferred[count++] = item; };
  if (wanted.value == keyword::kReverse) prefer(keyword::kReverse);
  const json::Value* id = v.find(keyword::kId);
  if ((wanted.value == keyword::kId || wanted.value == keyword::kReverse) && id != nullptr) {
    // A value that is itself a term is better written where terms are expected.
    const std::string_view text = id->is_string() ? id->text() : std::string_view{};
    const TermDefinition* term = active.terms.find(compact_iri(active, text, true));
    const bool is_term = term != nullptr && !text.empty() && term->iri == text;
    prefer(is_term ? keyword::kVocab : keyword::kId);
    prefer(is_term ? keyword::kId : keyword::kVocab);
    prefer(keyword::kNone);
  } else {
    prefer(wanted.value);
    prefer(keyword::kNone);
    const json::Value* list = v.find(keyword::kList);
    if (list != nullptr && list->items().empty()) wanted.selection = Selection::kAny;
  }
  prefer(kAny);
  for (std::size_t i = 0, end = count; i < end; ++i) {
    const std::size_t underscore = preferred[i].find('_');
    if (underscore == std::string_view::npos || preferred[i].find(':') != std::string_view::npos) {
      continue;
    }
    prefer(preferred[i].substr(underscore));
    break;
  }
  return inverse_context.select(iri, std::span(wanted.containers.data(), wanted.count),
                                wanted.selection, std::span(preferred.data(), count));
}

std::string_view Compactor::compact_iri(const Context& active, std::string_view iri, bool vocab,
                                        const json::Value* value, bool reverse) {
  if (iri.empty()) return iri;
  const InverseContext& inverse_context = inverse(active);
  if (vocab && inverse_context.knows(iri)) {
    const std::string_view term = select_term(active, iri, value, reverse);
    if (!term.empty()) return term;
  }
  if (vocab && active.vocab.has_text() && iri.size() > active.vocab.text.size() &&
      iri.starts_with(active.vocab.text)) {
    const std::string_view suffix = iri.substr(active.vocab.text.size());
    // A colon would make an IRI of it, an @ a keyword.
    if (active.terms.find(suffix) == nullptr && suffix.find(':') == std::string_view::npos &&
        !has_keyword_form(suffix)) {
      return suffix;
    }
  }

  std::string best;
  for (const InverseContext::Prefix& prefix : inverse_context.prefixes()) {
    if (iri.size() <= prefix.iri.size() || !iri.starts_with(prefix.iri)) continue;
    const std::string_view suffix = iri.substr(prefix.iri.size());
    // Behind "PREFIX:", "//" would make an IRI of it.
    if (suffix.starts_with("//") || prefix.term == "_") continue;
    const std::string candidate = fmt::format("{}:{}", prefix.term, suffix);
    if (!best.empty() && !shorter_or_first(candidate, best)) continue;
    const TermDefinition* taken = active.terms.find(candidate);
    if (taken == nullptr || (taken->iri == iri && value == nullptr)) best = candidate;
  }
  if (!best.empty()) return arena_.copy(best);

  const std::size_t colon = iri.find(':');
  if (colon != std::string_view::npos && !iri.substr(colon + 1).starts_with("//")) {
    const TermDefinition* prefix = active.terms.find(iri.substr(0, colon));
    if (prefix != nullptr && prefix->prefix) {
      fail(code::kIriConfusedWithPrefix, place_in(prefix->source, prefix->position),
           std::string(iri),
           fmt::format("the IRI would be read as a compact IRI with the prefix \"{}\"",
                       iri.substr(0, colon)),
           "another name for the prefix");
    }
  }
  if (vocab || is_keyword(iri) || iri.starts_with("_:") || !active.base.has_text()) return iri;
  std::string relative = rdf::relative_iri(iri, active.base.text);
  // The empty reference is no identifier that anybody would expect.
  if (relative.empty()) relative = last_segment(iri);
  if (has_keyword_form(relative)) relative = std::string("./").append(relative);
  return relative == iri ? iri : arena_.copy(relative);
}

}  // namespace sinew::jsonld
