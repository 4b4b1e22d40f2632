// Unlinking removed records, so that lists stay as short as what is alive in them.
#include "sinew/graph/writer.h"

namespace sinew::graph {

void Writer::finish(Version oldest) {
  for (std::uint32_t at = 0; removal_count_ > 0; ++at) {
    const Change& change = (*log_)[at];
    if (!is_removal(change)) continue;
    --removal_count_;
    ++dead_records_;
    if (change.kind == Change::kRemoveMark) continue;
    const std::uint32_t graph = records.memberships[change.membership].graph;
    sweep_graph(records.graph(graph)->members, oldest);
    Triple& triple = records.triples[change.record];
    if (!change.last) {
      if (change.membership % kTripleSweep == 0) sweep_triple(triple, oldest);
      continue;
    }
    for (const List list : {kListSP, kListPO, kListOS}) sweep_pair(list, triple, oldest);
    sweep(records.postings[records.nodes[triple.subject].as_subject], kListS, oldest);
    sweep(records.postings[records.nodes[triple.predicate].as_predicate], kListP, oldest);
    sweep(records.postings[records.nodes[triple.object].as_object], kListO, oldest);
  }
  if (change_count_ > kLargeLog) log_ = std::make_unique<StableArray<Change, Fill::kRaw>>();
  change_count_ = 0;
}

namespace {

// Unlinks what no reader needs. Returns the number of records that were removed but must stay.
template <typename Array, typename Next>
std::uint32_t unlink(Array& array, std::uint32_t& head, std::uint32_t& tail, std::uint32_t& count,
                     Version oldest, Next&& next) {
  std::uint32_t kept = 0, last = 0, left = 0;
  for (std::uint32_t at = head; at != 0;) {
    const std::uint32_t following = next(array[at]);
    if (array[at].removed <= oldest) {
      store(last == 0 ? head : next(array[last]), following);
    } else {
      if (array[at].removed != kNever) ++kept;
      last = at;
      ++left;
    }
    at = following;
  }
  tail = last;
  store(count, left);
  return kept;
}

bool patient(Posting& posting) {
  if (posting.patience == 0) return posting.count == 0;
  --posting.patience;
  return true;
}

}  // namespace

// A list of one triple has no posting, and stays as it is.
void Writer::sweep_pair(List list, const Triple& triple, Version oldest) {
  const SlotTable::Slot found = records.find_pair(list, Records::pair_of(triple, list), kNever - 1);
  if (!found.marked()) return;
  Posting& posting = records.postings[found.number()];
  const bool was_empty = posting.count == 0;
  sweep(posting, list, oldest);
  if (posting.count == 0 && !was_empty) count_pair(list, triple.predicate, -1);
}

void Writer::sweep(Posting& posting, List list, Version oldest) {
  if (patient(posting)) return;
  const std::uint32_t kept =
      unlink(records.triples, posting.head, posting.tail, posting.count, oldest,
             [list](Triple& triple) -> std::uint32_t& { return triple.next[list]; });
  posting.patience = posting.count + kept + kFirstPatience;
}

void Writer::sweep_graph(std::uint32_t number, Version oldest) {
  Posting& posting = records.postings[number];
  if (patient(posting)) return;
  const std::uint32_t kept =
      unlink(records.memberships, posting.head, posting.tail, posting.count, oldest,
             [](Membership& membership) -> std::uint32_t& { return membership.next_in_graph; });
  posting.patience = posting.count + kept + kFirstPatience;
}

void Writer::sweep_triple(Triple& triple, Version oldest) {
  std::uint32_t count = 0;
  unlink(records.memberships, triple.first_membership, triple.last_membership, count, oldest,
         [](Membership& membership) -> std::uint32_t& { return membership.next_of_triple; });
}

}  // namespace sinew::graph
