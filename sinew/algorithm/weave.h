// Weaving: an algorithm rewritten by a SPARQL update, for loggers, monitors, further outputs, other
// operators.
//
// The update sees the algorithm's triples as its default graph and, where the store has it, the
// robot's normalised tree (docs/architecture.md) as a named graph, for limits and the like; nothing
// else. It can change the algorithm only. The result must
// be an algorithm as good as one that was synthesised: it is read and checked as a whole (check.h)
// before it takes the old one's place. If it is not, or the update fails, the old one stays as it
// was.
#pragma once

#include <string>
#include <string_view>

#include "sinew/graph/store.h"
#include "sinew/rdf/iri/prefixes.h"

namespace sinew::algorithm {

struct WeaveCounts {
  std::size_t added = 0, removed = 0;  // triples, of all rounds
  std::size_t rounds = 0;              // that changed something
};

// How often an update is applied that is to be repeated until it changes nothing.
inline constexpr std::size_t kMaximumRounds = 10'000;

enum class Rounds {
  kOne,
  kUntilSettled,  // until it changes nothing: for what no single query reaches (weaves/depths.rq)
};

// `name` is that of the update, for messages; `prefixes` are those that it may use without
// declaring them. Throws Error; also when an update still changes something after kMaximumRounds.
WeaveCounts weave(graph::Store& store, graph::Id algorithm, std::string_view update,
                  const std::string& name, Rounds rounds = Rounds::kOne,
                  const rdf::Prefixes* prefixes = nullptr);

}  // namespace sinew::algorithm
