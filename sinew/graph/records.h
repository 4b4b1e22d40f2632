// The records that the store is made of, and the tables that hold them.
//
// A triple is one cache line. It carries the versions [added, removed) in which it is visible, and
// a link to the next triple in each of six lists, which are in the order of insertion:
//   SP  the objects of a subject and predicate     S  everything of a subject
//   PO  the subjects of a predicate and object     P  everything of a predicate
//   OS  the predicates between object and subject  O  everything of an object
// The lists of one term are found by array; the head of a pair's list is a Posting, found by hash.
// Most lists of pairs have one triple: then the hash table leads to the triple itself. What is
// between an object and a subject is looked for in the shorter of their own lists; only triples
// whose subject and object both are crowded, which few are, are in a list OS.
//
// A triple itself says which graph it was added to first, and is linked with what else is in that
// graph; its versions are those in which that graph holds it. Each further graph that holds it is a
// Membership, with versions of its own. A triple is visible while at least one graph holds it.
//
// Concurrency: one writer, any number of readers, no locks. Records never move and are reached
// through release/acquire links. Versions grow along every list, so a reader of version v stops at
// the first record that was added later. A record is used again only after it was undone, for an
// even later version, so such a reader never takes its new content for the old. A record that is
// unlinked because it was removed keeps its own links, so a reader that stands on it finds its way
// on.
#pragma once

#include <cstdint>

#include "sinew/graph/slot_table.h"
#include "sinew/graph/stable_array.h"

namespace sinew::graph {

using Version = std::uint64_t;
inline constexpr Version kNever = UINT64_MAX;

enum List : std::uint32_t { kListSP, kListPO, kListOS, kListS, kListP, kListO, kLists };

// In a graph's list: what is set in the number of a Membership, and not in that of a triple.
inline constexpr std::uint32_t kFurther = 0x80000000u;

struct alignas(64) Triple {
  Version added, removed;  // to and from `graph`
  std::uint32_t subject, predicate, object;
  std::uint32_t graph;          // that it was added to first
  std::uint32_t next[kLists];   // 0 ends a list
  std::uint32_t next_in_graph;  // a triple or a Membership of the same graph
  std::uint32_t memberships;    // the first of those in further graphs
};
static_assert(sizeof(Triple) == 64);

// That a triple is in a further graph.
struct Membership {
  Version added, removed;
  std::uint32_t triple, graph;
  std::uint32_t next_of_triple;  // the same triple in another graph
  std::uint32_t next_in_graph;   // as Triple::next_in_graph
  std::uint32_t last_of_triple;  // writer only; of a triple's first
  std::uint32_t unused;
};
static_assert(sizeof(Membership) == 40);

// A term whose list was once longer than this is crowded.
inline constexpr std::uint32_t kUncrowded = 16;

struct Chain {
  std::uint32_t head;
  std::uint32_t tail;      // writer only
  std::uint32_t count;     // records in the list, also those that were removed meanwhile
  std::uint32_t patience;  // writer only: removals until the list is swept
};

// The list of a pair of terms, or of a predicate.
struct Posting {
  std::uint32_t first, second;  // the pair; 0 of a predicate's
  Chain chain;
  // Of a predicate's list: how many SP and PO lists with it are not empty (kSubjects, kObjects). Of
  // an SP list: a filter of its objects, from which nothing is taken away again (ObjectBit).
  std::uint32_t summary[2];
};
static_assert(sizeof(Posting) == 32);

enum : std::uint32_t { kSubjects, kObjects };  // in Posting::summary

// Where a filter has the bit of an object. What a node's types are not, which is what most queries
// ask of them, is so known without a walk along them.
struct ObjectBit {
  explicit ObjectBit(std::uint32_t object)
      : word((object * 0x9E3779B1u) >> 31), mask(1u << ((object * 0x9E3779B1u) >> 26 & 31)) {}
  std::uint32_t word, mask;
};

// The lists of one term. What an object needs comes first, so that it mostly is one cache line:
// objects are what jumps about where triples are added subject by subject.
struct Node {
  Chain as_object;
  std::uint32_t object_is_crowded, subject_is_crowded;
  std::uint32_t as_predicate;  // in `postings`; 0 where it has none
  std::uint32_t as_graph;      // in `graphs`
  Chain as_subject;
};
static_assert(sizeof(Node) == 48);

struct Graph {
  Chain members;  // linked by next_in_graph
  std::uint32_t name;
  std::uint32_t marks;  // the newest of its GraphMarks
};

// create_graph: the graph exists in [added, removed) even while it is empty.
struct GraphMark {
  Version added, removed;
  std::uint32_t next;  // older
  std::uint32_t unused;
};

// Never the same again in this process; never 0.
std::uint64_t next_identity();

// Reading of the tables at one version; all inline, because matching is the innermost loop of
// queries.
struct Records {
  const std::uint64_t identity = next_identity();
  StableArray<Triple, Fill::kRaw> triples;  // 1 .. triple_count
  StableArray<Membership, Fill::kRaw> memberships;
  StableArray<Posting, Fill::kRaw> postings;
  StableArray<Node> nodes;  // by term
  StableArray<Graph, Fill::kRaw> graphs;
  StableArray<GraphMark, Fill::kRaw> marks;
  SlotTable pairs[3];  // kListSP, kListPO, kListOS
  std::uint32_t triple_count = 0;
  std::uint32_t membership_count = 0;
  std::uint32_t posting_count = 0;
  std::uint32_t graph_count = 0;
  std::uint32_t mark_count = 0;
  std::uint32_t live_count = 0;  // writer only: triples that its own version sees

