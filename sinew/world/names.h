// The names of everything in a world: IRIs as small numbers. One dictionary serves a world and all
// its clones, so that an element has the same number in each; names are never forgotten.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>

namespace sinew::world {

struct Name {
  std::uint32_t value = 0;  // 0: no name
  constexpr explicit operator bool() const { return value != 0; }
  friend constexpr auto operator<=>(Name, Name) = default;
};

// Any thread; takes a lock. Not for real-time threads.
class Names {
 public:
  Name intern(std::string_view text);
  Name find(std::string_view text) const;  // 0 when nothing has that name
  // Valid as long as the dictionary. Empty for 0.
  const std::string& text(Name name) const;

 private:
  mutable std::mutex mutex_;
  std::deque<std::string> texts_{""};
  std::unordered_map<std::string_view, std::uint32_t> numbers_;
};

}  // namespace sinew::world
