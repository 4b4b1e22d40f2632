#include "sinew/rdf/jsonld/term_definer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sinew/rdf/jsonld/iri_expansion.h"

namespace sinew::jsonld {
namespace {

// Entries of a context definition that are not terms.
constexpr std::array kNotTerms = {keyword::kBase,     keyword::kDirection, keyword::kImport,
                                  keyword::kLanguage, keyword::kPropagate, keyword::kProtected,
                                  keyword::kVersion,  keyword::kVocab};

constexpr std::array kEntries = {keyword::kId,        keyword::kReverse,   keyword::kContainer,
                                 keyword::kContext,   keyword::kDirection, keyword::kIndex,
                                 keyword::kLanguage,  keyword::kNest,      keyword::kPrefix,
                                 keyword::kProtected, keyword::kType};

template <typename List>
bool contains(const List& list, std::string_view text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

bool has_colon_inside(std::string_view term) {
  const std::size_t colon = term.find(':', 1);
  return colon != std::string_view::npos && colon + 1 < term.size();
}

bool ends_like_a_namespace(std::string_view iri) {
  return !iri.empty() && std::string_view(":/?#[]@").find(iri.back()) != std::string_view::npos;
}

}  // namespace

TermDefiner::TermDefiner(ContextProcessor& processor, Context& context, const json::Value& local,
                         const ContextProcessor::Job& job)
    : processor_(processor),
      arena_(processor.arena()),
      context_(context),
      local_(local),
      job_(job),
      progress_(local.members().size(), Progress::kOpen) {
  if (const json::Value* value = local.find(keyword::kProtected)) {
    if (!value->is_boolean()) {
      fail_at(code::kInvalidProtectedValue, *value,
              fmt::format("\"@protected\" is {}", describe(*value)), "true or false");
    }
    protected_by_default_ = value->is_true();
  }
}

bool TermDefiner::json_ld_10() const {
  return processor_.options().processing_mode == ProcessingMode::kJsonLd10;
}

void TermDefiner::fail_at(std::string_view error_code, const json::Value& at, std::string what,
                          std::string remedy) const {
  fail(error_code, place_in(job_.source, at.position()), "", std::move(what), std::move(remedy));
}

std::string_view TermDefiner::expand(std::string_view text, IriUse use) {
  return expand_iri_with(context_, text, use, arena_,
                         [this](std::string_view term) { define_first(term); });
}

void TermDefiner::define_all() {
  for (const json::Member& member : local_.members()) {
    if (!contains(kNotTerms, member.name())) define(member);
  }
}

void TermDefiner::define_first(std::string_view term) {
  if (const json::Member* member = local_.find_member(term)) define(*member);
}

void TermDefiner::define(const json::Member& member) {
  Progress& progress = progress_[static_cast<std::size_t>(&member - local_.members().data())];
  if (progress == Progress::kDone) return;
  const json::Value& term = member.key;
  if (progress == Progress::kUnderWay) {
    fail_at(code::kCyclicIriMapping, term,
            fmt::format("the meaning of \"{}\" depends on itself", term.text()),
            "an absolute IRI as its \"@id\"");
  }
  if (term.text().empty()) {
    fail_at(code::kInvalidTermDefinition, term, "a term is the empty string", "a name");
  }
  if (depth_ == kMaxTermDependencies) {
    fail_at(
        code::kContextOverflow, term,
        fmt::format("terms depend on each other in a chain of more than {}", kMaxTermDependencies),
        "absolute IRIs as their \"@id\"");
  }
  progress = Progress::kUnderWay;
  ++depth_;
  define_term(member, progress);
  --depth_;
  progress = Progress::kDone;
}

void TermDefiner::define_term(const json::Member& member, Progress& progress) {
  const json::Value& term = member.key;
  check_keyword(term, member.value);
  if (!is_keyword(term.text()) && has_keyword_form(term.text())) return;  // reserved, and ignored
  const TermDefinition* previous = context_.terms.find(term.text());
  if (previous != nullptr) context_.terms.set(arena_, term.text(), nullptr);

  const bool simple = member.value.is_string();
  json::Value value = member.value;
  if (value.is_null() || simple) {
    value = json::Value::object(arena_, member.value.position());
    value.add(arena_, json::Value::string(keyword::kId), member.value);
  } else if (!value.is_object()) {
    fail_at(code::kInvalidTermDefinition, value,
            fmt::format("the definition of \"{}\" is {}", term.text(), describe(value)),
            "an IRI, an object, or null");
  }

  auto* definition = new (arena_.allocate<TermDefinition>()) TermDefinition{};
  definition->source = job_.source;
  definition->position = term.position();
  definition->is_protected = is_protected(value);
  define_type(*definition, value);
  if (!define_iri(*definition, term, value, simple, progress)) return;
  define_containers(*definition, value);
  define_index(*definition, value);
  define_context(*definition, term, value);
  define_language(*definition, value);
  define_direction(*definition, value);
  define_nest(*definition, value);
  define_prefix(*definition, term, value);
  check_entries(value);

  const TermDefinition* result = definition;
  if (!job_.override_protected && previous != nullptr && previous->is_protected) {
    if (!same_definition(*definition, *previous)) {
      fail_at(code::kProtectedTermRedefinition, term,
              fmt::format("\"{}\" is protected and means <{}>", term.text(), previous->iri),
              "another name for the new term");
    }
    result = previous;
  }
  if (result->is_protected) context_.has_protected_terms = true;
  context_.terms.set(arena_, term.text(), result);
}

void TermDefiner::check_keyword(const json::Value& term, const json::Value& value) const {
  if (!is_keyword(term.text())) return;
  const auto refuse = [&] {
    fail_at(code::kKeywordRedefinition, term,
            fmt::format("the keyword \"{}\" is redefined", term.text()),
            "only \"@type\": { \"@container\": \"@set\" } may be");
  };
  if (term.text() != keyword::kType || json_ld_10() || value.members().empty()) refuse();
  for (const json::Member& member : value.members()) {
    const bool set = member.name() == keyword::kContainer && member.value.is_string(keyword::kSet);
    if (!set && member.name() != keyword::kProtected) refuse();
  }
}

bool TermDefiner::is_protected(const json::Value& value) const {
  const json::Value* entry = value.find(keyword::kProtected);
  if (entry == nullptr) return protected_by_default_;
  if (!entry->is_boolean()) {
    fail_at(code::kInvalidProtectedValue, *entry,
            fmt::format("\"@protected\" is {}", describe(*entry)), "true or false");
  }
  if (json_ld_10()) {
    fail_at(code::kInvalidTermDefinition, *entry, "\"@protected\" needs JSON-LD 1.1",
            "processing mode json-ld-1.1");
  }
  return entry->is_true();
}

void TermDefiner::define_type(TermDefinition& definition, const json::Value& value) {
  const json::Value* entry = value.find(keyword::kType);
  if (entry == nullptr) return;
  const std::string_view type =
      entry->is_string() ? expand(entry->text(), kAsProperty) : std::string_view{};
  const bool new_keyword = type == keyword::kJson || type == keyword::kNone;
  const bool known = type == keyword::kId || type == keyword::kVocab ||
                     (new_keyword && !json_ld_10()) ||
                     (!is_blank_node(type) && rdf::is_absolute_iri(type));
  if (!known) {
    fail_at(code::kInvalidTypeMapping, *entry,
            fmt::format("the type of a term's values is {}", describe(*entry)),
            "\"@id\", \"@vocab\", \"@json\", \"@none\", or the IRI of a datatype");
  }
  definition.type = type;
}

bool TermDefiner::define_iri(TermDefinition& definition, const json::Value& term,
                             const json::Value& value, bool simple, Progress& progress) {
  if (value.find(keyword::kReverse) != nullptr) return define_reverse(definition, value);
  const json::Value* id = value.find(keyword::kId);
  if (id != nullptr && !id->is_string(term.text())) {
    return define_id(definition, term, *id, simple, progress);
  }
  define_implied_iri(definition, term);
  return true;
}

bool TermDefiner::define_reverse(TermDefinition& definition, const json::Value& value) {
  const json::Value& entry = *value.find(keyword::kReverse);
  if (value.find(keyword::kId) != nullptr || value.find(keyword::kNest) != nullptr) {
    fail_at(code::kInvalidReverseProperty, entry,
            "a reverse property has \"@id\" or \"@nest\" as well", "\"@reverse\" without them");
  }
  if (!entry.is_string()) {
    fail_at(code::kInvalidIriMapping, entry, fmt::format("\"@reverse\" is {}", describe(entry)),
            "the IRI of a property");
  }
  if (!is_keyword(entry.text()) && has_keyword_form(entry.text())) return false;
  definition.iri = expand(entry.text(), kAsProperty);
  if (!is_iri_or_blank_node(definition.iri)) {
    fail_at(code::kInvalidIriMapping, entry,
            fmt::format("\"{}\" in \"@reverse\" does not lead to an IRI", entry.text()),
            "an IRI, or a term or prefix that is defined");
  }
  if (const json::Value* container = value.find(keyword::kContainer)) {
    if (!container->is_null() && !container->is_string(keyword::kSet) &&
        !container->is_string(keyword::kIndex)) {
      fail_at(code::kInvalidReverseProperty, *container,
              fmt::format("the container of a reverse property is {}", describe(*container)),
              "\"@set\" or \"@index\"");
    }
  }
  definition.reverse = true;
  return true;
}

bool TermDefiner::define_id(TermDefinition& definition, const json::Value& term,
                            const json::Value& id, bool simple, Progress& progress) {
  if (id.is_null()) return true;
  if (!id.is_string()) {
    fail_at(code::kInvalidIriMapping, id, fmt::format("\"@id\" is {}", describe(id)),
            "an IRI, or null");
  }
  if (!is_keyword(id.text()) && has_keyword_form(id.text())) return false;
  definition.iri = expand(id.text(), kAsProperty);
  if (!is_keyword(definition.iri) && !is_iri_or_blank_node(definition.iri)) {
    fail_at(code::kInvalidIriMapping, id,
            fmt::format("\"{}\" as the meaning of \"{}\" does not lead to an IRI", id.text(),
                        term.text()),
            "an IRI, or a term or prefix that is defined");
  }
  if (definition.iri == keyword::kContext) {
    fail_at(code::kInvalidKeywordAlias, id, "\"@context\" has an alias", "\"@context\" itself");
  }
  const bool has_slash = term.text().find('/') != std::string_view::npos;
  if (has_colon_inside(term.text()) || has_slash) {
    // The term is looked at as an IRI, without what is defined for it here.
    progress = Progress::kDone;
    const std::string_view expanded = expand(term.text(), kAsProperty);
    if (expanded != definition.iri) {
      fail_at(
          code::kInvalidIriMapping, id,
          fmt::format("\"{}\" looks like an IRI but is to mean <{}>", term.text(), definition.iri),
          "a term without ':' and '/', or the IRI that the term stands for");
    }
  }
  const bool plain = term.text().find(':') == std::string_view::npos && !has_slash;
  definition.prefix =
      plain && simple && (ends_like_a_namespace(definition.iri) || is_blank_node(definition.iri));
  return true;
}

void TermDefiner::define_implied_iri(TermDefinition& definition, const json::Value& term) {
  const std::string_view text = term.text();
  const std::size_t colon = text.find(':', 1);
  if (colon != std::string_view::npos) {
    const std::string_view prefix = text.substr(0, colon);
    define_first(prefix);
    const TermDefinition* found = context_.terms.find(prefix);
    definition.iri = found == nullptr || found->iri.empty()
                         ? text
                         : arena_.concat(found->iri, text.substr(colon + 1));
  } else if (text.find('/') != std::string_view::npos) {
    definition.iri = expand_iri(context_, text, kAsProperty, arena_);
    if (!rdf::is_absolute_iri(definition.iri)) {
      fail_at(code::kInvalidIriMapping, term,
              fmt::format("\"{}\" is a relative reference without a vocabulary", text),
              "an \"@id\" for it, or \"@vocab\"");
    }
  } else if (text == keyword::kType) {
    definition.iri = keyword::kType;
  } else if (context_.vocab.has_text()) {
    definition.iri = arena_.concat(context_.vocab.text, text);
  } else {
    fail_at(code::kInvalidIriMapping, term, fmt::format("nothing says what \"{}\" means", text),
            "an \"@id\" in its definition");
  }
}

void TermDefiner::define_index(TermDefinition& definition, const json::Value& value) {
  const json::Value* entry = value.find(keyword::kIndex);
  if (entry == nullptr) return;
  if (json_ld_10() || !definition.containers.has(Containers::kIndex)) {
    fail_at(code::kInvalidTermDefinition, *entry, "\"@index\" without an index container",
            "\"@container\": \"@index\"");
  }
  const std::string_view property =
      entry->is_string() ? expand(entry->text(), kAsProperty) : std::string_view{};
  if (!rdf::is_absolute_iri(property)) {
    fail_at(code::kInvalidTermDefinition, *entry,
            fmt::format("the property for the keys of the map is {}", describe(*entry)),
            "a term or an IRI");
  }
  definition.index = entry->text();
}

void TermDefiner::define_context(TermDefinition& definition, const json::Value& term,
                                 const json::Value& value) {
  const json::Value* entry = value.find(keyword::kContext);
  if (entry == nullptr) return;
  if (json_ld_10()) {
    fail_at(code::kInvalidTermDefinition, *entry, "a scoped context needs JSON-LD 1.1",
            "processing mode json-ld-1.1");
  }
  // Only to find errors where the context is defined and not where it is used.
  try {
    processor_.apply(context_, *entry,
                     {job_.source, /*override_protected=*/true, /*propagate=*/true,
                      /*validate_scoped=*/false, job_.remote_contexts});
  } catch (const Error& error) {
    Problem problem = error.problems().front();
    if (problem.code != code::kContextOverflow) problem.code = code::kInvalidScopedContext;
    problem.what = fmt::format("in the context of \"{}\": {}", term.text(), problem.what);
    throw Error(std::move(problem));
  }
  definition.has_context = true;
  definition.context = *entry;
}

void TermDefiner::define_language(TermDefinition& definition, const json::Value& value) {
  const json::Value* entry = value.find(keyword::kLanguage);
  if (entry == nullptr || value.find(keyword::kType) != nullptr) return;
  if (!entry->is_null() && !entry->is_string()) {
    fail_at(code::kInvalidLanguageMapping, *entry,
            fmt::format("\"@language\" is {}", describe(*entry)), "a language tag, or null");
  }
  definition.language = entry->is_null() ? Setting::null() : Setting::of(entry->text());
}

void TermDefiner::define_direction(TermDefinition& definition, const json::Value& value) {
  const json::Value* entry = value.find(keyword::kDirection);
  if (entry == nullptr || value.find(keyword::kType) != nullptr) return;
  if (!entry->is_null() && !entry->is_string("ltr") && !entry->is_string("rtl")) {
    fail_at(code::kInvalidBaseDirection, *entry,
            fmt::format("\"@direction\" is {}", describe(*entry)), "\"ltr\", \"rtl\", or null");
  }
  definition.direction = entry->is_null() ? Setting::null() : Setting::of(entry->text());
}

void TermDefiner::define_nest(TermDefinition& definition, const json::Value& value) {
  const json::Value* entry = value.find(keyword::kNest);
  if (entry == nullptr) return;
  if (json_ld_10()) {
    fail_at(code::kInvalidTermDefinition, *entry, "\"@nest\" needs JSON-LD 1.1",
            "processing mode json-ld-1.1");
  }
  if (!entry->is_string() || (is_keyword(entry->text()) && entry->text() != keyword::kNest)) {
    fail_at(code::kInvalidNestValue, *entry, fmt::format("\"@nest\" is {}", describe(*entry)),
            "\"@nest\" or an alias of it");
  }
  definition.nest = entry->text();
}

void TermDefiner::define_prefix(TermDefinition& definition, const json::Value& term,
                                const json::Value& value) {
  const json::Value* entry = value.find(keyword::kPrefix);
  if (entry == nullptr) return;
  if (json_ld_10() || term.text().find_first_of(":/") != std::string_view::npos) {
    fail_at(code::kInvalidTermDefinition, *entry,
            fmt::format("\"{}\" cannot be a prefix", term.text()), "a term without ':' and '/'");
  }
  if (!entry->is_boolean()) {
    fail_at(code::kInvalidPrefixValue, *entry, fmt::format("\"@prefix\" is {}", describe(*entry)),
            "true or false");
  }
  definition.prefix = entry->is_true();
  if (definition.prefix && is_keyword(definition.iri)) {
    fail_at(code::kInvalidTermDefinition, *entry, "an alias of a keyword is made a prefix",
            "a prefix that stands for an IRI");
  }
}

void TermDefiner::check_entries(const json::Value& value) const {
  for (const json::Member& member : value.members()) {
    if (contains(kEntries, member.name())) continue;
    fail_at(code::kInvalidTermDefinition, member.key,
            fmt::format("\"{}\" is no part of a term's definition", member.name()),
            "@id, @reverse, @type, @container, @context, @language, @direction, @index, @nest, "
            "@prefix or @protected");
  }
}

}  // namespace sinew::jsonld
