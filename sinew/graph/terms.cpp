#include "sinew/graph/terms.h"

#include <fmt/format.h>

#include <cctype>
#include <cstring>
#include <iterator>

#include "sinew/base/error.h"
#include "sinew/graph/standard_iris.h"
#include "sinew/graph/terms_data.h"

namespace sinew::graph {
namespace {

constexpr std::string_view kNumericNames[] = {"decimal",
                                              "double",
                                              "float",
                                              "integer",
                                              "long",
                                              "int",
                                              "short",
                                              "byte",
                                              "nonNegativeInteger",
                                              "positiveInteger",
                                              "nonPositiveInteger",
                                              "negativeInteger",
                                              "unsignedLong",
                                              "unsignedInt",
                                              "unsignedShort",
                                              "unsignedByte"};
constexpr std::uint32_t kLastNumeric = kBuiltinFirstNumeric + std::size(kNumericNames) - 1;

std::uint64_t multiply_fold(std::uint64_t a, std::uint64_t b) {
  const auto product = static_cast<unsigned __int128>(a) * b;
  return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
}

// Sixteen bytes a step; the tail is read as two words that may overlap.
std::uint64_t hash_bytes(std::string_view text, std::uint64_t seed) {
  constexpr std::uint64_t kOdd1 = 0xA0761D6478BD642Full, kOdd2 = 0xE7037ED1A0B428DBull;
  const char* at = text.data();
  std::size_t left = text.size();
  std::uint64_t hash = seed ^ kOdd1, first = 0, second = 0;
  for (; left > 16; left -= 16, at += 16) {
    std::memcpy(&first, at, 8);
    std::memcpy(&second, at + 8, 8);
    hash = multiply_fold(first ^ kOdd2, second ^ hash);
  }
  first = second = 0;
  if (left >= 8) {
    std::memcpy(&first, at, 8);
    std::memcpy(&second, at + left - 8, 8);
  } else if (left > 0) {
    std::memcpy(&first, at, left);
  }
  return multiply_fold(first ^ kOdd2, second ^ multiply_fold(hash, kOdd1 ^ text.size()));
}

std::uint32_t hash_parts(std::uint32_t role, std::span<const Id> parts) {
  std::uint64_t hash = role;
  for (const Id part : parts) hash = multiply_fold(hash ^ 0xE7037ED1A0B428DBull, part.value + 1ull);
  return static_cast<std::uint32_t>(hash ^ hash >> 32);
}

Error term_error(std::string_view text, std::string what, std::string remedy) {
  constexpr std::size_t kShown = 80;
  Problem problem;
  problem.iri = text.substr(0, kShown);
  problem.what = std::move(what);
  problem.remedy = std::move(remedy);
  return Error(std::move(problem));
}

// fresh[0-9]+_*
bool looks_fresh(std::string_view label) {
  constexpr std::string_view kFresh = "fresh";
  if (!label.starts_with(kFresh)) return false;
  std::size_t at = kFresh.size();
  while (at < label.size() && label[at] >= '0' && label[at] <= '9') ++at;
  if (at == kFresh.size()) return false;
  return label.find_first_not_of('_', at) == std::string_view::npos;
}

}  // namespace

NumericType numeric_type_of(std::uint32_t datatype) {
  if (datatype < kBuiltinFirstNumeric || datatype > kLastNumeric) return NumericType::kNone;
  return static_cast<NumericType>(datatype - kBuiltinFirstNumeric + 1);
}

std::uint32_t hash_text(TermKind kind, std::string_view text, std::uint32_t datatype,
                        std::string_view language) {
  std::uint64_t hash = hash_bytes(text, static_cast<std::uint64_t>(kind) << 32 | datatype);
  if (!language.empty()) hash = hash_bytes(language, hash);
  return static_cast<std::uint32_t>(hash ^ hash >> 32);
}

// ---- storage ----

std::uint32_t Terms::Data::add(const TermEntry& entry) {
  const std::uint32_t count = size.load(std::memory_order_relaxed);
  if (count >= limit) {
    throw term_error({}, fmt::format("the dictionary is full: it has {} terms", count),
                     "raise the limit, or split the model");
  }
  entries.reserve(count + 1) = entry;
  size.store(count + 1, std::memory_order_release);
  return count + 1;
}

const char* Terms::Data::copy(std::string_view text, std::string_view more) {
  if (text.size() > kMaxTextSize) {
    throw term_error(text, fmt::format("a text of {} bytes", text.size()),
                     fmt::format("at most {} are possible", kMaxTextSize));
  }
  if (more.size() > kMaxLanguageSize) {
    throw term_error(text, fmt::format("a language tag of {} bytes", more.size()),
                     fmt::format("at most {} are possible", kMaxLanguageSize));
  }
  char* memory = arena.allocate(text.size() + more.size() + 1);
  if (!text.empty()) std::memcpy(memory, text.data(), text.size());
  if (!more.empty()) std::memcpy(memory + text.size(), more.data(), more.size());
  return memory;
}

std::uint32_t Terms::Data::find_text(std::uint32_t hash, TermKind kind, std::string_view text,
                                     std::uint32_t datatype, std::string_view language,
                                     std::uint32_t* at) const {
  const auto is_it = [&](SlotTable::Slot slot) {
    const TermEntry& entry = entries[slot.number()];
    return entry.kind == kind && entry.link == datatype && entry.size == text.size() &&
           entry.language_size == language.size() &&
           std::string_view(entry.text, entry.size) == text &&
           std::string_view(entry.text + entry.size, entry.language_size) == language;
  };
  const auto found = by_text.find(hash, is_it, at);
  return found.number();
}

// ---- life ----

Terms::Terms(std::uint32_t limit) : data_(std::make_unique<Data>()) {
  data_->entries.reserve(0) = {};
  iri(kXsdString);
  iri(kRdfLangString);
  iri(kXsdBoolean);
  for (const std::string_view name : kNumericNames) iri(fmt::format("{}{}", kXsd, name));
  data_->limit = limit;
}

Terms::Terms(std::unique_ptr<Data> data) : data_(std::move(data)) {}
Terms::~Terms() = default;

std::unique_ptr<Terms> Terms::clone() const {
  const std::lock_guard lock(data_->demand);
  const Data& from = *data_;
  auto to = std::make_unique<Data>();
  const std::uint32_t count = from.size.load();
  to->limit = from.limit;
  to->size = count;
  to->entries.copy_from(from.entries, count + 1);
  to->by_text.copy_from(from.by_text);
  to->derived_size = from.derived_size;
  to->derived.copy_from(from.derived, from.derived_size);
  to->derived_ids.copy_from(from.derived_ids, from.derived_size);
  to->by_parts.copy_from(from.by_parts);
  to->same_as_text = from.same_as_text;
  to->derived_by_text = from.derived_by_text;
  to->derived_named = from.derived_named;
  to->prefixed_iris = from.prefixed_iris.load();
  to->derived_published = from.derived_published.load();
  to->arena.share(from.arena);
  to->demand_arena.share(from.demand_arena);
  return std::unique_ptr<Terms>(new Terms(std::move(to)));
}

// ---- interning ----

Id Terms::iri(std::string_view text) {
  const std::uint32_t hash = hash_text(TermKind::kIri, text);
  std::uint32_t at = 0;
  if (const auto found = data_->find_text(hash, TermKind::kIri, text, 0, {}, &at)) return {found};
  if (text.starts_with(kDerivedPrefix)) {
    {
      const std::lock_guard lock(data_->demand);
      if (const auto found = data_->find_derived_text(text)) return {found};
    }
    ++data_->prefixed_iris;
  }
  const auto size = static_cast<std::uint32_t>(text.size());
  const char* copied = data_->copy(text);
  const std::uint32_t id = data_->add({copied, 0, size, 0, 0, TermKind::kIri, false});
  data_->by_text.insert(at, hash, id);
  return {id};
}

Id Terms::blank(std::string_view label) {
  std::string renamed;
  if (looks_fresh(label)) label = renamed = std::string(label) + '_';
  const std::uint32_t hash = hash_text(TermKind::kBlank, label);
  std::uint32_t at = 0;
  const auto found = data_->find_text(hash, TermKind::kBlank, label, 0, {}, &at);
  if (found) return {found};
  const auto size = static_cast<std::uint32_t>(label.size());
  const char* copied = data_->copy(label);
  const std::uint32_t id = data_->add({copied, 0, size, 0, 0, TermKind::kBlank, false});
  data_->by_text.insert(at, hash, id);
  return {id};
}

Id Terms::fresh_blank() { return {data_->add({nullptr, 0, 0, 0, 0, TermKind::kBlank, false})}; }

Id Terms::literal(std::string_view lexical, std::string_view datatype, std::string_view language) {
  Id type{kBuiltinString};
  if (!language.empty()) {
    type = Id{kBuiltinLangString};
  } else if (!datatype.empty()) {
    type = iri(datatype);
  }
  const std::uint32_t hash = hash_text(TermKind::kLiteral, lexical, type.value, language);
  std::uint32_t at = 0;
  const auto found = data_->find_text(hash, TermKind::kLiteral, lexical, type.value, language, &at);
  if (found) return {found};
  const char* copied = data_->copy(lexical, language);
  const auto number = parse_number(lexical, numeric_type_of(type.value));
  const std::uint32_t id = data_->add(
      {copied, number.value_or(0), static_cast<std::uint32_t>(lexical.size()), type.value,
       static_cast<std::uint16_t>(language.size()), TermKind::kLiteral, number.has_value()});
  data_->by_text.insert(at, hash, id);
  return {id};
}

Id Terms::literal(std::string_view lexical, Id datatype) {
  if (!datatype || datatype.value == kBuiltinString) return literal(lexical);
  const std::uint32_t hash = hash_text(TermKind::kLiteral, lexical, datatype.value);
  const auto found = data_->find_text(hash, TermKind::kLiteral, lexical, datatype.value, {});
  if (found) return {found};
  return literal(lexical, text(datatype));
}

Id Terms::integer(std::int64_t value) {
  const fmt::format_int text(value);
  return literal({text.data(), text.size()},
                 Id{kBuiltinFirstNumeric + static_cast<std::uint32_t>(NumericType::kInteger) - 1});
}

Id Terms::real(double value) {
  return literal(double_text(value),
                 Id{kBuiltinFirstNumeric + static_cast<std::uint32_t>(NumericType::kDouble) - 1});
}

Id Terms::boolean(bool value) { return literal(value ? "true" : "false", Id{kBuiltinBoolean}); }

Id Terms::derived(Id role, std::initializer_list<Id> parts) {
  return derived(role, std::span<const Id>(parts.begin(), parts.size()));
}

Id Terms::derived(Id role, std::span<const Id> parts) {
  Data& data = *data_;
  const std::uint32_t hash = hash_parts(role.value, parts);
  const auto is_it = [&](SlotTable::Slot slot) {
    const DerivedEntry& entry = data.derived[slot.number() - 1];
    if (entry.role != role.value || entry.count != parts.size()) return false;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (entry.parts[i] != parts[i].value) return false;
    }
    return true;
  };
  std::uint32_t at = 0;
  const SlotTable::Slot known = data.by_parts.find(hash, is_it, &at);
  if (const std::uint32_t found = known.number()) {
    const std::uint32_t id = data.derived_ids[found - 1];
    const auto same = data.same_as_text.find(id);
    return {same == data.same_as_text.end() ? id : same->second};
  }

