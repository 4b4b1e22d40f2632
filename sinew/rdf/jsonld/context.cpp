#include "sinew/rdf/jsonld/context.h"

#include <algorithm>
#include <cstring>
#include <functional>

namespace sinew::jsonld {

bool same_definition(const TermDefinition& a, const TermDefinition& b) {
  return a.iri == b.iri && a.type == b.type && a.language == b.language &&
         a.direction == b.direction && a.index == b.index && a.nest == b.nest &&
         a.containers == b.containers && a.prefix == b.prefix && a.reverse == b.reverse &&
         a.has_context == b.has_context && json::equal(a.context, b.context);
}

std::uint32_t* TermTable::slot(std::string_view term) const {
  const std::uint32_t mask = capacity_ * 4 - 1;
  auto position = static_cast<std::uint32_t>(std::hash<std::string_view>{}(term)) & mask;
  while (slots_[position] != 0 && entries_[slots_[position] - 1].term != term) {
    position = (position + 1) & mask;
  }
  return &slots_[position];
}

const TermDefinition* TermTable::find(std::string_view term) const {
  if (size_ == 0) return nullptr;
  const std::uint32_t found = *slot(term);
  return found == 0 ? nullptr : entries_[found - 1].definition;
}

void TermTable::grow(json::Arena& arena) {
  capacity_ = std::max<std::uint32_t>(8, capacity_ * 2);
  Entry* entries = arena.allocate<Entry>(capacity_);
  std::copy_n(entries_, size_, entries);
  entries_ = entries;
  slots_ = arena.allocate<std::uint32_t>(std::size_t{capacity_} * 4);
  std::memset(slots_, 0, std::size_t{capacity_} * 4 * sizeof(std::uint32_t));
  for (std::uint32_t i = 0; i < size_; ++i) *slot(entries_[i].term) = i + 1;
}

void TermTable::set(json::Arena& arena, std::string_view term, const TermDefinition* definition) {
  if (size_ == capacity_) grow(arena);
  std::uint32_t* found = slot(term);
  if (*found == 0) {
    entries_[size_] = {term, definition};
    *found = ++size_;
  } else {
    entries_[*found - 1].definition = definition;
  }
}

TermTable TermTable::clone(json::Arena& arena) const {
  TermTable result;
  if (size_ == 0) return result;
  result.size_ = size_;
  result.capacity_ = capacity_;
  result.entries_ = arena.allocate<Entry>(capacity_);
  std::copy_n(entries_, size_, result.entries_);
  result.slots_ = arena.allocate<std::uint32_t>(std::size_t{capacity_} * 4);
  std::copy_n(slots_, std::size_t{capacity_} * 4, result.slots_);
  return result;
}

}  // namespace sinew::jsonld
