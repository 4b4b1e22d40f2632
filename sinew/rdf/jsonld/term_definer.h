// Makes the term definitions of one context definition (JSON-LD 1.1 API, section 4.2). Terms may
// depend on each other in any order, so that defining one may first define others.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "sinew/rdf/jsonld/context_processor.h"

namespace sinew::jsonld {

// Terms that depend on terms that depend on terms ...: beyond this, "context overflow".
inline constexpr std::size_t kMaxTermDependencies = 500;

class TermDefiner {
 public:
  // Defines terms in `context`, as the object `local` says.
  TermDefiner(ContextProcessor& processor, Context& context, const json::Value& local,
              const ContextProcessor::Job& job);

  void define_all();
  // Defines the term if `local` has it and it is not defined yet.
  void define_first(std::string_view term);
  std::string_view expand(std::string_view text, IriUse use);

 private:
  enum class Progress : std::uint8_t { kOpen, kUnderWay, kDone };

  void define(const json::Member& member);
  void define_term(const json::Member& member, Progress& progress);
  bool define_iri(TermDefinition& definition, const json::Value& term, const json::Value& value,
                  bool simple, Progress& progress);
  bool define_reverse(TermDefinition& definition, const json::Value& value);
  bool define_id(TermDefinition& definition, const json::Value& term, const json::Value& id,
                 bool simple, Progress& progress);
  void define_implied_iri(TermDefinition& definition, const json::Value& term);
  void define_type(TermDefinition& definition, const json::Value& value);
  void define_containers(TermDefinition& definition, const json::Value& value);
  void define_index(TermDefinition& definition, const json::Value& value);
  void define_context(TermDefinition& definition, const json::Value& term,
                      const json::Value& value);
  void define_language(TermDefinition& definition, const json::Value& value);
  void define_direction(TermDefinition& definition, const json::Value& value);
  void define_nest(TermDefinition& definition, const json::Value& value);
  void define_prefix(TermDefinition& definition, const json::Value& term, const json::Value& value);
  bool is_protected(const json::Value& value) const;
  void check_entries(const json::Value& value) const;
  void check_keyword(const json::Value& term, const json::Value& value) const;
  bool json_ld_10() const;
  [[noreturn]] void fail_at(std::string_view code, const json::Value& at, std::string what,
                            std::string remedy) const;

  ContextProcessor& processor_;
  json::Arena& arena_;
  Context& context_;
  const json::Value& local_;
  const ContextProcessor::Job& job_;
  bool protected_by_default_ = false;
  std::size_t depth_ = 0;
  std::vector<Progress> progress_;  // of each member of local_
};

}  // namespace sinew::jsonld
