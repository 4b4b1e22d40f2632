#include "sinew/world/names.h"

#include <atomic>
#include <functional>

#include "sinew/world/persistent_vector.h"

namespace sinew::world {

EditToken fresh_token() {
  static std::atomic<EditToken> last = 0;
  return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

std::uint32_t Names::hash_of(std::string_view text) {
  const std::uint64_t hash = std::hash<std::string_view>()(text);
  return static_cast<std::uint32_t>(hash ^ hash >> 32);
}

graph::SlotTable::Slot Names::lookup(std::string_view text, std::uint32_t hash,
                                     std::uint32_t* at) const {
  const auto is_it = [&](graph::SlotTable::Slot slot) {
    const Text& known = texts_.listed(slot.number());
    return std::string_view(known.begin, known.size) == text;
  };
  return numbers_.find(hash, is_it, at);
}

std::uint32_t Names::ask_for(std::string_view text) const {
  const std::uint32_t hash = hash_of(text);
  numbers_.prefetch(hash);
  return hash;
}

Name Names::intern(std::string_view text, std::uint32_t hash) {
  const std::lock_guard lock(mutex_);
  std::uint32_t at = 0;
  if (const auto found = lookup(text, hash, &at)) return {found.number()};
  char* const kept = memory_.allocate(text.size());
  text.copy(kept, text.size());
  const std::uint32_t number = last_ + 1;
  texts_.reserve(number) = {kept, text.size(), nullptr};
  numbers_.insert(at, hash, number);
  last_ = number;
  return {number};
}

Name Names::find(std::string_view text) const {
  const std::uint32_t hash = hash_of(text);
  const std::lock_guard lock(mutex_);
  return {lookup(text, hash).number()};
}

const std::string& Names::text(Name name) const {
  static const std::string empty;
  if (!name) return empty;
  const std::lock_guard lock(mutex_);
  const Text& text = texts_[name.value];
  if (!text.made) text.made = &made_.emplace_back(text.begin, text.size);
  return *text.made;
}

}  // namespace sinew::world
