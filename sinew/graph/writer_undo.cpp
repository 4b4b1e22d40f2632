// Taking back changes, last one first: every addition is then the last of each list that it is in.
#include <algorithm>

#include "sinew/graph/writer.h"

namespace sinew::graph {

void Writer::start() {
  marked_ = shown_ = false;
  noted_ = std::max(kNotedAtLeast, records.triple_count / kTriplesForEachNoted);
  noted_after_run_ = noted_;
}

std::size_t Writer::mark() {
  catch_up();
  marked_ = true;
  return change_count_;
}

void Writer::undo_to(std::size_t mark) {
  catch_up();
  while (change_count_ > mark) undo((*log_)[--change_count_]);
  linked_ = records.triple_count;
}

void Writer::undo(const Change& change) {
  switch (change.kind) {
    case Change::kAddTriple: {
      Triple& triple = records.triples[change.record];
      Node& from = records.nodes[triple.subject];
      Node& to = records.nodes[triple.object];
      if (from.subject_is_crowded && to.object_is_crowded) {
        undo_pair(kListOS, change.record, 0, 0);
      }
      for (const List list : {kListPO, kListSP}) {
        undo_pair(list, change.record, change.pairs[list], change.tails[list]);
      }
      // From here on, no reader takes it for a triple.
      store(triple.added, kNever);
      undo_append(to.as_object, kListO, change.tails[kListO]);
      undo_append(of_predicate(triple.predicate).chain, kListP, change.tails[kListP]);
      undo_append(from.as_subject, kListS, change.tails[kListS]);
      undo_member(triple.graph, change.graph_tail);
      store(records.triple_count, records.triple_count - 1);
      --records.live_count;
      break;
    }
    case Change::kAddTriples:
      undo_run(change.record, change.count);
      break;
    case Change::kAddMembership: {
      Triple& triple = records.triples[change.record];
      if (change.tails[0] == 0) {
        store(triple.memberships, 0);
      } else {
        records.memberships[triple.memberships].last_of_triple = change.tails[0];
        store(records.memberships[change.tails[0]].next_of_triple, 0);
      }
      undo_member(records.memberships[change.membership].graph, change.graph_tail);
      --records.membership_count;
      break;
    }
    case Change::kRemove:
      --removal_count_;
      store(change.membership ? records.memberships[change.membership].removed
                              : records.triples[change.record].removed,
            kNever);
      if (change.last) ++records.live_count;
      break;
    case Change::kAddMark:
      store(records.graphs[change.graph].marks, records.marks[change.record].next);
      --records.mark_count;
      break;
    case Change::kRemoveMark:
      --removal_count_;
      store(records.marks[change.record].removed, kNever);
      break;
  }
}

void Writer::undo_append(Chain& chain, List list, std::uint32_t tail) {
  store(tail == 0 ? chain.head : records.triples[tail].next[list], 0);
  chain.tail = tail;
  store(chain.count, chain.count - 1);
}

// `at`: where it was; it is elsewhere if the table grew since.
void Writer::undo_pair(List list, std::uint32_t number, std::uint32_t at, std::uint32_t tail) {
  const Triple& triple = records.triples[number];
  const Records::Pair pair = Records::pair_of(triple, list);
  SlotTable::Slot slot = records.pairs[list].at(at);
  if (slot.marked() ? Records::pair_of(records.postings[slot.number()]) != pair
                    : slot.number() != number) {
    slot = records.find_pair(list, pair, triple.added, &at);
  }
  if (slot.marked()) {
    Posting& posting = records.postings[slot.number()];
    // In a list OS, a triple may be since its subject or object became crowded.
    if (list == kListOS && posting.chain.head != number) {
      tail = posting.chain.head;
      while (records.triples[tail].next[list] != number) tail = records.triples[tail].next[list];
    }
    undo_append(posting.chain, list, tail);
    if (posting.chain.count > 0) return;
  } else {
    records.pairs[list].erase(at);
  }
  count_pair(list, triple.predicate, -1);
}

void Writer::undo_member(std::uint32_t graph, std::uint32_t tail) {
  Chain& members = records.graphs[records.nodes[graph].as_graph].members;
  store(tail == 0 ? members.head : next_in_graph(tail), 0);
  members.tail = tail;
  store(members.count, members.count - 1);
}

// ---- a run of triples, of which nothing is remembered ----

// Numbers grow along every list, so what was added by the run is the end of each list that it is
// in.
void Writer::undo_run(std::uint32_t first, std::uint32_t count) {
  for (std::uint32_t number = first + count - 1; number >= first; --number) {
    Triple& triple = records.triples[number];
    Node& from = records.nodes[triple.subject];
    Node& to = records.nodes[triple.object];
    if (from.subject_is_crowded && to.object_is_crowded) cut_pair(kListOS, triple, first);
    cut_pair(kListPO, triple, first);
    cut_pair(kListSP, triple, first);
    store(triple.added, kNever);
    cut(to.as_object, kListO, first);
    cut(of_predicate(triple.predicate).chain, kListP, first);
    cut(from.as_subject, kListS, first);
    cut_graph(records.graphs[records.nodes[triple.graph].as_graph].members, first);
  }
  store(records.triple_count, records.triple_count - count);
  records.live_count -= count;
}

void Writer::cut_pair(List list, const Triple& triple, std::uint32_t first) {
  std::uint32_t at = 0;
  const SlotTable::Slot slot =
      records.find_pair(list, Records::pair_of(triple, list), triple.added, &at);
  if (!slot) return;
  if (slot.marked()) {
    Chain& chain = records.postings[slot.number()].chain;
    if (!cut(chain, list, first) || chain.count > 0) return;
  } else if (slot.number() >= first) {
    records.pairs[list].erase(at);
  } else {
    return;
  }
  count_pair(list, triple.predicate, -1);
}

// Whether there was something to cut off.
bool Writer::cut(Chain& chain, List list, std::uint32_t first) {
  if (chain.tail < first) return false;
  std::uint32_t last = 0, count = 0;
  for (std::uint32_t at = chain.head; at < first && at != 0; at = records.triples[at].next[list]) {
    last = at;
    ++count;
  }
  store(last == 0 ? chain.head : records.triples[last].next[list], 0);
  chain.tail = last;
  store(chain.count, count);
  return true;
}

// What is behind the run's first triple has all been added later.
void Writer::cut_graph(Chain& members, std::uint32_t first) {
  if (members.tail < first || members.tail & kFurther) return;
  std::uint32_t last = 0, count = 0;
  for (std::uint32_t at = members.head; (at & kFurther || at < first) && at != 0;
       at = next_in_graph(at)) {
    last = at;
    ++count;
  }
  store(last == 0 ? members.head : next_in_graph(last), 0);
  members.tail = last;
  store(members.count, count);
}

}  // namespace sinew::graph
