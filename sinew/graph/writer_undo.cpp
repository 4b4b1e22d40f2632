// Taking back changes, last one first: every addition is then the last of each list that it is in.
#include "sinew/graph/writer.h"

namespace sinew::graph {

void Writer::undo_to(std::size_t mark) {
  while (change_count_ > mark) undo((*log_)[--change_count_]);
}

void Writer::undo(const Change& change) {
  switch (change.kind) {
    case Change::kAddTriple: {
      const Triple& triple = records.triples[change.record];
      const std::uint32_t lists[kLists] = {change.pairs[kListSP],
                                           change.pairs[kListPO],
                                           change.pairs[kListOS],
                                           records.nodes[triple.subject].as_subject,
                                           records.nodes[triple.predicate].as_predicate,
                                           records.nodes[triple.object].as_object};
      for (std::uint32_t list = 0; list < kLists; ++list) {
        Posting& posting = records.postings[lists[list]];
        const std::uint32_t tail = change.tails[list];
        store(tail == 0 ? posting.head : records.triples[tail].next[list], 0);
        posting.tail = tail;
        store(posting.count, posting.count - 1);
        if (posting.count == 0 && list < kListOS) {
          count_pair(static_cast<List>(list), lists[list], -1);
        }
      }
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
      store(records.marks[change.record].removed, kNever);
      break;
  }
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
