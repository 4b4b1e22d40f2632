// A version of the store as a pattern matcher, and its statistics.
//
// An anchored match is one hash lookup and then one cache line a triple; nothing is allocated.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sinew/graph/records.h"
#include "sinew/graph/terms.h"

namespace sinew::graph {

struct Quad {
  Id subject, predicate, object;
  Id graph = {};
  friend constexpr auto operator<=>(const Quad&, const Quad&) = default;
};

// Which graphs a pattern is matched against.
enum class Dataset : std::uint8_t {
  kUnion,    // every triple once, whichever graphs hold it (what models are queried with)
  kDefault,  // the unnamed graph alone (SPARQL's default)
};

// Equal for views that see the same for ever; nothing is known of one that is 0.
struct Stamp {
  std::uint64_t records = 0;
  Version version = 0;
  explicit operator bool() const { return records != 0; }
  friend bool operator==(const Stamp&, const Stamp&) = default;
};

// What a store publishes of its present.
struct Present {
  const Records* records = nullptr;
  const Terms* terms = nullptr;
  Version committed = 1;
  std::size_t size = 0;  // of the union, at `committed`
};

// While one exists on a thread, no store is compacted by that thread: matching may be under way.
class MatchScope {
 public:
  MatchScope() { ++depth_; }
  ~MatchScope() { --depth_; }
  MatchScope(const MatchScope&) = delete;
  MatchScope& operator=(const MatchScope&) = delete;
  static bool matching() { return depth_ > kOutside; }

 private:
  // Not 0, because linkers (LLD 14, mold 1.10) mistake where a program's pages that become
  // read-only begin if all that its threads own starts as zeros and those pages begin with a page;
  // such a program is refused by the system.
  static constexpr int kOutside = 1;
  inline static constinit thread_local int depth_ = kOutside;
};

// Cheap to copy; valid as long as what it came from.
class View {
 public:
  const Terms& terms() const;

  // Calls visit(const Quad&) for every triple that matches, wildcard where the Id is 0, in the
  // order in which the triples were added; stops when visit returns false. Returns false if it was
  // stopped. Quad::graph is 0 here; each triple comes once. No allocation. `visit` may write to the
  // store: what is added meanwhile may or may not be seen. It must not undo or roll back.
  template <typename Visit>
  bool match(Id subject, Id predicate, Id object, Dataset dataset, Visit&& visit) const;
  // The same in one named graph (or, with graph 0, in the unnamed graph); Quad::graph is that
  // graph. The order is that in which the triples, or their memberships in this graph, were added.
  template <typename Visit>
  bool match_in(Id subject, Id predicate, Id object, Id graph, Visit&& visit) const;
  // The same over all *named* graphs: a triple comes once for every graph that holds it.
  template <typename Visit>
  bool match_named(Id subject, Id predicate, Id object, Visit&& visit) const;

  bool contains(Id subject, Id predicate, Id object, Dataset dataset = Dataset::kUnion) const;
  bool contains_in(const Quad& quad) const;
  // Convenience for functional properties: the first object/subject or 0.
  Id object(Id subject, Id predicate) const;
  Id subject(Id predicate, Id object) const;

  // Statistics for planners, from live counters, in O(1). All are upper bounds: they also count
  // what this view does not see, because it was added later or removed and not yet swept.
  std::size_t estimate(Id subject, Id predicate, Id object) const;
  std::size_t distinct_subjects(Id predicate) const;  // pairs (subject, predicate) in use
  std::size_t distinct_objects(Id predicate) const;   // pairs (predicate, object) in use

  std::size_t size() const;  // distinct triples of the union
  // Calls visit(Id) for every named graph that is not empty or was created by create_graph; stops
  // when visit returns false. Returns false if it was stopped.
  template <typename Visit>
  bool named_graphs(Visit&& visit) const;
  bool has_graph(Id graph) const;

