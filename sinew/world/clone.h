// What a clone and its original differ in, and bringing back into the original what was done in the
// clone. A clone remembers the structure that it began with, so that who changed what is known.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/world/world.h"

namespace sinew::world {

struct Difference {
  enum class Kind : std::uint8_t { kAdded, kRemoved, kChanged, kWritten };
  Kind kind;
  ElementKind element;
  std::string name;  // IRI
  friend bool operator==(const Difference&, const Difference&) = default;
};
std::string_view to_string(Difference::Kind kind);

// From one world to another of its family, ordered by kind of element and age: what is in `after`
// and not in `before`, the other way round, what has other properties, and measurements whose last
// entry is another one. Structure costs what differs, values what there is.
std::vector<Difference> differences(const World& before, const World& after);

// Applies to the original what was done in its clone since it was made: elements added, removed and
// moved, and entries written. One edit. Throws Error naming every conflict, with nothing changed,
// where the original was changed meanwhile in the same place: a name taken, an element removed or
// moved, a measurement written in both, a real-time writer at work.
// Returns what was applied.
std::vector<Difference> merge(World& original, const World& clone);

}  // namespace sinew::world