  auto* copied = reinterpret_cast<std::uint32_t*>(
      data.arena.allocate(parts.size() * sizeof(std::uint32_t), alignof(std::uint32_t)));
  for (std::size_t i = 0; i < parts.size(); ++i) copied[i] = parts[i].value;
  const std::uint32_t number = data.derived_size;
  data.derived.reserve(number) = {copied, role.value, static_cast<std::uint32_t>(parts.size())};
  const std::uint32_t id = data.add({nullptr, 0, 0, number, 0, TermKind::kDerived, false});
  data.derived_ids.reserve(number) = id;
  data.derived_size = number + 1;
  data.by_parts.insert(at, hash, number + 1);
  if (data.prefixed_iris.load() > 0) {
    const std::string_view name = text(Id{id});
    const auto same = data.find_text(hash_text(TermKind::kIri, name), TermKind::kIri, name, 0, {});
    if (same) {
      data.same_as_text.emplace(id, same);
      return {same};
    }
  }
  data.derived_published.store(number + 1, std::memory_order_release);
  return {id};
}

// ---- looking up ----

Id Terms::find_iri(std::string_view text) const {
  const std::uint32_t hash = hash_text(TermKind::kIri, text);
  if (const auto found = data_->find_text(hash, TermKind::kIri, text, 0, {})) return {found};
  if (!text.starts_with(kDerivedPrefix)) return {};
  const std::lock_guard lock(data_->demand);
  return {data_->find_derived_text(text)};
}

Id Terms::find_blank(std::string_view label) const {
  std::string renamed;
  if (looks_fresh(label)) label = renamed = std::string(label) + '_';
  return {data_->find_text(hash_text(TermKind::kBlank, label), TermKind::kBlank, label, 0, {})};
}

Id Terms::find_literal(std::string_view lexical, std::string_view datatype,
                       std::string_view language) const {
  Id type{kBuiltinString};
  if (!language.empty()) {
    type = Id{kBuiltinLangString};
  } else if (!datatype.empty()) {
    type = find_iri(datatype);
    if (!type) return {};
  }
  const std::uint32_t hash = hash_text(TermKind::kLiteral, lexical, type.value, language);
  return {data_->find_text(hash, TermKind::kLiteral, lexical, type.value, language)};
}

std::size_t Terms::size() const { return data_->size.load(std::memory_order_acquire); }

}  // namespace sinew::graph
