// Reading one measurement out of its cell: the last entry or the state at a time, with the
// life-cycle applied and the freshness noted. Under every query.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>

#include "sinew/world/plan.h"

namespace sinew::world {

// Freshness while it is collected.
struct Gathered {
  Stamp oldest = Stamp::max(), newest = Stamp::min();
  Stamp expires = Stamp::max();
  std::uint64_t missed = 0;
  std::uint32_t used = 0, expired = 0;
  bool predicted = false;

  [[gnu::always_inline]] void add(const Candidate& from, Stamp stamp, Stamp now) {
    ++used;
    if (from.is_static) return;
    oldest = std::min(oldest, stamp);
    newest = std::max(newest, stamp);
    if (!from.is_timed) return;
    Stamp until = from.expiry;
    if (from.validity != kForever) until = std::min(until, stamp + from.validity);
    expires = std::min(expires, until);
    if (now > until) ++expired;
    if (from.period != kForever && now > stamp) {
      missed += static_cast<std::uint64_t>((now - stamp) / from.period);
    }
  }
  Freshness at(Stamp now) const {
    Freshness freshness;
    if (oldest != Stamp::max()) {
      freshness.currency = now - oldest;
      freshness.timeliness = now - newest;
    }
    freshness.obsolescence = missed;
    freshness.rate = used == 0 ? 1.0 : 1.0 - static_cast<double>(expired) / used;
    freshness.expires = expires;
    freshness.predicted = predicted;
    return freshness;
  }
};

// What reading one cell led to; the entries from `first` on were used.
struct CellReading {
  Status status = Status::kOk;
  std::uint64_t first = 0;
};

// The last entry's numbers, predicted to `now` if the measurement has a model; `values` has room
// for as many as the cell holds.
CellReading read_last(const Candidate& from, const Cell::View& view, Stamp now, double* values,
                      Gathered& gathered);
// The numbers at `time`: between two entries, at one, or after the last by the model.
CellReading read_between(const Candidate& from, const Cell::View& view, Stamp time, double* values,
                         Gathered& gathered);

// The same from all entries that are kept; kTooOld before them, kBusy after them (the ring has what
// came since this version).
Status read_past(const Candidate& from, const History& history, Stamp time, double* values,
                 Gathered& gathered);

// From one to the other, share 0 .. 1.
void interpolate(Interpolation how, Quantity quantity, std::uint32_t size, const double* from,
                 const double* to, double share, double* values);

// With a history, what that covers as well.
Bounds bounds_of(const Candidate& from, const Cell::View& view, const History* history = nullptr);

// A pose's numbers, and the stamp before them, straight from a ring.
inline Pose load_entry(const std::atomic<std::uint64_t>* words) {
  const auto number = [words](int i) {
    return std::bit_cast<double>(words[i].load(std::memory_order_acquire));
  };
  return {{number(1), number(2), number(3), number(4)}, {number(5), number(6), number(7)}};
}
inline Stamp load_stamp(const std::atomic<std::uint64_t>* words) {
  return stamp_of_ns(static_cast<std::int64_t>(words[0].load(std::memory_order_acquire)));
}

inline Pose load_pose(const double* at) {
  return {{at[0], at[1], at[2], at[3]}, {at[4], at[5], at[6]}};
}
inline void store_pose(const Pose& X, double* at) {
  at[0] = X.q.x, at[1] = X.q.y, at[2] = X.q.z, at[3] = X.q.w;
  at[4] = X.p.x, at[5] = X.p.y, at[6] = X.p.z;
}

}  // namespace sinew::world
