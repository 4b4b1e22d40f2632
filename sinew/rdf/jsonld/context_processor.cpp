#include "sinew/rdf/jsonld/context_processor.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/rdf/jsonld/iri_expansion.h"
#include "sinew/rdf/jsonld/term_definer.h"

namespace sinew::jsonld {

std::string_view expand_iri(const Context& context, std::string_view text, IriUse use,
                            json::Arena& arena) {
  return expand_iri_with(context, text, use, arena, [](std::string_view) {});
}

std::size_t ContextProcessor::KeyHash::operator()(const Key& key) const {
  const std::size_t active = reinterpret_cast<std::size_t>(key.active);
  const std::size_t local = reinterpret_cast<std::size_t>(key.local);
  return (active * 0x9E3779B97F4A7C15ull ^ local) * 4 + (key.override_protected ? 2 : 0) +
         (key.propagate ? 1 : 0);
}

const Context* ContextProcessor::initial(std::string_view base) {
  Context* result = new (arena_.allocate<Context>()) Context{};
  if (!base.empty()) {
    result->base = Setting::of(base);
    result->original_base = base;
  }
  return result;
}

Context* ContextProcessor::clone(const Context& context) {
  Context* result = new (arena_.allocate<Context>()) Context(context);
  result->terms = context.terms.clone(arena_);
  return result;
}

const Context* ContextProcessor::process(const Context* active, const json::Value& local,
                                         const Source& source, Flags flags) {
  const Job job{source, flags.override_protected, flags.propagate, true, {}};
  // A document is known by its address, so that every place that names it shares the result.
  const void* identity = local.identity();
  if (local.is_string()) {
    identity = &remote_documents_.context_document(resolve(local, job),
                                                   place_in(source, local.position()));
  }
  const Key key{active, identity, flags.override_protected, flags.propagate};
  if (const auto found = processed_.find(key); found != processed_.end()) return found->second;
  const Context* result = apply(*active, local, job);
  processed_.emplace(key, result);
  return result;
}

Context* ContextProcessor::apply(const Context& active, const json::Value& local, Job job) {
  if (++count_ > kMaxProcessedContexts) {
    fail(code::kContextOverflow, place_in(job.source, local.position()), "",
         fmt::format("more than {} contexts to process", kMaxProcessedContexts),
         "contexts that include each other less often");
  }
  if (const json::Value* propagate = local.find(keyword::kPropagate)) {
    if (propagate->is_boolean()) job.propagate = propagate->is_true();
  }
  Context* result = clone(active);
  if (!job.propagate && result->previous == nullptr) result->previous = &active;

  const std::span<const json::Value> items =
      local.is_array() ? local.items() : std::span(&local, 1);
  for (const json::Value& context : items) {
    switch (context.kind()) {
      case json::Kind::kNull:
        result = apply_null(active, *result, context, job);
        break;
      case json::Kind::kString:
        result = apply_remote(*result, context, job);
        break;
      case json::Kind::kObject:
        apply_definition(*result, context, job);
        break;
      default:
        fail(code::kInvalidLocalContext, place_in(job.source, context.position()), "",
             fmt::format("a context is {}", describe(context)),
             "an IRI, an object with definitions of terms, null, or an array of these");
    }
  }
  return result;
}

Context* ContextProcessor::apply_null(const Context& active, const Context& result,
                                      const json::Value& null, const Job& job) {
  if (!job.override_protected && result.has_protected_terms) {
    fail(code::kInvalidContextNullification, place_in(job.source, null.position()), "",
         "null would remove protected terms", "a context that leaves protected terms alone");
  }
  Context* cleared = new (arena_.allocate<Context>()) Context{};
  cleared->original_base = active.original_base;
  if (!active.original_base.empty()) cleared->base = Setting::of(active.original_base);
  if (!job.propagate) cleared->previous = &result;
  return cleared;
}

std::string_view ContextProcessor::resolve(const json::Value& reference, const Job& job) {
  const auto url = rdf::resolve_iri(reference.text(), job.source.url);
  if (!url) {
    fail(code::kLoadingDocumentFailed, place_in(job.source, reference.position()),
         std::string(reference.text()), "a relative reference to a context, but no base IRI",
         "an absolute IRI");
  }
  return arena_.copy(*url);
}

Context* ContextProcessor::apply_remote(const Context& result, const json::Value& reference,
                                        const Job& job) {
  const std::string_view url = resolve(reference, job);
  const Place place = place_in(job.source, reference.position());
  const bool on_the_way = std::find(job.remote_contexts.begin(), job.remote_contexts.end(), url) !=
                          job.remote_contexts.end();
  if (on_the_way && !job.validate_scoped) return clone(result);
  if (on_the_way) {
    fail(code::kContextOverflow, place, std::string(url), "the context includes itself",
         "contexts that include each other without a circle");
  }
  if (job.remote_contexts.size() >= kMaxNestedRemoteContexts) {
    fail(code::kContextOverflow, place, std::string(url),
         fmt::format("contexts include each other more than {} deep", kMaxNestedRemoteContexts),
         "a shorter chain of contexts");
  }
  const RemoteDocument& remote = remote_documents_.context_document(url, place);
  Job inner{remote.source(), job.override_protected, true, job.validate_scoped,
            job.remote_contexts};
  inner.remote_contexts.push_back(url);
  return apply(result, remote.context, std::move(inner));
}

void ContextProcessor::require_json_ld_11(std::string_view error_code, std::string_view what,
                                          const json::Value& value, const Job& job) const {
  if (options_.processing_mode == ProcessingMode::kJsonLd11) return;
  fail(error_code, place_in(job.source, value.position()), "",
       fmt::format("{} needs JSON-LD 1.1", what), "processing mode json-ld-1.1");
}

void ContextProcessor::check_version(const json::Value& value, const Job& job) const {
  if (!value.is_number() || value.number() != 1.1) {
    fail(code::kInvalidVersionValue, place_in(job.source, value.position()), "",
         fmt::format("\"@version\" is {}", describe(value)), "the number 1.1");
  }
  require_json_ld_11(code::kProcessingModeConflict, "\"@version\": 1.1", value, job);
}

json::Value ContextProcessor::import_into(const json::Value& local, const Job& job) {
  const json::Value& reference = *local.find(keyword::kImport);
  require_json_ld_11(code::kInvalidContextEntry, "\"@import\"", reference, job);
  const Place place = place_in(job.source, reference.position());
  if (!reference.is_string()) {
    fail(code::kInvalidImportValue, place, "",
         fmt::format("\"@import\" is {}", describe(reference)), "the IRI of one context");
  }
  const RemoteDocument& remote = remote_documents_.context_document(resolve(reference, job), place);
  const Place remote_place = place_in(remote.source(), remote.context.position());
  if (!remote.context.is_object()) {
    fail(code::kInvalidRemoteContext, remote_place, remote.url,
         fmt::format("the imported context is {}", describe(remote.context)),
         "an object with definitions of terms");
  }
  if (remote.context.find(keyword::kImport) != nullptr) {
    fail(code::kInvalidContextEntry, remote_place, remote.url,
         "an imported context imports another one", "a context without \"@import\"");
  }
  json::Value merged = json::Value::object(arena_, local.position());
  for (const json::Member& member : remote.context.members()) {
    merged.add(arena_, member.key, member.value);
  }
  for (const json::Member& member : local.members()) merged.set(arena_, member.key, member.value);
  return merged;
}

void ContextProcessor::apply_definition(Context& result, const json::Value& local, const Job& job) {
  if (const json::Value* version = local.find(keyword::kVersion)) check_version(*version, job);
  const json::Value merged =
      local.find(keyword::kImport) == nullptr ? local : import_into(local, job);
  const json::Value* base = merged.find(keyword::kBase);
  // A document that is included must not change what relative references mean in the one that
  // includes it.
  if (base != nullptr && job.remote_contexts.empty()) apply_base(result, *base, job);
  if (const json::Value* value = merged.find(keyword::kVocab)) apply_vocab(result, *value, job);
  if (const json::Value* value = merged.find(keyword::kLanguage)) {
    apply_language(result, *value, job);
  }
  if (const json::Value* value = merged.find(keyword::kDirection)) {
    apply_direction(result, *value, job);
  }
  if (const json::Value* value = merged.find(keyword::kPropagate)) {
    require_json_ld_11(code::kInvalidContextEntry, "\"@propagate\"", *value, job);
    if (!value->is_boolean()) {
      fail(code::kInvalidPropagateValue, place_in(job.source, value->position()), "",
           fmt::format("\"@propagate\" is {}", describe(*value)), "true or false");
    }
  }
  TermDefiner(*this, result, merged, job).define_all();
}

void ContextProcessor::apply_base(Context& result, const json::Value& value, const Job& job) {
  if (value.is_null()) {
    result.base = Setting::null();
    return;
  }
  if (value.is_string() && rdf::is_absolute_iri(value.text())) {
    result.base = Setting::of(value.text());
    return;
  }
  if (value.is_string() && result.base.has_text()) {
    if (const auto resolved = rdf::resolve_iri(value.text(), result.base.text)) {
      result.base = Setting::of(arena_.copy(*resolved));
      return;
    }
  }
  fail(code::kInvalidBaseIri, place_in(job.source, value.position()), "",
       fmt::format("\"@base\" is {}", describe(value)),
       "null, an absolute IRI, or a relative one where there is a base already");
}

void ContextProcessor::apply_vocab(Context& result, const json::Value& value, const Job& job) {
  if (value.is_null()) {
    result.vocab = {};
    return;
  }
  const auto refuse = [&] {
    fail(code::kInvalidVocabMapping, place_in(job.source, value.position()), "",
         fmt::format("\"@vocab\" is {}", describe(value)), "an IRI, or null");
  };
  if (!value.is_string()) refuse();
  const bool relative = !is_iri_or_blank_node(value.text());
  if (relative && options_.processing_mode == ProcessingMode::kJsonLd10) refuse();
  const std::string_view iri = expand_iri(result, value.text(), kAsType, arena_);
  if (!is_iri_or_blank_node(iri)) refuse();
  result.vocab = Setting::of(iri);
}

void ContextProcessor::apply_language(Context& result, const json::Value& value, const Job& job) {
  if (!value.is_null() && !value.is_string()) {
    fail(code::kInvalidDefaultLanguage, place_in(job.source, value.position()), "",
         fmt::format("\"@language\" is {}", describe(value)), "a language tag, or null");
  }
  result.language = value.is_null() ? Setting{} : Setting::of(value.text());
}

void ContextProcessor::apply_direction(Context& result, const json::Value& value, const Job& job) {
  require_json_ld_11(code::kInvalidContextEntry, "\"@direction\"", value, job);
  if (!value.is_null() && !value.is_string("ltr") && !value.is_string("rtl")) {
    fail(code::kInvalidBaseDirection, place_in(job.source, value.position()), "",
         fmt::format("\"@direction\" is {}", describe(value)), "\"ltr\", \"rtl\", or null");
  }
  result.direction = value.is_null() ? Setting{} : Setting::of(value.text());
}

}  // namespace sinew::jsonld
