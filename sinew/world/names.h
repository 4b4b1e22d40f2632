// The names of everything in a world: IRIs as small numbers. One dictionary serves a world and all
// its clones, so that an element has the same number in each; names are never forgotten. Their
// texts lie one after the other; a std::string of one is made when it is first asked for.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <string_view>

#include "sinew/graph/arena.h"
#include "sinew/graph/slot_table.h"
#include "sinew/graph/stable_array.h"

namespace sinew::world {

struct Name {
  std::uint32_t value = 0;  // 0: no name
  constexpr explicit operator bool() const { return value != 0; }
  friend constexpr auto operator<=>(Name, Name) = default;
};

// Any thread; takes a lock. Not for real-time threads.
class Names {
 public:
  Name intern(std::string_view text) { return intern(text, hash_of(text)); }
  // The same in two steps: where the text will be looked for is asked for first, and has come when
  // something else was done in between.
  std::uint32_t ask_for(std::string_view text) const;
  Name intern(std::string_view text, std::uint32_t asked);
  Name find(std::string_view text) const;  // 0 when nothing has that name
  // Valid as long as the dictionary. Empty for 0.
  const std::string& text(Name name) const;

 private:
  struct Text {
    const char* begin;
    std::uint64_t size;
    mutable const std::string* made;  // once somebody has asked for it; few are asked for
  };
  static std::uint32_t hash_of(std::string_view text);
  graph::SlotTable::Slot lookup(std::string_view text, std::uint32_t hash,
                                std::uint32_t* at = nullptr) const;

  mutable std::mutex mutex_;
  std::uint32_t last_ = 0;
  graph::StableArray<Text, graph::Fill::kZero> texts_;  // 1 .. last_; 0 is empty
  graph::Arena memory_;
  mutable std::deque<std::string> made_;
  graph::SlotTable numbers_;
};

}  // namespace sinew::world
