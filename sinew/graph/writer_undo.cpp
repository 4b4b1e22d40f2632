// Taking back changes, last one first: every addition is then the last of each list that it is in.
#include "sinew/graph/writer.h"

namespace sinew::graph {

void Writer::undo_to(std::size_t mark) {
  while (change_count_ > mark) undo((*log_)[--change_count_]);
}

void Writer::undo(const Change& change) {
  switch (change.kind) {
    case Change::kAddTriple: {
      Triple& triple = records.triples[change.record];
      const bool between =
          Records::crowded(records.postings[records.nodes[triple.subject].as_subject]) &&
          Records::crowded(records.postings[records.nodes[triple.object].as_object]);
      if (between) undo_pair(kListOS, change.record, 0, 0);
      for (const List list : {kListPO, kListSP}) {
        undo_pair(list, change.record, change.pairs[list], change.tails[list]);
      }
      // From here on, no reader takes it for a triple.
      store(triple.added, kNever);
      undo_append(records.postings[records.nodes[triple.object].as_object], kListO,
                  change.tails[kListO]);
      undo_append(records.postings[records.nodes[triple.predicate].as_predicate], kListP,
                  change.tails[kListP]);
      undo_append(records.postings[records.nodes[triple.subject].as_subject], kListS,
                  change.tails[kListS]);
      undo_membership(change);
      store(records.triple_count, records.triple_count - 1);
      --records.live_count;
      break;
    }
    case Change::kAddMembership: {
      Triple& triple = records.triples[change.record];
      triple.last_membership = change.tails[0];
      store(records.memberships[change.tails[0]].next_of_triple, 0);
      store(triple.graph, change.graph);
      undo_membership(change);
      break;
    }
    case Change::kRemove:
      --removal_count_;
      store(records.memberships[change.membership].removed, kNever);
      if (change.last) {
        store(records.triples[change.record].removed, kNever);
        ++records.live_count;
      }
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

void Writer::undo_append(Posting& posting, List list, std::uint32_t tail) {
  store(tail == 0 ? posting.head : records.triples[tail].next[list], 0);
  posting.tail = tail;
  store(posting.count, posting.count - 1);
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
    if (list == kListOS && posting.head != number) {
      tail = posting.head;
      while (records.triples[tail].next[list] != number) tail = records.triples[tail].next[list];
    }
    undo_append(posting, list, tail);
    if (posting.count > 0) return;
  } else {
    records.pairs[list].erase(at);
  }
  count_pair(list, triple.predicate, -1);
}

void Writer::undo_membership(const Change& change) {
  const Membership& membership = records.memberships[change.membership];
  const Graph& graph = *records.graph(membership.graph);
  Posting& members = records.postings[graph.members];
  store(
      change.graph_tail == 0 ? members.head : records.memberships[change.graph_tail].next_in_graph,
      0);
  members.tail = change.graph_tail;
  store(members.count, members.count - 1);
  --records.membership_count;
}

}  // namespace sinew::graph
