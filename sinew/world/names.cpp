#include "sinew/world/names.h"

#include <atomic>

#include "sinew/world/persistent_vector.h"

namespace sinew::world {

EditToken fresh_token() {
  static std::atomic<EditToken> last = 0;
  return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

Name Names::intern(std::string_view text) {
  const std::lock_guard lock(mutex_);
  const auto found = numbers_.find(text);
  if (found != numbers_.end()) return {found->second};
  const auto number = static_cast<std::uint32_t>(texts_.size());
  texts_.emplace_back(text);
  numbers_.emplace(texts_.back(), number);
  return {number};
}

Name Names::find(std::string_view text) const {
  const std::lock_guard lock(mutex_);
  const auto found = numbers_.find(text);
  return found == numbers_.end() ? Name{} : Name{found->second};
}

const std::string& Names::text(Name name) const {
  const std::lock_guard lock(mutex_);
  return texts_[name.value];
}

}  // namespace sinew::world