  // The first triple and the length of a list; head 0 where there is none.
  struct Run {
    std::uint32_t head = 0, count = 0;
  };
  static Run run_of(const Chain& chain) { return {load(chain.head), load(chain.count)}; }
  struct Pair {
    std::uint32_t first, second;
    friend bool operator==(Pair, Pair) = default;
  };
  static Pair pair_of(const Triple& triple, List list) {
    switch (list) {
      case kListSP:
        return {triple.subject, triple.predicate};
      case kListPO:
        return {triple.predicate, triple.object};
      default:
        return {triple.object, triple.subject};
    }
  }
  static Pair pair_of(const Posting& posting) { return {posting.first, posting.second}; }
  // A marked number is a Posting's, any other a triple's. A triple that is not visible yet may be
  // changing, and may be passed over: whatever is in its list was added later.
  SlotTable::Slot find_pair(List list, Pair pair, Version version,
                            std::uint32_t* at = nullptr) const {
    return find_pair(list, pair, hash_pair(pair.first, pair.second), version, at);
  }
  SlotTable::Slot find_pair(List list, Pair pair, std::uint32_t hash, Version version,
                            std::uint32_t* at) const {
    return pairs[list].find(
        hash,
        [&](SlotTable::Slot slot) {
          if (slot.marked()) {
            const Posting& posting = postings[slot.number()];
            return pair == pair_of(posting);
          }
          const Triple& triple = triples.listed(slot.number());
          return load(triple.added) <= version && pair == pair_of(triple, list);
        },
        at);
  }
  Run run_of(SlotTable::Slot found) const {
    if (!found) return {};
    return found.marked() ? run_of(postings[found.number()].chain) : Run{found.number(), 1};
  }
  Run pair(List list, std::uint32_t first, std::uint32_t second, Version version) const {
    return run_of(find_pair(list, {first, second}, version));
  }
  // The list of one term as kListS or kListO.
  static const Chain& chain(const Node& node, List list) {
    return list == kListS ? node.as_subject : node.as_object;
  }
  static Chain& chain(Node& node, List list) {
    return list == kListS ? node.as_subject : node.as_object;
  }
  const Posting* of_predicate(std::uint32_t term) const {
    const Node* node = nodes.find(term);
    const std::uint32_t number = node ? load(node->as_predicate) : 0;
    return number ? &postings[number] : nullptr;
  }
  // What contains all that is between the two, and perhaps more. Sets `list`.
  Run between(std::uint32_t subject, std::uint32_t object, Version version, List& list) const {
    list = kListS;
    const Node* const of_subject = nodes.find(subject);
    const Node* const of_object = nodes.find(object);
    if (!of_subject || !of_object) return {};
    if (load(of_subject->subject_is_crowded) && load(of_object->object_is_crowded)) {
      return pair(list = kListOS, object, subject, version);
    }
    const Run from = run_of(of_subject->as_subject), to = run_of(of_object->as_object);
    if (from.count <= to.count) return from;
    list = kListO;
    return to;
  }
  // Precondition: one or two of the three are not 0. Sets `list`. Where the predicate alone is
  // missing, the run may contain triples of other terms as well.
  Run run(std::uint32_t subject, std::uint32_t predicate, std::uint32_t object, Version version,
          List& list) const {
    if (subject && predicate) return pair(list = kListSP, subject, predicate, version);
    if (predicate && object) return pair(list = kListPO, predicate, object, version);
    if (object && subject) return between(subject, object, version, list);
    if (predicate) {
      list = kListP;
      const Posting* const all = of_predicate(predicate);
      return all ? run_of(all->chain) : Run{};
    }
    list = subject ? kListS : kListO;
    const Node* const node = nodes.find(subject ? subject : object);
    return node ? run_of(chain(*node, list)) : Run{};
  }
  const Graph* graph(std::uint32_t name) const {
    const Node* node = nodes.find(name);
    const std::uint32_t number = node ? load(node->as_graph) : 0;
    return number ? &graphs[number] : nullptr;
  }

