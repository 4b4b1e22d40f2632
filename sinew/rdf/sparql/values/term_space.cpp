#include "sinew/rdf/sparql/values/term_space.h"

#include <fmt/format.h>

#include "sinew/base/error.h"
#include "sinew/rdf/sparql/values/xsd.h"

namespace sinew::rdf::sparql::values {

using graph::Id;
using graph::TermKind;

void TermSpace::begin(const graph::Terms& terms, std::size_t computed_bytes) {
  if (terms.size() >= kLocalBit) {
    throw Error(Problem{{},
                        {},
                        "the store has 2^31 terms or more, too many to compute with",
                        "split the store",
                        Severity::kError,
                        {}});
  }
  if (terms_ != &terms) types_ = {};
  terms_ = &terms;
  most_bytes_ = computed_bytes;
  if (entries_.empty()) return;
  entries_.clear();
  known_.clear();
  labels_.clear();
  bytes_ = 0;
}

std::string_view TermSpace::datatype(Id id) const {
  if (is_local(id)) return entry(id).datatype;
  return terms_->text(terms_->datatype(id));
}

TypeName TermSpace::type(Id id) const {
  if (is_local(id)) return {entry(id).datatype, datatype_of(entry(id).datatype)};
  const Id datatype = terms_->datatype(id);
  KnownType& known = types_[datatype.value % types_.size()];
  if (known.id != datatype) {
    const std::string_view iri = terms_->text(datatype);
    known = {datatype, {iri, datatype_of(iri)}};
  }
  return known.name;
}

Id TermSpace::add(Entry entry, std::string key) {
  constexpr std::size_t kOverhead = 200;  // of the tables, for each term
  bytes_ += entry.text.size() + entry.datatype.size() + key.size() + kOverhead;
  if (bytes_ > most_bytes_) {
    throw Error(Problem{{},
                        {},
                        fmt::format("the query computes more than {} bytes of terms", most_bytes_),
                        "filter before computing, or raise Limits::computed_bytes",
                        Severity::kError,
                        {}});
  }
  const Id id{static_cast<std::uint32_t>(entries_.size()) | kLocalBit};
  entries_.push_back(std::move(entry));
  if (!key.empty()) known_.emplace(std::move(key), id);
  return id;
}

Id TermSpace::iri(std::string_view text) {
  std::string key = "<" + std::string(text);
  if (const auto found = known_.find(key); found != known_.end()) return found->second;
  if (const Id known = terms_->find_iri(text)) return known;
  return add({TermKind::kIri, std::string(text), {}, {}}, std::move(key));
}

Id TermSpace::blank() {
  return add({TermKind::kBlank, fmt::format("c{}", entries_.size()), {}, {}}, {});
}

Id TermSpace::blank(std::string_view label) {
  const auto [found, is_new] = labels_.try_emplace(std::string(label));
  if (is_new) found->second = blank();
  return found->second;
}

Id TermSpace::literal(std::string_view lexical, std::string_view datatype,
                      std::string_view language) {
  if (datatype == kXsdString) datatype = {};
  std::string key;
  key.reserve(lexical.size() + datatype.size() + language.size() + 2);
  // No IRI and no language tag holds a control character.
  key.append(1, '"').append(language).append(1, '\x01').append(datatype).append(1, '\x01');
  key.append(lexical);
  if (const auto found = known_.find(key); found != known_.end()) return found->second;
  if (const Id known = terms_->find_literal(lexical, datatype, language)) return known;
  const std::string_view type = !language.empty()  ? kRdfLangString
                                : datatype.empty() ? kXsdString
                                                   : datatype;
  return add({TermKind::kLiteral, std::string(lexical), std::string(type), std::string(language)},
             std::move(key));
}

Id TermSpace::keep(Id id, graph::Terms& terms) {
  if (!is_local(id)) return id;
  Entry& entry = entries_[id.value & ~kLocalBit];
  if (entry.kept) return entry.kept;
  switch (entry.kind) {
    case TermKind::kIri:
      entry.kept = terms.iri(entry.text);
      break;
    case TermKind::kBlank:
      entry.kept = terms.fresh_blank();
      break;
    default:
      entry.kept = terms.literal(
          entry.text, entry.language.empty() ? entry.datatype : std::string_view{}, entry.language);
      break;
  }
  return entry.kept;
}

}  // namespace sinew::rdf::sparql::values
