// The names of everything in a world: IRIs as small numbers. One dictionary serves a world and all
// its clones, so that an element has the same number in each; names are never forgotten.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <string_view>

#include "sinew/graph/slot_table.h"

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
  graph::SlotTable::Slot lookup(std::string_view text, std::uint32_t hash,
                                std::uint32_t* at = nullptr) const;

  mutable std::mutex mutex_;
  std::deque<std::string> texts_{""};
  graph::SlotTable numbers_;
};

}  // namespace sinew::world
