// What a real-time writer has written of a measurement that keeps every entry, until the collector
// (World::collect, Collector) has put it into the history: a queue between two threads, with places
// that are made when the measurement is claimed and handed back by the collector. The writer waits
// for nobody: when no place is left, the write is refused (Status::kNoRoom) and counted, and
// nothing is changed.
//
// Between ring and history there is no gap, which is what lets real-time readers answer for any
// time in between: an entry leaves the ring only when the history has it, and when all later
// entries that the history has not yet, corrections among them, are still in the ring. So the
// collector has to come before the ring has gone round once.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "sinew/world/cell.h"
#include "sinew/world/clock.h"

namespace sinew::world {

class WriteLog {
 public:
  // `entries`: those that the ring can show. `room`: how many the history has still place for.
  WriteLog(std::uint32_t values, std::uint32_t entries, std::uint64_t room)
      : values_(values),
        places_(entries > 2 ? entries - 1 : 1),
        stamps_(places_),
        numbers_(static_cast<std::size_t>(places_) * values) {
    give_room(0, room);
  }

  // ---- the writer ----

  // Whether one more entry may be written to the cell, as a correction or as the last one.
  // `inserts`: it is no replacement, so that a full ring loses its oldest entry.
  bool has_room(const Cell& cell, Stamp stamp, bool inserts) {
    const std::uint64_t limit = limit_.load(std::memory_order_acquire);
    const bool fits = written_ < limit && keeps_the_seam(cell, stamp, inserts);
    if (!fits) refused_.fetch_add(1, std::memory_order_relaxed);
    return fits;
  }
  void push(Stamp stamp, const double* values, bool is_correction) {
    const std::size_t place = written_ % places_;
    stamps_[place] = stamp;
    std::copy(values, values + values_, numbers_.data() + place * values_);
    published_.store(++written_, std::memory_order_release);
    if (is_correction) corrections_[1] = {std::min(corrections_[1].earliest, stamp), written_};
  }

  // ---- the collector ----

  // Calls visit(Stamp, const double* values) for each entry that is new, in the order of writing;
  // returns how many there are in all. Their places are the writer's again with `give_room`.
  template <typename Visit>
  std::uint64_t visit_new(Visit&& visit) const {
    const std::uint64_t end = published_.load(std::memory_order_acquire);
    for (std::uint64_t at = collected_.load(std::memory_order_relaxed); at < end; ++at) {
      const std::size_t place = at % places_;
      visit(stamps_[place], numbers_.data() + place * values_);
    }
    return end;
  }
  void give_room(std::uint64_t collected, std::uint64_t room) {
    collected_.store(collected, std::memory_order_release);
    limit_.store(collected + std::min<std::uint64_t>(places_, room), std::memory_order_release);
  }

  std::uint64_t refused() const { return refused_.load(std::memory_order_relaxed); }

 private:
  // Afterwards the ring's oldest entry is in the history, and earlier than all that is not.
  bool keeps_the_seam(const Cell& cell, Stamp stamp, bool inserts) {
    const Cell::View view = cell.view(kNow);
    const std::uint64_t oldest = cell.oldest(view);
    if (view.count < cell.capacity() - 1) return true;  // nothing leaves the ring
    const std::uint64_t next = oldest + (inserts ? 1 : 0);
    if (next >= view.count) return false;
    const Stamp seam = cell.stamp(view, next);
    if (stamp <= seam) return false;
    const std::uint64_t collected = collected_.load(std::memory_order_acquire);
    // Entries that are no corrections get later and later.
    if (collected < written_ && stamps_[collected % places_] <= seam) return false;
    if (corrections_[0].until <= collected) {
      corrections_[0] = corrections_[1];
      corrections_[1] = {};
    }
    return (corrections_[0].until <= collected || corrections_[0].earliest > seam) &&
           corrections_[1].earliest > seam;
  }

  const std::uint32_t values_;
  const std::uint32_t places_;
  std::vector<Stamp> stamps_;
  std::vector<double> numbers_;
  std::uint64_t written_ = 0;  // the writer's own
  // Corrections that the history may not have yet: those up to the next that is looked at, and
  // those after them.
  struct Corrections {
    Stamp earliest = Stamp::max();
    std::uint64_t until = 0;
  };
  Corrections corrections_[2];
  std::atomic<std::uint64_t> published_ = 0, collected_ = 0, limit_ = 0, refused_ = 0;
};

}  // namespace sinew::world
