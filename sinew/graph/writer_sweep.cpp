// Unlinking removed records, so that lists stay as short as what is alive in them.
#include <algorithm>

#include "sinew/graph/writer.h"

namespace sinew::graph {

void Writer::finish(Version oldest) {
  catch_up();
  for (std::uint32_t at = 0; removal_count_ > 0; ++at) {
    const Change& change = (*log_)[at];
    if (!is_removal(change)) continue;
    --removal_count_;
    ++dead_records_;
    if (change.kind == Change::kRemoveMark) continue;
    Triple& triple = records.triples[change.record];
    const std::uint32_t graph =
        change.membership ? records.memberships[change.membership].graph : triple.graph;
    sweep_graph(records.graphs[records.nodes[graph].as_graph].members, oldest);
    if (!change.last) {
      if (change.membership && change.membership % kTripleSweep == 0) sweep_triple(triple, oldest);
      continue;
    }
    for (const List list : {kListSP, kListPO, kListOS}) sweep_pair(list, triple, oldest);
    sweep(records.nodes[triple.subject].as_subject, kListS, oldest);
    sweep(of_predicate(triple.predicate).chain, kListP, oldest);
    sweep(records.nodes[triple.object].as_object, kListO, oldest);
  }
  if (change_count_ > kLargeLog) log_ = std::make_unique<StableArray<Change, Fill::kRaw>>();
  change_count_ = 0;
}

namespace {

// Unlinks what no reader needs: for which removed(at) is not later than `oldest`. Returns the
// number of records that were removed but must stay.
template <typename Removed, typename Next>
std::uint32_t unlink(std::uint32_t& head, std::uint32_t& tail, std::uint32_t& count, Version oldest,
                     Removed&& removed, Next&& next) {
  std::uint32_t kept = 0, last = 0, left = 0;
  for (std::uint32_t at = head; at != 0;) {
    const std::uint32_t following = next(at);
    const Version end = removed(at);
    if (end <= oldest) {
      store(last == 0 ? head : next(last), following);
    } else {
      if (end != kNever) ++kept;
      last = at;
      ++left;
    }
    at = following;
  }
  tail = last;
  store(count, left);
  return kept;
}

bool patient(Chain& chain) {
  if (chain.patience == 0) return chain.count == 0;
  --chain.patience;
  return true;
}

}  // namespace

// A list of one triple has no posting, and stays as it is.
void Writer::sweep_pair(List list, const Triple& triple, Version oldest) {
  const SlotTable::Slot found = records.find_pair(list, Records::pair_of(triple, list), kNever - 1);
  if (!found.marked()) return;
  Posting& posting = records.postings[found.number()];
  const bool was_empty = posting.chain.count == 0;
  sweep(posting.chain, list, oldest);
  if (posting.chain.count == 0 && !was_empty) count_pair(list, triple.predicate, -1);
}

void Writer::sweep(Chain& chain, List list, Version oldest) {
  if (patient(chain)) return;
  // Until when the last graph holds it.
  const auto removed = [this](std::uint32_t at) {
    const Triple& triple = records.triples[at];
    Version end = triple.removed;
    for (std::uint32_t held = triple.memberships; held != 0;) {
      end = std::max(end, records.memberships[held].removed);
      held = records.memberships[held].next_of_triple;
    }
    return end;
  };
  const std::uint32_t kept =
      unlink(chain.head, chain.tail, chain.count, oldest, removed,
             [&](std::uint32_t at) -> std::uint32_t& { return records.triples[at].next[list]; });
  chain.patience = chain.count + kept + kFirstPatience;
}

void Writer::sweep_graph(Chain& members, Version oldest) {
  if (patient(members)) return;
  const auto removed = [this](std::uint32_t at) {
    return at & kFurther ? records.memberships[at & ~kFurther].removed
                         : records.triples[at].removed;
  };
  const std::uint32_t kept =
      unlink(members.head, members.tail, members.count, oldest, removed,
             [this](std::uint32_t at) -> std::uint32_t& { return next_in_graph(at); });
  members.patience = members.count + kept + kFirstPatience;
}

void Writer::sweep_triple(Triple& triple, Version oldest) {
  std::uint32_t last = 0, count = 0;
  unlink(
      triple.memberships, last, count, oldest,
      [this](std::uint32_t at) { return records.memberships[at].removed; },
      [this](std::uint32_t at) -> std::uint32_t& {
        return records.memberships[at].next_of_triple;
      });
  if (last != 0) records.memberships[triple.memberships].last_of_triple = last;
}

}  // namespace sinew::graph