  // Precondition: added <= version.
  template <typename Record>
  static bool still_in_graph(const Record& record, Version version) {
    return version < load(record.removed);
  }
  // Whether any graph holds the triple. Precondition: added <= version.
  bool still_there(const Triple& triple, Version version) const {
    return still_in_graph(triple, version) ||
           !for_further(triple, version, [](const Membership&) { return false; });
  }
  // Calls visit(const Membership&) for those of the triple that are visible, until it returns
  // false. Returns false if it was stopped.
  template <typename Visit>
  bool for_further(const Triple& triple, Version version, Visit&& visit) const {
    for (std::uint32_t at = load(triple.memberships); at != 0;) {
      const Membership& membership = memberships[at];
      if (load(membership.added) > version) break;
      if (still_in_graph(membership, version) && !visit(membership)) return false;
      at = load(membership.next_of_triple);
    }
    return true;
  }

  // Whether the graph holds the triple. Precondition: the triple is visible at this version.
  bool holds(const Triple& triple, std::uint32_t graph, Version version) const {
    if (triple.graph == graph && still_in_graph(triple, version)) return true;
    return !for_further(triple, version,
                        [graph](const Membership& further) { return further.graph != graph; });
  }

  // The visible triple, or 0. The list of SP is nearly always short; where it is not, the shortest
  // of the three is searched.
  std::uint32_t find(std::uint32_t subject, std::uint32_t predicate, std::uint32_t object,
                     Version version) const {
    return find(subject, predicate, object, version,
                find_pair(kListSP, {subject, predicate}, version));
  }
  // `of_pair`: what find_pair has found in kListSP.
  std::uint32_t find(std::uint32_t subject, std::uint32_t predicate, std::uint32_t object,
                     Version version, SlotTable::Slot of_pair) const {
    constexpr std::uint32_t kShort = 8;
    if (of_pair && of_pair.marked()) {
      const ObjectBit bit(object);
      if (!(load(postings[of_pair.number()].summary[bit.word]) & bit.mask)) return 0;
    }
    List list = kListSP;
    Run best = run_of(of_pair);
    if (best.count > kShort) {
      const Run po = pair(kListPO, predicate, object, version);
      if (po.count < best.count) best = po, list = kListPO;
      if (best.count > kShort) {
        List other;
        const Run os = between(subject, object, version, other);
        if (os.count < best.count) best = os, list = other;
      }
    }
    for (std::uint32_t at = best.head; at != 0;) {
      const Triple& triple = triples.listed(at);
      if (load(triple.added) > version) return 0;
      if (triple.object == object && triple.subject == subject && triple.predicate == predicate &&
          still_there(triple, version)) {
        return at;
      }
      at = load(triple.next[list]);
    }
    return 0;
  }
};

}  // namespace sinew::graph
