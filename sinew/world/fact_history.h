// The logical state at a time: what relations held then.
//
//   FactHistory history;
//   history.observe(world.graph(), now);          // after every change; actions do it themselves
//   graph::Store past = history.at(world.graph(), then);
//   rdf::sparql::query(past.view(), past.terms(), "SELECT …")
//
// Every triple of a store has intervals [begin, end) in which it held: it begins at the first
// observation that found it, and ends at the first that did not. Between two observations what the
// earlier one found is what held. A query about a time answers as it would have over a clone of the
// world's graph made then (graph::Store::clone); names and graphs are part of that.
//
// What is held: triples that hold now, and at most so many intervals that ended. Beyond, those that
// ended first are let go, and the history begins where the last of them ended. Asked for a time
// before that, or after the last observation, it throws OutsideHistory with both bounds: nothing
// says what holds later.
//
// An observation costs a pass over the store. One thread at a time; a history belongs to one store
// (terms are ids), and outlives no term of it.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <unordered_map>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/store.h"
#include "sinew/world/clock.h"

namespace sinew::world {

inline constexpr std::size_t kMaximumFactIntervals = std::size_t{1} << 24;
inline constexpr std::size_t kUsualFactIntervals = std::size_t{1} << 16;

struct FactInterval {
  graph::Quad fact;
  Stamp begin = {};
  std::optional<Stamp> end = {};  // none: it holds
};

class OutsideHistory : public Error {
 public:
  OutsideHistory(Stamp asked, Stamp oldest, Stamp newest);
  Stamp asked, oldest, newest;
};

struct FactChanges {
  std::vector<graph::Quad> begun, ended;  // sorted
};

// All triples, each with the graph that it is in, sorted; what one has and the other has not.
std::vector<graph::Quad> facts_of(const graph::View& view);
FactChanges changes_between(const std::vector<graph::Quad>& before,
                            const std::vector<graph::Quad>& after);

class FactHistory {
 public:
  // Throws Error unless 1 <= intervals <= kMaximumFactIntervals.
  explicit FactHistory(std::size_t intervals = kUsualFactIntervals);

  // What holds from `now` on; returns what has changed since the last time. Throws Error when `now`
  // is earlier than that. Observed twice at one stamp, the later one counts.
  FactChanges observe(const graph::Store& store, Stamp now);

  // Preconditions of these: observe was called; else they throw Error.
  Stamp oldest() const;
  Stamp newest() const;  // of the observations
  // The store as it was: what held, in its graphs, with a life of its own.
  graph::Store at(const graph::Store& store, Stamp time) const;
  bool held(const graph::Quad& fact, Stamp time) const;
  // When it held, as far as is still known, the oldest first; wildcard where the Id is 0. Those
  // that end before oldest() are not among them.
  std::vector<FactInterval> intervals(graph::Id subject, graph::Id predicate,
                                      graph::Id object) const;
  std::size_t ended() const { return ended_.size(); }  // intervals that are held
  std::size_t dropped() const { return dropped_; }     // intervals that were let go

 private:
  struct Hash {
    std::size_t operator()(const graph::Quad& quad) const noexcept;
  };
  void check(Stamp time) const;

  const std::size_t capacity_;
  std::unordered_map<graph::Quad, Stamp, Hash> holding_;  // since when
  std::vector<graph::Quad> last_;                         // what holds, sorted
  std::deque<FactInterval> ended_;                        // in the order of their ends
  std::optional<Stamp> oldest_, newest_;
  std::size_t dropped_ = 0;
};

}  // namespace sinew::world
