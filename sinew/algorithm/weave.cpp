#include "sinew/algorithm/weave.h"

#include <unordered_map>
#include <vector>

#include "sinew/algorithm/read.h"
#include "sinew/base/error.h"
#include "sinew/rdf/sparql/engine.h"

namespace sinew::algorithm {
namespace {

using graph::Id;
using graph::Quad;
using graph::Terms;

// Written by `model` (model/tree.h), which may not be used here.
constexpr std::string_view kNormalisedGraph = "https://w3id.org/sinew/normalised";

// Terms of one dictionary in another. Blank nodes become fresh ones, so that none meets another by
// its label.
class Copier {
 public:
  Copier(const Terms& from, Terms& to) : from_(from), to_(to) {}

  Id operator()(Id id) {
    const std::string_view text = from_.text(id);
    if (from_.is_iri(id)) return to_.iri(text);
    if (from_.is_literal(id))
      return to_.literal(text, from_.text(from_.datatype(id)), from_.language(id));
    const auto [found, fresh] = blanks_.try_emplace(id);
    if (fresh) found->second = to_.fresh_blank();
    return found->second;
  }

 private:
  const Terms& from_;
  Terms& to_;
  std::unordered_map<Id, Id> blanks_;
};

std::vector<Quad> triples(const graph::View& view, Id graph) {
  std::vector<Quad> found;
  view.match_in({}, {}, {}, graph, [&](const Quad& quad) {
    found.push_back(quad);
    return true;
  });
  return found;
}

void copy_graph(const graph::View& from, Id graph, Terms& terms, graph::Transaction& to,
                Id target) {
  Copier copy(from.terms(), terms);
  for (const Quad& quad : triples(from, graph))
    to.add({copy(quad.subject), copy(quad.predicate), copy(quad.object), target});
}

}  // namespace

WeaveCounts weave(graph::Store& store, Id algorithm, std::string_view update,
                  const std::string& name, Rounds rounds, const rdf::Prefixes* prefixes) {
  // A store of its own, where the algorithm is the default graph.
  graph::Store loom;
  const Id woven = loom.terms().iri(store.terms().text(algorithm));
  graph::Transaction change = loom.begin();
  copy_graph(store.view(), algorithm, loom.terms(), change, {});
  if (const Id tree = store.terms().find_iri(kNormalisedGraph))
    copy_graph(store.view(), tree, loom.terms(), change, loom.terms().iri(kNormalisedGraph));
  rdf::sparql::UpdateOptions options;
  options.name = name;
  options.prefixes = prefixes;
  WeaveCounts total;
  for (;;) {
    const rdf::sparql::UpdateCounts counts =
        rdf::sparql::update(change, loom.terms(), update, options);
    if (counts.added + counts.removed == 0) break;
    total.added += counts.added;
    total.removed += counts.removed;
    ++total.rounds;
    if (rounds == Rounds::kOne) break;
    if (total.rounds == kMaximumRounds)
      throw Error(Problem{
          {name, 1, 0},
          std::string(store.terms().text(algorithm)),
          "the update still changes something after " + std::to_string(kMaximumRounds) + " rounds",
          "let it add only what is not there yet",
          {},
          {}});
  }
  for (const Quad& quad : triples(change.view(), {}))
    change.add({quad.subject, quad.predicate, quad.object, woven});
  change.commit();
  read_checked(loom.view(), woven);

  graph::Transaction result = store.begin();
  result.clear(algorithm);
  copy_graph(loom.view(), woven, store.terms(), result, algorithm);
  result.commit();
  return total;
}

}  // namespace sinew::algorithm
