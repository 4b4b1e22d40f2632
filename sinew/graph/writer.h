// Writing to the records: what one transaction does, how it is taken back, and how removed records
// are unlinked. Private to the store; one writer at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "sinew/graph/records.h"
#include "sinew/graph/view.h"

namespace sinew::graph {

// What one change did, for taking it back. Additions remember where they were appended.
struct Change {
  enum Kind : std::uint32_t {
    kAddTriple,
    kAddTriples,  // a run of them, of which nothing is remembered: `count` from `record` on
    kAddMembership,
    kRemove,
    kAddMark,
    kRemoveMark
  };
  Kind kind;
  std::uint32_t record;         // the triple, or the mark
  std::uint32_t graph_tail;     // the graph's last member before
  std::uint32_t pairs[2];       // kAddTriple: where SP and PO were in their tables
  std::uint32_t tails[kLists];  // kAddTriple: each list's last triple before, but OS;
                                // kAddMembership: [0] the triple's last membership before
  std::uint32_t graph;          // marks: the graph's number
  std::uint32_t membership;     // the one that was added or removed; 0: the triple's own
  std::uint32_t count;          // kAddTriples
  bool last;                    // kRemove: no graph holds the triple any more
};

class Writer {
 public:
  explicit Writer(std::uint32_t limit);

  Records records;

  // All changes are made at `version`, which is later than that of every reader.
  bool add(const Quad& quad, Version version);
  // The same one after the other; returns how many were new.
  std::size_t add(std::span<const Quad> quads, Version version);
  bool remove(const Quad& quad, Version version);
  void clear(std::uint32_t graph, Version version);
  void create_graph(std::uint32_t graph, Version version);
  void drop_graph(std::uint32_t graph, Version version);

  // A new transaction.
  void start();
  // From now on, somebody may look at what the transaction does while it goes on.
  void show();
  std::size_t changes() const { return change_count_; }
  // For undo_to. From then on, every change is noted in full.
  std::size_t mark();
  void undo_to(std::size_t mark);
  // Forgets how to undo. Records that were removed and that no reader of version `oldest` or later
  // can see are unlinked, list by list, when as many were removed from a list as remained: constant
  // time a removal in the long run.
  void finish(Version oldest);

  // Memberships and marks that were removed for good and still take space.
  std::uint32_t dead_records() const { return dead_records_; }

 private:
  static constexpr std::uint32_t kFirstPatience = 2;
  // A triple's memberships have no counter: one removal in so many sweeps them.
  static constexpr std::uint32_t kTripleSweep = 16;
  // A longer log's memory is given back after its transaction.
  static constexpr std::uint32_t kLargeLog = 1 << 16;
  // Notes cost memory and time, and most transactions are not taken back. So, as long as there is
  // no mark, only the first additions are noted in full, of what follows only that it was added.
  // Taking that back walks the lists that it is in: those of one kind, say all lists of predicates,
  // have at most so many triples together for each that was noted in full.
  static constexpr std::uint32_t kNotedAtLeast = 256, kTriplesForEachNoted = 64;
  // Of a large store, most is out of the caches: above all tables, and what an object needs. So in
  // a run of triples that nobody looks at yet, what a triple needs is only asked for, and it is put
  // into the lists of its object and its pairs so many triples later, when that has come.
  static constexpr std::uint32_t kBehind = 8;
  static constexpr std::uint32_t kOutOfCaches = 1 << 14;  // triples

