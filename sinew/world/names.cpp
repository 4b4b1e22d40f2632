#include "sinew/world/names.h"

#include <atomic>
#include <functional>

#include "sinew/world/persistent_vector.h"

namespace sinew::world {

EditToken fresh_token() {
  static std::atomic<EditToken> last = 0;
  return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

namespace {

std::uint32_t hash_of(std::string_view text) {
  const std::uint64_t hash = std::hash<std::string_view>()(text);
  return static_cast<std::uint32_t>(hash ^ hash >> 32);
}

}  // namespace

graph::SlotTable::Slot Names::lookup(std::string_view text, std::uint32_t hash,
                                     std::uint32_t* at) const {
  const auto is_it = [&](graph::SlotTable::Slot slot) { return texts_[slot.number()] == text; };
  return numbers_.find(hash, is_it, at);
}

Name Names::intern(std::string_view text) {
  const std::uint32_t hash = hash_of(text);
  const std::lock_guard lock(mutex_);
  std::uint32_t at = 0;
  if (const auto found = lookup(text, hash, &at)) return {found.number()};
  const auto number = static_cast<std::uint32_t>(texts_.size());
  texts_.emplace_back(text);
  numbers_.insert(at, hash, number);
  return {number};
}

Name Names::find(std::string_view text) const {
  const std::uint32_t hash = hash_of(text);
  const std::lock_guard lock(mutex_);
  return {lookup(text, hash).number()};
}

const std::string& Names::text(Name name) const {
  const std::lock_guard lock(mutex_);
  return texts_[name.value];
}

}  // namespace sinew::world
