#include "sinew/world/fact_history.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "sinew/world/refuse.h"

namespace sinew::world {
namespace {

std::string ns(Stamp stamp) { return std::to_string(ns_of(stamp)) + " ns"; }

bool matches(const graph::Quad& fact, graph::Id subject, graph::Id predicate, graph::Id object) {
  return (!subject || fact.subject == subject) && (!predicate || fact.predicate == predicate) &&
         (!object || fact.object == object);
}

}  // namespace

OutsideHistory::OutsideHistory(Stamp asked_for, Stamp from, Stamp to)
    : Error(Problem{{},
                    {},
                    "the logical state at " + ns(asked_for) + " is not known",
                    "a time from " + ns(from) + " to " + ns(to),
                    Severity::kError,
                    {}}),
      asked(asked_for),
      oldest(from),
      newest(to) {}

std::vector<graph::Quad> facts_of(const graph::View& view) {
  std::vector<graph::Quad> facts;
  const auto keep = [&](const graph::Quad& quad) {
    facts.push_back(quad);
    return true;
  };
  view.match_in({}, {}, {}, {}, keep);
  view.match_named({}, {}, {}, keep);
  std::sort(facts.begin(), facts.end());
  return facts;
}

FactChanges changes_between(const std::vector<graph::Quad>& before,
                            const std::vector<graph::Quad>& after) {
  FactChanges changes;
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
                      std::back_inserter(changes.begun));
  std::set_difference(before.begin(), before.end(), after.begin(), after.end(),
                      std::back_inserter(changes.ended));
  return changes;
}

std::size_t FactHistory::Hash::operator()(const graph::Quad& quad) const noexcept {
  std::uint64_t hash = 0;
  for (const graph::Id id : {quad.subject, quad.predicate, quad.object, quad.graph}) {
    hash = (hash ^ id.value) * 0x9E3779B97F4A7C15ull;
    hash ^= hash >> 29;
  }
  return hash;
}

FactHistory::FactHistory(std::size_t intervals) : capacity_(intervals) {
  if (intervals == 0 || intervals > kMaximumFactIntervals) {
    refuse({}, "a history of " + std::to_string(intervals) + " intervals",
           "1 to " + std::to_string(kMaximumFactIntervals));
  }
}

FactChanges FactHistory::observe(const graph::Store& store, Stamp now) {
  if (newest_ && now < *newest_) {
    refuse({}, "an observation at " + ns(now) + ", before the last one",
           "a time from " + ns(*newest_) + " on");
  }
  std::vector<graph::Quad> facts = facts_of(store.view());
  FactChanges changes = changes_between(last_, facts);
  for (const graph::Quad& fact : changes.ended) {
    const auto held = holding_.find(fact);
    // What began and ended at one stamp held at no time.
    if (held->second < now) ended_.push_back({fact, held->second, now});
    holding_.erase(held);
  }
  for (const graph::Quad& fact : changes.begun) {
    // What ended at this very stamp goes on.
    Stamp begin = now;
    for (auto at = ended_.rbegin(); at != ended_.rend() && *at->end == now; ++at) {
      if (at->fact != fact) continue;
      begin = at->begin;
      ended_.erase(std::next(at).base());
      break;
    }
    holding_.emplace(fact, begin);
  }
  last_ = std::move(facts);
  if (!oldest_) oldest_ = now;
  newest_ = now;
  // All that ended at one stamp go together: the history begins where nothing is missing.
  while (ended_.size() > capacity_) {
    const Stamp end = *ended_.front().end;
    while (!ended_.empty() && *ended_.front().end == end) {
      ended_.pop_front();
      ++dropped_;
    }
    oldest_ = end;
  }
  return changes;
}

Stamp FactHistory::oldest() const {
  if (!oldest_) refuse({}, "a history without an observation", "call observe first");
  return *oldest_;
}
Stamp FactHistory::newest() const {
  if (!newest_) refuse({}, "a history without an observation", "call observe first");
  return *newest_;
}

void FactHistory::check(Stamp time) const {
  if (time < oldest() || time > newest()) throw OutsideHistory(time, oldest(), newest());
}

graph::Store FactHistory::at(const graph::Store& store, Stamp time) const {
  check(time);
  graph::Store then = store.clone();
  std::vector<graph::Quad> held;
  for (const auto& [fact, begin] : holding_) {
    if (begin <= time) held.push_back(fact);
  }
  for (const FactInterval& past : ended_) {
    if (past.begin <= time && time < *past.end) held.push_back(past.fact);
  }
  std::sort(held.begin(), held.end());
  const FactChanges back = changes_between(facts_of(then.view()), held);
  graph::Transaction transaction = then.begin();
  for (const graph::Quad& fact : back.ended) transaction.remove(fact);
  for (const graph::Quad& fact : back.begun) transaction.add(fact);
  transaction.commit();
  return then;
}

bool FactHistory::held(const graph::Quad& fact, Stamp time) const {
  check(time);
  const auto now = holding_.find(fact);
  if (now != holding_.end() && now->second <= time) return true;
  return std::any_of(ended_.begin(), ended_.end(), [&](const FactInterval& past) {
    return past.fact == fact && past.begin <= time && time < *past.end;
  });
}

std::vector<FactInterval> FactHistory::intervals(graph::Id subject, graph::Id predicate,
                                                 graph::Id object) const {
  std::vector<FactInterval> found;
  for (const FactInterval& past : ended_) {
    if (matches(past.fact, subject, predicate, object)) found.push_back(past);
  }
  for (const auto& [fact, begin] : holding_) {
    if (matches(fact, subject, predicate, object)) found.push_back({fact, begin, {}});
  }
  std::sort(found.begin(), found.end(), [](const FactInterval& a, const FactInterval& b) {
    return std::pair(a.begin, a.fact) < std::pair(b.begin, b.fact);
  });
  return found;
}

}  // namespace sinew::world
