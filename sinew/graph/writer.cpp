#include "sinew/graph/writer.h"

#include <fmt/format.h>

#include "sinew/base/error.h"

namespace sinew::graph {

Writer::Writer(std::uint32_t limit) : limit_(limit) {}

// ---- where things are appended ----

namespace {

std::uint32_t& posting_number(Node& node, List list) {
  return list == kListS ? node.as_subject : list == kListP ? node.as_predicate : node.as_object;
}

}  // namespace

// Postings are never given back, and a reader comes to one only after it was published.
std::uint32_t Writer::new_posting(std::uint32_t first, std::uint32_t second) {
  Posting& made = records.postings.reserve(++records.posting_count);
  made = Posting{};
  made.first = first;
  made.second = second;
  made.patience = kFirstPatience;
  return records.posting_count;
}

inline Posting& Writer::single_posting(List list, std::uint32_t term) {
  std::uint32_t& number = posting_number(records.nodes.reserve(term), list);
  if (number == 0) store(number, new_posting());
  return records.postings[number];
}

inline std::uint32_t Writer::graph_number(std::uint32_t name) {
  Node& node = records.nodes.reserve(name);
  if (node.as_graph == 0) {
    records.graphs.reserve(records.graph_count + 1) = {name, new_posting(), 0, 0};
    store(node.as_graph, records.graph_count + 1);
    store(records.graph_count, records.graph_count + 1);
  }
  return node.as_graph;
}

// A predicate's distinct subjects or objects: its SP or PO lists that are not empty.
void Writer::count_pair(List list, std::uint32_t predicate, int by) {
  if (list == kListOS) return;
  Posting& all = single_posting(kListP, predicate);
  std::uint32_t& counter = all.summary[list == kListSP ? kSubjects : kObjects];
  store(counter, counter + static_cast<std::uint32_t>(by));
}

inline void Writer::append(Posting& posting, List list, std::uint32_t triple,
                           std::uint32_t& tail_before) {
  tail_before = posting.tail;
  store(posting.tail == 0 ? posting.head : records.triples[posting.tail].next[list], triple);
  posting.tail = triple;
  store(posting.count, posting.count + 1);
}

inline void Writer::filter(Posting& posting, std::uint32_t triple) const {
  const ObjectBit bit(records.triples[triple].object);
  store(posting.summary[bit.word], posting.summary[bit.word] | bit.mask);
}

inline Writer::PairPlace Writer::place(List list, const PairKey& key, Version version) const {
  PairPlace place{0, SlotTable::Slot()};
  place.found = records.find_pair(list, key.pair, key.hash, version, &place.at);
  return place;
}

bool Writer::append_pair(List list, const PairKey& key, const PairPlace& place,
                         std::uint32_t triple, std::uint32_t& tail_before) {
  SlotTable& table = records.pairs[list];
  if (!place.found) {
    table.insert(place.at, key.hash, triple);
    return true;
  }
  std::uint32_t number = place.found.number();
  if (!place.found.marked()) {
    const std::uint32_t only = number;
    number = new_posting(key.pair.first, key.pair.second);
    Posting& made = records.postings[number];
    made.tail = only;
    store(made.count, 1);
    store(made.head, only);
    if (list == kListSP) filter(made, only);
    table.replace(place.at, number, true);
  }
  Posting& posting = records.postings[number];
  if (list == kListSP) filter(posting, triple);
  append(posting, list, triple, tail_before);
  return posting.count == 1;
}

void Writer::append_between(std::uint32_t triple, Version version) {
  const PairKey pair = key(Records::pair_of(records.triples[triple], kListOS));
  std::uint32_t tail_before = 0;
  append_pair(kListOS, pair, place(kListOS, pair, version), triple, tail_before);
}

// A triple is in a list OS exactly if its subject and its object are crowded. It stays crowded:
// when it became so by what is now taken back, a reader may have seen it already.
void Writer::make_crowded(Posting& posting, List list, Version version) {
  for (std::uint32_t at = posting.head; at != 0;) {
    const Triple& triple = records.triples[at];
    const Node& node = records.nodes[list == kListS ? triple.object : triple.subject];
    const std::uint32_t other = list == kListS ? node.as_object : node.as_subject;
    if (Records::crowded(records.postings[other])) append_between(at, version);
    at = triple.next[list];
  }
  store(posting.first, 1);
}

void Writer::refuse_long() const {
  Problem problem;
  problem.what = fmt::format("the transaction has made {} changes", change_count_);
  problem.remedy = "commit now and then";
  throw Error(std::move(problem));
}

void Writer::refuse_full() const {
  Problem problem;
  problem.what = fmt::format("the store is full: it holds {} triples in {} graph memberships",
                             records.triple_count, records.membership_count);
  problem.remedy = "raise its limit, or remove what is not needed and begin a new transaction";
  throw Error(std::move(problem));
}

inline void Writer::prepare() {
  if (change_count_ == UINT32_MAX) refuse_long();
  log_->reserve(change_count_);
}

// ---- changes ----

bool Writer::add(const Quad& quad, Version version) {
  const std::uint32_t subject = quad.subject.value, predicate = quad.predicate.value;
  const std::uint32_t object = quad.object.value;
  if (records.triple_count >= limit_ || records.membership_count >= limit_) refuse_full();
  prepare();
  // What will be needed from far away is asked for first. A term of a triple that is there already
  // has its lists, so making them here is not in vain.
  const PairKey of_subject = key({subject, predicate}), of_object = key({predicate, object});
  records.pairs[kListSP].prefetch(of_subject.hash);
  records.pairs[kListPO].prefetch(of_object.hash);
  Posting& to = single_posting(kListO, object);
  Posting& from = single_posting(kListS, subject);
  Posting& all = single_posting(kListP, predicate);
  records.triples.prefetch(to.tail);
  records.triples.prefetch(all.tail);

  Change change{};
  const PairPlace at_subject = place(kListSP, of_subject, version);
  const std::uint32_t present =
      at_subject.found ? records.find(subject, predicate, object, version, at_subject.found) : 0;
  if (present) {
    if (find_membership(present, quad.graph.value)) return false;
    change.kind = Change::kAddMembership;
    change.record = present;
    change.membership = append_membership(present, quad.graph.value, version, change);
    note(change);
    return true;
  }

  change.kind = Change::kAddTriple;
  const std::uint32_t number = records.triple_count + 1;
  change.record = number;
  Triple& triple = records.triples.reserve(number);
  store(triple.added, version);
  store(triple.removed, kNever);
  triple.subject = subject;
  triple.predicate = predicate;
  triple.object = object;
  store(triple.graph, quad.graph.value);
  store(triple.first_membership, 0);
  triple.last_membership = 0;
  for (std::uint32_t& next : triple.next) store(next, 0);
  change.membership = append_membership(number, quad.graph.value, version, change);

  if (from.count >= kUncrowded && !Records::crowded(from)) make_crowded(from, kListS, version);
  if (to.count >= kUncrowded && !Records::crowded(to)) make_crowded(to, kListO, version);
  append(from, kListS, number, change.tails[kListS]);
  append(all, kListP, number, change.tails[kListP]);
  append(to, kListO, number, change.tails[kListO]);
  if (append_pair(kListSP, of_subject, at_subject, number, change.tails[kListSP])) {
    store(all.summary[kSubjects], all.summary[kSubjects] + 1);
  }
  const PairPlace at_object = place(kListPO, of_object, version);
  if (append_pair(kListPO, of_object, at_object, number, change.tails[kListPO])) {
    store(all.summary[kObjects], all.summary[kObjects] + 1);
  }
  change.pairs[kListSP] = at_subject.at;
  change.pairs[kListPO] = at_object.at;
  if (Records::crowded(from) && Records::crowded(to)) append_between(number, version);
  store(records.triple_count, number);
  ++records.live_count;
  note(change);
  return true;
}

inline void Writer::expect_pairs(const Quad& quad) {
  records.pairs[kListSP].prefetch(hash_pair(quad.subject.value, quad.predicate.value));
  records.pairs[kListPO].prefetch(hash_pair(quad.predicate.value, quad.object.value));
  __builtin_prefetch(&records.nodes.reserve(quad.object.value), 1);
}

inline void Writer::expect_list(const Quad& quad) const {
  records.postings.prefetch(records.nodes[quad.object.value].as_object);
}

inline void Writer::expect_tail(const Quad& quad) const {
  const std::uint32_t to = records.nodes[quad.object.value].as_object;
  if (to != 0) records.triples.prefetch(records.postings[to].tail);
}

std::size_t Writer::add(std::span<const Quad> quads, Version version) {
  // Steps ahead, some 30 ns each: memory out of the caches answers in 50 to 100 ns. What all quads
  // of one subject share is near anyway; objects are what jumps about.
  constexpr std::size_t kPairs = 12, kList = 8, kTail = 4;
  constexpr std::uint32_t kOutOfCaches = 1 << 14;  // triples
  std::size_t count = 0, at = 0;
  for (; records.triple_count < kOutOfCaches && at < quads.size(); ++at) {
    count += add(quads[at], version);
  }
  for (const std::size_t begin = at; at < quads.size(); ++at) {
    if (at + kPairs < quads.size()) expect_pairs(quads[at + kPairs]);
    if (at >= begin + kPairs - kList && at + kList < quads.size()) expect_list(quads[at + kList]);
    if (at >= begin + kPairs - kTail && at + kTail < quads.size()) expect_tail(quads[at + kTail]);
    count += add(quads[at], version);
  }
  return count;
}

std::uint32_t Writer::append_membership(std::uint32_t triple_number, std::uint32_t graph_name,
                                        Version version, Change& change) {
  Graph& graph = records.graphs[graph_number(graph_name)];
  Triple& triple = records.triples[triple_number];
  const std::uint32_t number = ++records.membership_count;
  Membership& membership = records.memberships.reserve(number);
  store(membership.added, version);
  store(membership.removed, kNever);
  membership.triple = triple_number;
  membership.graph = graph_name;
  store(membership.next_of_triple, 0);
  store(membership.next_in_graph, 0);

  Posting& members = records.postings[graph.members];
  change.graph_tail = members.tail;
  store(members.tail == 0 ? members.head : records.memberships[members.tail].next_in_graph, number);
  members.tail = number;
  store(members.count, members.count + 1);

  if (triple.last_membership == 0) {
    store(triple.first_membership, number);
  } else {
    change.tails[0] = triple.last_membership;
    change.graph = triple.graph;
    store(records.memberships[triple.last_membership].next_of_triple, number);
    store(triple.graph, kSeveralGraphs);
  }
  triple.last_membership = number;
  return number;
}

// The live membership, or 0. The triple's and the graph's memberships are walked side by side, so
// the shorter list bounds the time.
std::uint32_t Writer::find_membership(std::uint32_t triple_number, std::uint32_t graph_name) const {
  const Triple& triple = records.triples[triple_number];
  const auto is_it = [&](std::uint32_t number) {
    const Membership& membership = records.memberships[number];
    return membership.triple == triple_number && membership.graph == graph_name &&
           membership.removed == kNever;
  };
  if (triple.graph != kSeveralGraphs) {
    return triple.graph == graph_name ? triple.first_membership : 0;
  }
  const Graph* graph = records.graph(graph_name);
  if (!graph) return 0;
  std::uint32_t of_triple = triple.first_membership;
  std::uint32_t in_graph = records.postings[graph->members].head;
  while (of_triple != 0 && in_graph != 0) {
    if (is_it(of_triple)) return of_triple;
    if (is_it(in_graph)) return in_graph;
    of_triple = records.memberships[of_triple].next_of_triple;
    in_graph = records.memberships[in_graph].next_in_graph;
  }
  return 0;
}

bool Writer::remove(const Quad& quad, Version version) {
  const std::uint32_t triple =
      records.find(quad.subject.value, quad.predicate.value, quad.object.value, version);
  const std::uint32_t membership = triple ? find_membership(triple, quad.graph.value) : 0;
  if (!membership) return false;
  remove_membership(membership, version);
  return true;
}

void Writer::remove_membership(std::uint32_t number, Version version) {
  prepare();
  Membership& membership = records.memberships[number];
  Triple& triple = records.triples[membership.triple];
  store(membership.removed, version);
  Change change{};
  change.kind = Change::kRemove;
  change.record = membership.triple;
  change.membership = number;
  change.last = true;
  if (triple.graph == kSeveralGraphs) {
    for (std::uint32_t at = triple.first_membership; at != 0 && change.last;) {
      change.last = records.memberships[at].removed != kNever;
      at = records.memberships[at].next_of_triple;
    }
  }
  if (change.last) {
    store(triple.removed, version);
    --records.live_count;
  }
  note(change);
}

void Writer::clear(std::uint32_t name, Version version) {
  const Graph* graph = records.graph(name);
  if (!graph) return;
  for (std::uint32_t at = records.postings[graph->members].head; at != 0;) {
    if (records.memberships[at].removed == kNever) remove_membership(at, version);
    at = records.memberships[at].next_in_graph;
  }
}

void Writer::create_graph(std::uint32_t name, Version version) {
  const std::uint32_t number = graph_number(name);
  Graph& graph = records.graphs[number];
  for (std::uint32_t at = graph.marks; at != 0; at = records.marks[at].next) {
    if (records.marks[at].removed == kNever) return;
  }
  prepare();
  const std::uint32_t mark_number = ++records.mark_count;
  GraphMark& mark = records.marks.reserve(mark_number);
  store(mark.added, version);
  store(mark.removed, kNever);
  store(mark.next, graph.marks);
  store(graph.marks, mark_number);
  Change change{};
  change.kind = Change::kAddMark;
  change.record = mark_number;
  change.graph = number;
  note(change);
}

void Writer::drop_graph(std::uint32_t name, Version version) {
  clear(name, version);
  const Graph* graph = records.graph(name);
  if (!graph) return;
  for (std::uint32_t at = graph->marks; at != 0; at = records.marks[at].next) {
    if (records.marks[at].removed != kNever) continue;
    prepare();
    store(records.marks[at].removed, version);
    Change change{};
    change.kind = Change::kRemoveMark;
    change.record = at;
    note(change);
  }
}

}  // namespace sinew::graph
