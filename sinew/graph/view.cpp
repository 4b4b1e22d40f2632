#include "sinew/graph/view.h"

#include <algorithm>
#include <atomic>

namespace sinew::graph {

std::uint64_t next_identity() {
  static std::atomic<std::uint64_t> last = 0;
  return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

const Terms& View::terms() const { return *terms_; }

bool View::contains(Id subject, Id predicate, Id object, Dataset dataset) const {
  if (!subject || !predicate || !object) {
    return !match(subject, predicate, object, dataset, [](const Quad&) { return false; });
  }
  const Records& in = records();
  const Version at_version = version();
  const std::uint32_t at = in.find(subject.value, predicate.value, object.value, at_version);
  return at != 0 && (dataset == Dataset::kUnion || in.holds(in.triples[at], 0, at_version));
}

bool View::contains_in(const Quad& quad) const {
  return !match_in(quad.subject, quad.predicate, quad.object, quad.graph,
                   [](const Quad&) { return false; });
}

Id View::object(Id subject, Id predicate) const {
  Id found;
  match(subject, predicate, {}, Dataset::kUnion, [&](const Quad& quad) {
    found = quad.object;
    return false;
  });
  return found;
}

Id View::subject(Id predicate, Id object) const {
  Id found;
  match({}, predicate, object, Dataset::kUnion, [&](const Quad& quad) {
    found = quad.subject;
    return false;
  });
  return found;
}

std::size_t View::estimate(Id subject, Id predicate, Id object) const {
  const Records& in = records();
  if (!subject && !predicate && !object) return load(in.triple_count);
  if (subject && predicate && object) {
    return std::min({std::size_t{1}, estimate(subject, predicate, {}),
                     estimate({}, predicate, object), estimate(subject, {}, object)});
  }
  List list;
  return in.run(subject.value, predicate.value, object.value, version(), list).count;
}

std::size_t View::distinct_subjects(Id predicate) const {
  const Posting* posting = records().of_predicate(predicate.value);
  return posting ? load(posting->summary[kSubjects]) : 0;
}

std::size_t View::distinct_objects(Id predicate) const {
  const Posting* posting = records().of_predicate(predicate.value);
  return posting ? load(posting->summary[kObjects]) : 0;
}

std::size_t View::size() const {
  if (present_) return present_->size;
  return size_ == kUnfinished ? records_->live_count : size_;
}

bool View::has_graph(Id graph) const {
  const MatchScope scope;
  const Records& in = records();
  const Graph* found = in.graph(graph.value);
  return found && named(in, *found, version());
}

bool View::named(const Records& in, const Graph& graph, Version version) {
  for (std::uint32_t at = load(graph.marks); at != 0; at = load(in.marks[at].next)) {
    const GraphMark& mark = in.marks[at];
    if (load(mark.added) <= version && Records::still_in_graph(mark, version)) return true;
  }
  return !visit_members(in, graph, version, [](const Triple&) { return false; });
}

}  // namespace sinew::graph
