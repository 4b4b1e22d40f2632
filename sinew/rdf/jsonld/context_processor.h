// Context processing: from what a document writes under "@context" to a Context (JSON-LD 1.1 API,
// section 4), and the meaning of a single text in a context (section 5.2).
#pragma once

#include <cstddef>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "sinew/rdf/jsonld/context.h"
#include "sinew/rdf/jsonld/options.h"
#include "sinew/rdf/jsonld/remote_documents.h"

namespace sinew::jsonld {

// Beyond these, "context overflow".
inline constexpr std::size_t kMaxNestedRemoteContexts = 64;
inline constexpr std::size_t kMaxProcessedContexts = 1'000'000;

// How a text that may be a term, a compact IRI or a relative reference is read.
struct IriUse {
  bool document_relative = false;  // against the base IRI
  bool vocab = false;              // as a term, or against the vocabulary mapping
};
inline constexpr IriUse kAsProperty{false, true};
inline constexpr IriUse kAsType{true, true};
inline constexpr IriUse kAsId{true, false};

// IRI expansion. The result is an IRI, a blank node, a keyword, or the text itself where nothing
// applies; a null view (data() == nullptr) where the text means nothing.
std::string_view expand_iri(const Context& context, std::string_view text, IriUse use,
                            json::Arena& arena);

class ContextProcessor {
 public:
  // Everything made lies in the arena. All three must outlive the processor.
  ContextProcessor(json::Arena& arena, RemoteDocuments& remote_documents, const Options& options)
      : arena_(arena), remote_documents_(remote_documents), options_(options) {}

  const Context* initial(std::string_view base);

  struct Flags {
    bool override_protected = false;
    bool propagate = true;
  };
  // The context that `local` makes of `active`. `source` is where `local` stands. Results are kept:
  // asking for the same again costs a look-up.
  const Context* process(const Context* active, const json::Value& local, const Source& source,
                         Flags flags);
  const Context* process(const Context* active, const json::Value& local, const Source& source) {
    return process(active, local, source, Flags{});
  }

  json::Arena& arena() { return arena_; }
  const Options& options() const { return options_; }

 private:
  friend class TermDefiner;
  using RemoteContexts = std::vector<std::string_view>;  // the URLs on the way here

  struct Job {
    Source source;
    bool override_protected;
    bool propagate;
    bool validate_scoped;
    RemoteContexts remote_contexts;
  };
  Context* apply(const Context& active, const json::Value& local, Job job);
  Context* apply_null(const Context& active, const Context& result, const json::Value& null,
                      const Job& job);
  Context* apply_remote(const Context& result, const json::Value& url, const Job& job);
  json::Value import_into(const json::Value& local, const Job& job);
  void apply_definition(Context& result, const json::Value& local, const Job& job);
  void apply_base(Context& result, const json::Value& value, const Job& job);
  void apply_vocab(Context& result, const json::Value& value, const Job& job);
  void apply_language(Context& result, const json::Value& value, const Job& job);
  void apply_direction(Context& result, const json::Value& value, const Job& job);
  void check_version(const json::Value& value, const Job& job) const;
  void require_json_ld_11(std::string_view code, std::string_view what, const json::Value& value,
                          const Job& job) const;
  std::string_view resolve(const json::Value& reference, const Job& job);
  Context* clone(const Context& context);

  struct Key {
    const Context* active;
    const void* local;
    bool override_protected, propagate;
    friend bool operator==(const Key&, const Key&) = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& key) const;
  };

  json::Arena& arena_;
  RemoteDocuments& remote_documents_;
  const Options& options_;
  std::unordered_map<Key, const Context*, KeyHash> processed_;
  std::size_t count_ = 0;
};

}  // namespace sinew::jsonld