  // Of what is committed; 0 of a transaction's own view, which changes.
  Stamp stamp() const {
    if (!present_ && size_ == kUnfinished) return {};
    return {records().identity, version()};
  }

  // The present of a store, as it is at each call.
  explicit View(const Present* present) : present_(present), terms_(present->terms) {}
  // One version. The size of an unfinished transaction is what its records say.
  static constexpr std::size_t kUnfinished = SIZE_MAX;
  View(const Records* records, const Terms* terms, Version version, std::size_t size)
      : records_(records), terms_(terms), version_(version), size_(size) {}

 protected:
  View() = default;

 private:
  friend class Steps;
  const Records& records() const { return present_ ? *present_->records : *records_; }
  Version version() const { return present_ ? present_->committed : version_; }
  static bool named(const Records& records, const Graph& graph, Version version);

  // The loop under all matching: calls visit(const Triple&, std::uint32_t index).
  template <typename Visit>
  bool visit_triples(Id subject, Id predicate, Id object, Visit&& visit) const;
  // The same through the graph's own list.
  template <typename Visit>
  static bool visit_members(const Records& records, const Graph& graph, Version version,
                            Visit&& visit);
  static Quad quad(const Triple& triple, Id graph) {
    return {{triple.subject}, {triple.predicate}, {triple.object}, graph};
  }

  const Present* present_ = nullptr;
  const Records* records_ = nullptr;
  const Terms* terms_ = nullptr;
  Version version_ = 0;
  std::size_t size_ = 0;
};

// Many steps from node to node over one version, as a walk through the graph takes them: less is
// looked up anew at each than with View::match. What a visitor writes to the store meanwhile may or
// may not be seen.
class Steps {
 public:
  explicit Steps(const View& view) : records_(view.records()), version_(view.version()) {}

  // Calls visit(Id) for each, in the order of View::match; stops when it returns false. Returns
  // false if it was stopped.
  template <typename Visit>
  bool objects(Id subject, Id predicate, Visit&& visit) const {
    return walk<kListSP>(subject, predicate, visit,
                         [](const Triple& found) { return found.object; });
  }
  template <typename Visit>
  bool subjects(Id predicate, Id object, Visit&& visit) const {
    return walk<kListPO>(predicate, object, visit,
                         [](const Triple& found) { return found.subject; });
  }

 private:
  template <List list, typename Visit, typename Take>
  bool walk(Id first, Id second, Visit&& visit, Take&& take) const {
    // As Records::find_pair, which leads to the triple or the posting already.
    const Records::Pair pair{first.value, second.value};
    const Posting* several = nullptr;
    const Triple* triple = nullptr;
    const auto is_key = [&](SlotTable::Slot slot) {
      if (slot.marked()) {
        several = &records_.postings[slot.number()];
        return pair == Records::pair_of(*several);
      }
      triple = &records_.triples.listed(slot.number());
      return load(triple->added) <= version_ && pair == Records::pair_of(*triple, list);
    };
    const SlotTable::Slot found =
        records_.pairs[list].find(hash_pair(first.value, second.value), is_key);
    if (!found) return true;
    if (!found.marked()) {
      return !records_.still_there(*triple, version_) || visit(Id{take(*triple)});
    }
    for (std::uint32_t at = load(several->chain.head); at != 0;) {
      triple = &records_.triples.listed(at);
      if (load(triple->added) > version_) break;
      if (records_.still_there(*triple, version_) && !visit(Id{take(*triple)})) return false;
      at = load(triple->next[list]);
    }
    return true;
  }

