// All entries of a measurement, immutable, for whoever needs more than the ring's last ones: data
// can be handed on between activities without copies, for nobody ever changes it.
//
// A history is a version: it costs O(1) to take, and goes on holding what it held. An entry lives
// as long as a history or a user holds it. The world lets go of those that every declared user
// (MeasurementModel::used_by) has said to be done with; without declared users it keeps all, up to
// kMaximumHistory.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
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
  std::size_t size() const { return entries.size() - first; }
  const HistoryEntryPointer& operator[](std::size_t i) const { return entries[first + i]; }
};

}  // namespace sinew::world
