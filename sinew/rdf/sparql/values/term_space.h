// The terms of one evaluation: those of the store, and those that expressions compute.
//
// A computed term that the store has keeps the store's id; any other gets an id with the highest
// bit set, valid for this evaluation only. So equal terms have equal ids here, too, the store is
// not written while a query runs, and what no result shows is forgotten. `keep` moves a computed
// term into the store's dictionary, for results.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "sinew/graph/terms.h"
#include "sinew/rdf/sparql/values/xsd.h"

namespace sinew::rdf::sparql::values {

inline constexpr std::uint32_t kLocalBit = 0x80000000u;
inline bool is_local(graph::Id id) { return (id.value & kLocalBit) != 0; }

// A literal's datatype, as its IRI and as what we know of it.
struct TypeName {
  std::string_view iri;
  Datatype datatype = Datatype::kOther;
};

class TermSpace {
 public:
  // Forgets all computed terms, keeping memory. `computed_bytes` bounds what may be computed.
  void begin(const graph::Terms& terms, std::size_t computed_bytes);

  graph::Id iri(std::string_view text);
  graph::Id blank();                        // a new one
  graph::Id blank(std::string_view label);  // the same for the same label, until they are forgotten
  void forget_labels() {
    if (!labels_.empty()) labels_.clear();
  }
  graph::Id literal(std::string_view lexical, std::string_view datatype = {},
                    std::string_view language = {});

  graph::TermKind kind(graph::Id id) const {
    return is_local(id) ? entry(id).kind : terms_->kind(id);
  }
  std::string_view text(graph::Id id) const {
    return is_local(id) ? std::string_view(entry(id).text) : terms_->text(id);
  }
  // The datatype's IRI.
  std::string_view datatype(graph::Id id) const;
  TypeName type(graph::Id id) const;
  std::string_view language(graph::Id id) const {
    return is_local(id) ? std::string_view(entry(id).language) : terms_->language(id);
  }
  const graph::Terms& terms() const { return *terms_; }

  // The id in `terms`, which must be the ones given to `begin`.
  graph::Id keep(graph::Id id, graph::Terms& terms);

 private:
  struct Entry {
    graph::TermKind kind;
    std::string text, datatype, language;
    graph::Id kept = {};
  };
  const Entry& entry(graph::Id id) const { return entries_[id.value & ~kLocalBit]; }
  graph::Id add(Entry entry, std::string key);

  const graph::Terms* terms_ = nullptr;
  // Datatypes of the store that were met before, by the last bits of their ids.
  struct KnownType {
    graph::Id id;
    TypeName name;
  };
  mutable std::array<KnownType, 16> types_ = {};
  std::vector<Entry> entries_;
  std::unordered_map<std::string, graph::Id> known_;
  std::unordered_map<std::string, graph::Id> labels_;
  std::size_t bytes_ = 0;
  std::size_t most_bytes_ = 0;
};

}  // namespace sinew::rdf::sparql::values