  const MatchScope scope_;
  const Records& records_;
  const Version version_;
};

// ---- implementation ----

template <typename Visit>
bool View::visit_triples(Id subject, Id predicate, Id object, Visit&& visit) const {
  const MatchScope scope;
  const Records& in = records();
  const Version at_version = version();
  if (subject && predicate && object) {
    const std::uint32_t at = in.find(subject.value, predicate.value, object.value, at_version);
    return at == 0 || visit(in.triples[at]);
  }
  if (!subject && !predicate && !object) {
    const std::uint32_t end = load(in.triple_count);
    for (std::uint32_t at = 1; at <= end; ++at) {
      const Triple& triple = in.triples.listed(at);
      if (load(triple.added) > at_version) break;
      if (!in.still_there(triple, at_version)) continue;
      if (!visit(triple)) return false;
    }
    return true;
  }
  List list;
  const Records::Run run = in.run(subject.value, predicate.value, object.value, at_version, list);
  const bool between = subject && object;
  for (std::uint32_t at = run.head; at != 0;) {
    const Triple& triple = in.triples.listed(at);
    if (load(triple.added) > at_version) break;
    const bool matches =
        !between || (triple.subject == subject.value && triple.object == object.value);
    if (matches && in.still_there(triple, at_version) && !visit(triple)) return false;
    at = load(triple.next[list]);
  }
  return true;
}

template <typename Visit>
bool View::visit_members(const Records& in, const Graph& graph, Version version, Visit&& visit) {
  for (std::uint32_t at = load(graph.members.head); at != 0;) {
    if (at & kFurther) {
      const Membership& membership = in.memberships[at & ~kFurther];
      if (load(membership.added) > version) break;
      if (Records::still_in_graph(membership, version) && !visit(in.triples[membership.triple])) {
        return false;
      }
      at = load(membership.next_in_graph);
    } else {
      const Triple& triple = in.triples.listed(at);
      if (load(triple.added) > version) break;
      if (Records::still_in_graph(triple, version) && !visit(triple)) return false;
      at = load(triple.next_in_graph);
    }
  }
  return true;
}

template <typename Visit>
bool View::match(Id subject, Id predicate, Id object, Dataset dataset, Visit&& visit) const {
  if (dataset == Dataset::kDefault) return match_in(subject, predicate, object, Id{}, visit);
  return visit_triples(subject, predicate, object,
                       [&](const Triple& triple) { return visit(quad(triple, Id{})); });
}

template <typename Visit>
bool View::match_in(Id subject, Id predicate, Id object, Id graph, Visit&& visit) const {
  const Records& in = records();
  const Version at_version = version();
  const Graph* holder = in.graph(graph.value);
  if (!holder) return true;
  // Through the graph's own list where that is shorter.
  const std::size_t members = load(holder->members.count);
  if (estimate(subject, predicate, object) > members || !(subject || predicate || object)) {
    const MatchScope scope;
    return visit_members(in, *holder, at_version, [&](const Triple& triple) {
      if (subject && subject.value != triple.subject) return true;
      if (predicate && predicate.value != triple.predicate) return true;
      if (object && object.value != triple.object) return true;
      return static_cast<bool>(visit(quad(triple, graph)));
    });
  }
  return visit_triples(subject, predicate, object, [&](const Triple& triple) {
    return !in.holds(triple, graph.value, at_version) || visit(quad(triple, graph));
  });
}

template <typename Visit>
bool View::match_named(Id subject, Id predicate, Id object, Visit&& visit) const {
  const Records& in = records();
  const Version at_version = version();
  return visit_triples(subject, predicate, object, [&](const Triple& triple) {
    if (triple.graph != 0 && Records::still_in_graph(triple, at_version) &&
        !visit(quad(triple, Id{triple.graph}))) {
      return false;
    }
    return in.for_further(triple, at_version, [&](const Membership& further) {
      return further.graph == 0 || visit(quad(triple, Id{further.graph}));
    });
  });
}

template <typename Visit>
bool View::named_graphs(Visit&& visit) const {
  const MatchScope scope;
  const Records& in = records();
  const Version at_version = version();
  const std::uint32_t end = load(in.graph_count);
  for (std::uint32_t at = 1; at <= end; ++at) {
    const Graph& graph = in.graphs[at];
    if (graph.name == 0 || !named(in, graph, at_version)) continue;
    if (!visit(Id{graph.name})) return false;
  }
  return true;
}

}  // namespace sinew::graph
