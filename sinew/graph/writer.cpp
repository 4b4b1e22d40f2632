#include "sinew/graph/writer.h"

#include <fmt/format.h>

#include "sinew/base/error.h"

namespace sinew::graph {

Writer::Writer(std::uint32_t limit) : limit_(limit) {}

// ---- where things are appended ----

// Postings are never given back, and a reader comes to one only after it was published.
std::uint32_t Writer::new_posting(std::uint32_t first, std::uint32_t second) {
  Posting& made = records.postings.reserve(++records.posting_count);
  made = Posting{};
  made.first = first;
  made.second = second;
  made.chain.patience = kFirstPatience;
  return records.posting_count;
}

Posting& Writer::of_predicate(std::uint32_t term) {
  std::uint32_t& number = records.nodes.reserve(term).as_predicate;
  if (number == 0) store(number, new_posting());
  return records.postings[number];
}

inline std::uint32_t Writer::graph_number(std::uint32_t name) {
  Node& node = records.nodes.reserve(name);
  if (node.as_graph == 0) {
    Graph& made = records.graphs.reserve(records.graph_count + 1);
    made = {};
    made.members.patience = kFirstPatience;
    made.name = name;
    store(node.as_graph, records.graph_count + 1);
    store(records.graph_count, records.graph_count + 1);
  }
  return node.as_graph;
}

// A predicate's distinct subjects or objects: its SP or PO lists that are not empty.
void Writer::count_pair(List list, std::uint32_t predicate, int by) {
  if (list == kListOS) return;
  Posting& all = of_predicate(predicate);
  std::uint32_t& counter = all.summary[list == kListSP ? kSubjects : kObjects];
  store(counter, counter + static_cast<std::uint32_t>(by));
}

inline void Writer::append(Chain& chain, List list, std::uint32_t triple,
                           std::uint32_t& tail_before) {
  tail_before = chain.tail;
  // Chosen without a branch, which for objects would be guessed wrong every few times.
  std::uint32_t* link = &records.triples[chain.tail].next[list];
  if (chain.tail == 0) link = &chain.head;
  store(*link, triple);
  chain.tail = triple;
  store(chain.count, chain.count + 1);
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

inline bool Writer::append_pair(List list, const PairKey& key, const PairPlace& place,
                                std::uint32_t triple, std::uint32_t& tail_before) {
  if (place.found) return append_to_pair(list, key, place, triple, tail_before);
  records.pairs[list].insert(place.at, key.hash, triple);
  return true;
}

bool Writer::append_to_pair(List list, const PairKey& key, const PairPlace& place,
                            std::uint32_t triple, std::uint32_t& tail_before) {
  SlotTable& table = records.pairs[list];
  std::uint32_t number = place.found.number();
  if (!place.found.marked()) {
    const std::uint32_t only = number;
    number = new_posting(key.pair.first, key.pair.second);
    Posting& made = records.postings[number];
    made.chain.tail = only;
    store(made.chain.count, 1);
    store(made.chain.head, only);
    if (list == kListSP) filter(made, only);
    table.replace(place.at, number, true);
  }
  Posting& posting = records.postings[number];
  if (list == kListSP) filter(posting, triple);
  append(posting.chain, list, triple, tail_before);
  return posting.chain.count == 1;
}

void Writer::append_between(std::uint32_t triple, Version version) {
  const PairKey pair = key(Records::pair_of(records.triples[triple], kListOS));
  std::uint32_t tail_before = 0;
  append_pair(kListOS, pair, place(kListOS, pair, version), triple, tail_before);
}

// A triple is in a list OS exactly if its subject and its object are crowded. It stays crowded:
// when it became so by what is now taken back, a reader may have seen it already.
void Writer::make_crowded(Node& node, List list, Version version) {
  for (std::uint32_t at = Records::chain(node, list).head; at != 0;) {
    const Triple& triple = records.triples[at];
    const bool other_too = list == kListS ? records.nodes[triple.object].object_is_crowded != 0
                                          : records.nodes[triple.subject].subject_is_crowded != 0;
    if (other_too) append_between(at, version);
    at = triple.next[list];
  }
  store(list == kListS ? node.subject_is_crowded : node.object_is_crowded, 1);
}

void Writer::refuse_long() const {
  Problem problem;
  problem.what = fmt::format("the transaction has made {} changes", change_count_);
  problem.remedy = "commit now and then";
  throw Error(std::move(problem));
}

void Writer::refuse_full() const {
  Problem problem;
  problem.what = fmt::format("the store is full: it holds {} triples, {} times in a further graph",
                             records.triple_count, records.membership_count);
  problem.remedy = "raise its limit, or remove what is not needed and begin a new transaction";
  throw Error(std::move(problem));
}

inline void Writer::prepare() {
  if (change_count_ == UINT32_MAX) refuse_long();
  log_->reserve(change_count_);
}

// ---- changes ----

inline bool Writer::is_near(const Node& subject) const {
  constexpr std::uint32_t kFew = 8;
  const Chain& chain = subject.as_subject;
  return chain.count == 0 || (chain.count <= kFew && records.triple_count - chain.tail < 2 * kFew);
}

inline std::uint32_t Writer::find_near(const Node& subject, const Quad& quad,
                                       Version version) const {
  for (std::uint32_t at = subject.as_subject.head; at != 0;) {
    const Triple& triple = records.triples[at];
    if (triple.predicate == quad.predicate.value && triple.object == quad.object.value &&
        records.still_there(triple, version)) {
      return at;
    }
    at = triple.next[kListS];
  }
  return 0;
}

// Precondition: all triples before it are linked.
inline void Writer::link(std::uint32_t number, const Ends& ends, const PairKey& of_subject,
                         const PairPlace& at_subject, const PairKey& of_object, Change& change) {
  const Triple& triple = records.triples[number];
  const auto& [subject, object, predicate] = ends;
  if (object.as_object.count >= kUncrowded && !object.object_is_crowded) {
    make_crowded(object, kListO, triple.added);
  }
  append(object.as_object, kListO, number, change.tails[kListO]);
  if (append_pair(kListSP, of_subject, at_subject, number, change.tails[kListSP])) {
    store(predicate.summary[kSubjects], predicate.summary[kSubjects] + 1);
  }
  const PairPlace at_object = place(kListPO, of_object, triple.added);
  if (append_pair(kListPO, of_object, at_object, number, change.tails[kListPO])) {
    store(predicate.summary[kObjects], predicate.summary[kObjects] + 1);
  }
  change.pairs[kListSP] = at_subject.at;
  change.pairs[kListPO] = at_object.at;
  if (object.object_is_crowded && subject.subject_is_crowded) append_between(number, triple.added);
  linked_ = number;
}

void Writer::link_next() {
  const std::uint32_t number = linked_ + 1;
  const Triple& triple = records.triples[number];
  const Waiting& waiting = waiting_[number & kWaitingMask];
  const PairKey of_subject{{triple.subject, triple.predicate}, waiting.pair_hashes[kListSP]};
  const PairKey of_object{{triple.predicate, triple.object}, waiting.pair_hashes[kListPO]};
  Change unused;
  link(number, {*waiting.subject, *waiting.object, *waiting.predicate}, of_subject,
       place(kListSP, of_subject, triple.added), of_object, unused);
}

bool Writer::add(const Quad& quad, Version version) {
  const std::uint32_t subject = quad.subject.value, predicate = quad.predicate.value;
  const std::uint32_t object = quad.object.value;
  if (records.triple_count >= limit_ || records.membership_count >= limit_) refuse_full();
  prepare();
  // What will be needed from far away is asked for first. A term of a triple that is there already
  // has its record, so making it here is not in vain.
  const PairKey of_subject = key({subject, predicate}), of_object = key({predicate, object});
  records.pairs[kListSP].prefetch(of_subject.hash);
  records.pairs[kListPO].prefetch(of_object.hash);
  Node& to = records.nodes.reserve(object);
  __builtin_prefetch(&to, 1);
  Node& from = records.nodes.reserve(subject);
  Posting& all = of_predicate(predicate);

  const std::uint32_t number = records.triple_count + 1;
  const bool waits = !shown_ && !notes_all() && number > kOutOfCaches;
  PairPlace at_subject{0, SlotTable::Slot()};
  std::uint32_t present = 0;
  if (waits && is_near(from)) {
    present = find_near(from, quad, version);
  } else {
    if (!waits || from.as_subject.tail > linked_) catch_up();
    at_subject = place(kListSP, of_subject, version);
    if (at_subject.found) {
      if (at_subject.found.marked()) catch_up();  // other lists may be shorter than this one
      present = records.find(subject, predicate, object, version, at_subject.found);
    }
  }
  const std::uint32_t graph = quad.graph.value;
  if (present) {
    std::uint32_t membership = 0;
    if (find_membership(present, graph, membership)) return false;
    append_membership(present, graph, version);
    return true;
  }

  // Noted where it stays: prepare() has made room.
  Change unused;
  Change& change = notes_all() ? (*log_)[change_count_] : unused;
  change = {};
  change.kind = Change::kAddTriple;
  change.record = number;
  Triple& triple = records.triples.reserve(number);
  store(triple.added, version);
  store(triple.removed, kNever);
  triple.subject = subject;
  triple.predicate = predicate;
  triple.object = object;
  triple.graph = graph;
  for (std::uint32_t& next : triple.next) store(next, 0);
  store(triple.next_in_graph, 0);
  store(triple.memberships, 0);
  change.graph_tail = append_member(graph, number);

  if (from.as_subject.count >= kUncrowded && !from.subject_is_crowded) {
    catch_up();
    make_crowded(from, kListS, version);
  }
  append(from.as_subject, kListS, number, change.tails[kListS]);
  append(all.chain, kListP, number, change.tails[kListP]);
  if (!waits) {
    link(number, {from, to, all}, of_subject, at_subject, of_object, change);
  } else {
    waiting_[number & kWaitingMask] = {&from, &to, &all, {of_subject.hash, of_object.hash}};
    if (number - linked_ > kBehind) {
      link_next();
      const Waiting& later = waiting_[(number - kBehind / 2) & kWaitingMask];
      records.triples.prefetch(later.object->as_object.tail);
    }
  }
  store(records.triple_count, number);
  ++records.live_count;
  note_triple(number);
  return true;
}

std::size_t Writer::add(std::span<const Quad> quads, Version version) {
  std::size_t count = 0;
  for (const Quad& quad : quads) count += add(quad, version);
  return count;
}

void Writer::show() {
  catch_up();
  shown_ = true;
}

// Each further run is farther away, so that they are few.
void Writer::note_other(const Change& change) {
  if (change_count_ > 0 && (*log_)[change_count_ - 1].kind == Change::kAddTriples) {
    noted_ = noted_after_run_;
    if (noted_after_run_ < UINT32_MAX / 2) noted_after_run_ *= 2;
  }
  note(change);
}

inline void Writer::note_triple(std::uint32_t number) {
  if (notes_all()) {
    if (!marked_) --noted_;
    ++change_count_;  // the note is there
    return;
  }
  if (change_count_ > 0) {
    Change& last = (*log_)[change_count_ - 1];
    if (last.kind == Change::kAddTriples) {
      ++last.count;
      return;
    }
  }
  Change run{};
  run.kind = Change::kAddTriples;
  run.record = number;
  run.count = 1;
  note(run);
}

inline std::uint32_t Writer::append_member(std::uint32_t graph_name, std::uint32_t member) {
  Chain& members = records.graphs[graph_number(graph_name)].members;
  const std::uint32_t tail_before = members.tail;
  store(tail_before == 0 ? members.head : next_in_graph(tail_before), member);
  members.tail = member;
  store(members.count, members.count + 1);
  return tail_before;
}

void Writer::append_membership(std::uint32_t triple_number, std::uint32_t graph, Version version) {
  Triple& triple = records.triples[triple_number];
  const std::uint32_t number = ++records.membership_count;
  Membership& membership = records.memberships.reserve(number);
  store(membership.added, version);
  store(membership.removed, kNever);
  membership.triple = triple_number;
  membership.graph = graph;
  store(membership.next_of_triple, 0);
  store(membership.next_in_graph, 0);
  membership.last_of_triple = number;
  Change change{};
  change.kind = Change::kAddMembership;
  change.record = triple_number;
  change.membership = number;
  change.graph_tail = append_member(graph, number | kFurther);
  if (triple.memberships == 0) {
    store(triple.memberships, number);
  } else {
    std::uint32_t& last = records.memberships[triple.memberships].last_of_triple;
    change.tails[0] = last;
    store(records.memberships[last].next_of_triple, number);
    last = number;
  }
  note_other(change);
}

// The triple's and the graph's memberships are walked side by side, so the shorter list bounds the
// time.
bool Writer::find_membership(std::uint32_t triple_number, std::uint32_t graph_name,
                             std::uint32_t& membership) const {
  const Triple& triple = records.triples[triple_number];
  membership = 0;
  if (triple.graph == graph_name && triple.removed == kNever) return true;
  const auto is_it = [&](std::uint32_t number) {
    const Membership& further = records.memberships[number];
    if (further.triple != triple_number || further.graph != graph_name ||
        further.removed != kNever) {
      return false;
    }
    membership = number;
    return true;
  };
  const Graph* graph = records.graph(graph_name);
  if (!graph) return false;
  std::uint32_t of_triple = triple.memberships;
  std::uint32_t in_graph = graph->members.head;
  while (of_triple != 0 && in_graph != 0) {
    if (is_it(of_triple)) return true;
    of_triple = records.memberships[of_triple].next_of_triple;
    if (in_graph & kFurther) {
      if (is_it(in_graph & ~kFurther)) return true;
      in_graph = records.memberships[in_graph & ~kFurther].next_in_graph;
    } else {
      in_graph = records.triples[in_graph].next_in_graph;
    }
  }
  return false;
}

bool Writer::remove(const Quad& quad, Version version) {
  catch_up();
  const std::uint32_t triple =
      records.find(quad.subject.value, quad.predicate.value, quad.object.value, version);
  std::uint32_t membership = 0;
  if (!triple || !find_membership(triple, quad.graph.value, membership)) return false;
  remove_membership(triple, membership, version);
  return true;
}

void Writer::remove_membership(std::uint32_t number, std::uint32_t membership, Version version) {
  prepare();
  Triple& triple = records.triples[number];
  store(membership ? records.memberships[membership].removed : triple.removed, version);
  Change change{};
  change.kind = Change::kRemove;
  change.record = number;
  change.membership = membership;
  change.last = !records.still_there(triple, version);
  if (change.last) --records.live_count;
  note_other(change);
}

void Writer::clear(std::uint32_t name, Version version) {
  const Graph* graph = records.graph(name);
  if (!graph) return;
  for (std::uint32_t at = graph->members.head; at != 0; at = next_in_graph(at)) {
    if (at & kFurther) {
      const Membership& membership = records.memberships[at & ~kFurther];
      if (membership.removed == kNever)
        remove_membership(membership.triple, at & ~kFurther, version);
    } else if (records.triples[at].removed == kNever) {
      remove_membership(at, 0, version);
    }
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
  note_other(change);
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
    note_other(change);
  }
}

}  // namespace sinew::graph
