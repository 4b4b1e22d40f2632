// All entries of a measurement, immutable, for whoever needs more than the ring's last ones: data
// can be handed on between activities without copies, for nobody ever changes it.
//
// A history is a version: it costs O(1) to take, and goes on holding what it held. An entry lives
// as long as a history or a user holds it. The world lets go of those that every declared user
// (MeasurementModel::used_by) has said to be done with; without declared users it keeps all, up to
// kMaximumHistory.
//
// Queries of the past that the ring no longer covers are answered from here, in real time too
// (published_history.h), with what corrections have made of it, back to the last entry that was let
// go. A real-time writer's entries come here by the collector (collector.h).
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sinew/world/clock.h"
#include "sinew/world/persistent_vector.h"

namespace sinew::world {

struct HistoryEntry {
  Stamp stamp;
  std::vector<double> values;
  std::string provenance;  // who wrote it
};
using HistoryEntryPointer = std::shared_ptr<const HistoryEntry>;

inline constexpr std::size_t kMaximumHistory = std::size_t{1} << 22;

// In the order in which they were written; a correction of the past is an entry like any other.
struct History {
  PersistentVector<HistoryEntryPointer> entries;  // from `first` on
  std::size_t first = 0;                          // those before are let go
  std::map<std::string, std::size_t> done;        // by user: entries before this one
  // Those later than all that were let go, by stamp, of each stamp the last that was written.
  PersistentVector<HistoryEntryPointer> by_time;  // from `first_by_time` on
  std::size_t first_by_time = 0;
  Stamp let_go_until = Stamp::min();

  std::size_t size() const { return entries.size() - first; }
  const HistoryEntryPointer& operator[](std::size_t i) const { return entries[first + i]; }
  // The place in by_time of the last entry with a stamp of at most `time`; nothing where there is
  // none.
  std::optional<std::size_t> find(Stamp time) const;
  bool covers_something() const { return first_by_time < by_time.size(); }
};

// Precondition: the history is nobody else's yet. Costs as many moves as there are later stamps.
// Several may share a token (persistent_vector.h).
void append(History& history, HistoryEntryPointer entry, EditToken token = fresh_token());
// Lets go of the entries before number `first`.
void let_go(History& history, std::size_t first);

}  // namespace sinew::world
