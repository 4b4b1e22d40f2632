#include "sinew/rdf/jsonld/inverse_context.h"

#include <algorithm>
#include <string>

#include "sinew/rdf/jsonld/keywords.h"

namespace sinew::jsonld {
namespace {

// Keys of the inverse context that are no keywords of the language.
constexpr std::string_view kNull = "@null";
constexpr std::string_view kAny = "@any";

void add_first(std::vector<std::pair<std::string_view, std::string_view>>& choices,
               std::string_view value, std::string_view term) {
  for (const auto& choice : choices) {
    if (choice.first == value) return;
  }
  choices.emplace_back(value, term);
}

}  // namespace

std::string_view language_and_direction(std::string_view language, std::string_view direction,
                                        json::Arena& arena) {
  std::string key(language);
  if (!direction.empty()) key.append("_").append(direction);
  for (char& c : key) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 0x20);
  }
  return key == language ? language : arena.copy(key);
}

InverseContext::InverseContext(const Context& context, json::Arena& arena)
    : default_language_(keyword::kNone) {
  if (context.language.has_text() || context.direction.has_text()) {
    default_language_ =
        language_and_direction(context.language.text, context.direction.text, arena);
  }
  std::vector<const TermTable::Entry*> entries;
  for (const TermTable::Entry& entry : context.terms.entries()) {
    if (entry.definition == nullptr || entry.definition->iri.empty()) continue;
    entries.push_back(&entry);
    if (entry.definition->prefix) prefixes_.push_back({entry.term, entry.definition->iri});
  }
  // The shortest term wins, then the first in code point order.
  std::sort(entries.begin(), entries.end(), [](const auto* a, const auto* b) {
    if (a->term.size() != b->term.size()) return a->term.size() < b->term.size();
    return a->term < b->term;
  });
  for (const TermTable::Entry* entry : entries) {
    add(entry->term, *entry->definition, context, arena);
  }
}

void InverseContext::add(std::string_view term, const TermDefinition& definition,
                         const Context& context, json::Arena& arena) {
  std::vector<ForContainer>& containers = iris_[definition.iri];
  auto entry = std::find_if(containers.begin(), containers.end(), [&](const ForContainer& other) {
    return other.containers == definition.containers;
  });
  if (entry == containers.end()) {
    containers.push_back({definition.containers, {}, {}, term});
    entry = containers.end() - 1;
  }
  const Setting& language = definition.language;
  const Setting& direction = definition.direction;
  if (definition.reverse) {
    add_first(entry->by_type, keyword::kReverse, term);
  } else if (definition.type == keyword::kNone) {
    add_first(entry->by_language, kAny, term);
    add_first(entry->by_type, kAny, term);
  } else if (!definition.type.empty()) {
    add_first(entry->by_type, definition.type, term);
  } else if (!language.is_absent() && !direction.is_absent()) {
    const std::string_view key = language_and_direction(language.text, direction.text, arena);
    add_first(entry->by_language, key.empty() ? kNull : key, term);
  } else if (!language.is_absent()) {
    const std::string_view key = language_and_direction(language.text, {}, arena);
    add_first(entry->by_language, language.has_text() ? key : kNull, term);
  } else if (!direction.is_absent()) {
    add_first(
        entry->by_language,
        direction.has_text() ? language_and_direction({}, direction.text, arena) : keyword::kNone,
        term);
  } else {
    const bool has_default = context.language.has_text() || context.direction.has_text();
    if (has_default) add_first(entry->by_language, default_language_, term);
    add_first(entry->by_language, keyword::kNone, term);
    add_first(entry->by_type, keyword::kNone, term);
  }
}

std::string_view InverseContext::select(std::string_view iri,
                                        std::span<const Containers> containers, Selection selection,
                                        std::span<const std::string_view> preferred) const {
  const auto found = iris_.find(iri);
  if (found == iris_.end()) return {};
  for (const Containers wanted : containers) {
    for (const ForContainer& entry : found->second) {
      if (entry.containers != wanted) continue;
      for (const std::string_view value : preferred) {
        if (selection == Selection::kAny) {
          if (value == keyword::kNone) return entry.any;
          continue;
        }
        for (const auto& [key, term] :
             selection == Selection::kType ? entry.by_type : entry.by_language) {
          if (key == value) return term;
        }
      }
    }
  }
  return {};
}

}  // namespace sinew::jsonld