  struct PairKey {
    Records::Pair pair;
    std::uint32_t hash;
  };
  static PairKey key(Records::Pair pair) { return {pair, hash_pair(pair.first, pair.second)}; }
  // Where a pair is, or would be, in its table.
  struct PairPlace {
    std::uint32_t at;
    SlotTable::Slot found;
  };
  PairPlace place(List list, const PairKey& key, Version version) const;
  // Whether the pair's list was empty before.
  bool append_pair(List list, const PairKey& key, const PairPlace& place, std::uint32_t triple,
                   std::uint32_t& tail_before);
  // Of a pair that has a triple already.
  bool append_to_pair(List list, const PairKey& key, const PairPlace& place, std::uint32_t triple,
                      std::uint32_t& tail_before);
  // The records of a triple's terms.
  struct Ends {
    Node& subject;
    Node& object;
    Posting& predicate;
  };
  // What a triple that waits to be linked has asked for.
  struct Waiting {
    Node* subject;
    Node* object;
    Posting* predicate;
    std::uint32_t pair_hashes[2];  // kListSP, kListPO
  };
  // Puts it into its lists SP, PO, O and OS.
  void link(std::uint32_t triple, const Ends& ends, const PairKey& of_subject,
            const PairPlace& at_subject, const PairKey& of_object, Change& change);
  void link_next();
  void catch_up() {
    while (linked_ < records.triple_count) link_next();
  }
  // Whether the subject's few triples lie near, so that they are walked to find one.
  bool is_near(const Node& subject) const;
  std::uint32_t find_near(const Node& subject, const Quad& quad, Version version) const;
  void append_between(std::uint32_t triple, Version version);
  void make_crowded(Node& node, List list, Version version);
  // Adds the triple's object to the filter of its SP list.
  void filter(Posting& posting, std::uint32_t triple) const;
  void append(Chain& chain, List list, std::uint32_t triple, std::uint32_t& tail_before);
  void undo_pair(List list, std::uint32_t triple, std::uint32_t at, std::uint32_t tail_before);
  void undo_append(Chain& chain, List list, std::uint32_t tail_before);
  void undo_run(std::uint32_t first, std::uint32_t count);
  void cut_pair(List list, const Triple& triple, std::uint32_t first);
  bool cut(Chain& chain, List list, std::uint32_t first);
  void cut_graph(Chain& members, std::uint32_t first);
  std::uint32_t new_posting(std::uint32_t first = 0, std::uint32_t second = 0);
  Posting& of_predicate(std::uint32_t term);
  std::uint32_t graph_number(std::uint32_t name);
  std::uint32_t& next_in_graph(std::uint32_t member) {
    return member & kFurther ? records.memberships[member & ~kFurther].next_in_graph
                             : records.triples[member].next_in_graph;
  }
  // Whether the graph holds the triple, and by which membership: 0 is the triple's own.
  bool find_membership(std::uint32_t triple, std::uint32_t graph, std::uint32_t& membership) const;
  // Appends to the graph's list; returns its last member before.
  std::uint32_t append_member(std::uint32_t graph, std::uint32_t member);
  void undo_member(std::uint32_t graph, std::uint32_t tail_before);
  void append_membership(std::uint32_t triple, std::uint32_t graph, Version version);
  void remove_membership(std::uint32_t triple, std::uint32_t membership, Version version);
  void undo(const Change& change);
  [[noreturn]] void refuse_full() const;
  [[noreturn]] void refuse_long() const;
  // To be called before a change, so that nothing can fail between it and its note.
  void prepare();
  void note(const Change& change) {
    (*log_)[change_count_++] = change;
    if (is_removal(change)) ++removal_count_;
  }
  // Whether the next addition is noted in full.
  bool notes_all() const { return marked_ || noted_ > 0; }
  void note_triple(std::uint32_t number);
  void note_other(const Change& change);
  static bool is_removal(const Change& change) {
    return change.kind == Change::kRemove || change.kind == Change::kRemoveMark;
  }
  void count_pair(List list, std::uint32_t predicate, int by);
  void sweep_pair(List list, const Triple& triple, Version oldest);
  void sweep(Chain& chain, List list, Version oldest);
  void sweep_graph(Chain& members, Version oldest);
  void sweep_triple(Triple& triple, Version oldest);

  std::uint32_t limit_;
  std::uint32_t dead_records_ = 0;
  std::unique_ptr<StableArray<Change, Fill::kRaw>> log_ =
      std::make_unique<StableArray<Change, Fill::kRaw>>();
  std::uint32_t change_count_ = 0;
  std::uint32_t removal_count_ = 0;  // of these changes
  bool marked_ = false, shown_ = false;
  std::uint32_t linked_ = 0;  // the last triple that is in all its lists
  static constexpr std::uint32_t kWaitingMask = 15;
  static_assert(kBehind < kWaitingMask);
  Waiting waiting_[kWaitingMask + 1] = {};  // of those after it, by number
  std::uint32_t noted_ = 0;  // additions that are still noted in full, if there is no mark
  std::uint32_t noted_after_run_ = 0;
};

}  // namespace sinew::graph
