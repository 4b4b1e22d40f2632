#include "sinew/world/qualitative_facts.h"

#include <algorithm>
#include <span>
#include <string>

#include "sinew/graph/standard_iris.h"
#include "sinew/world/refuse.h"
#include "sinew/world/symbols.h"

namespace sinew::world {
namespace {

// The seconds that a rule can be judged for: those that declare what it asks of them.
std::vector<BodyId> seconds_for(const Rule& rule, const Relations& relations,
                                const std::vector<BodyId>& bodies) {
  std::vector<BodyId> result;
  for (const BodyId body : bodies) {
    const bool declares = std::all_of(
        rule.conditions.begin(), rule.conditions.end(), [&](const Condition& condition) {
          return condition.maximum_of.empty() || relations.declares(body, condition.maximum_of);
        });
    if (declares) result.push_back(body);
  }
  return result;
}

struct FactWriter {
  graph::Store& store;
  graph::Transaction transaction = store.begin();
  graph::Id graph = store.terms().iri(kQualitativeGraph);

  graph::Id w(std::string_view term) {
    return store.terms().iri(std::string(kWorldNamespace) + std::string(term));
  }
  void write(const Judgement& judgement, const World& world,
             const std::vector<MeasurementId>& read) {
    graph::Terms& terms = store.terms();
    const graph::Id first = terms.iri(judgement.first), second = terms.iri(judgement.second);
    const graph::Id fact = terms.fresh_blank();
    transaction.add({fact, terms.iri(graph::kRdfType), w("RelationFact"), graph});
    transaction.add({fact, w("called"), terms.literal(judgement.relation), graph});
    transaction.add({fact, w("first"), first, graph});
    transaction.add({fact, w("second"), second, graph});
    if (judgement.third.empty()) {
      transaction.add({first, w(judgement.relation), second, graph});
    } else {
      transaction.add({fact, w("third"), terms.iri(judgement.third), graph});
    }
    transaction.add({fact, w("because"), terms.literal(explain(judgement)), graph});
    for (const MeasurementId each : read) {
      transaction.add({fact, w("derived-from"), terms.iri(world.name(each)), graph});
    }
  }
};

}  // namespace

StatedFacts state_facts(const Relations& relations, const Space& space, graph::Store& store,
                        FrameId viewer) {
  StatedFacts result;
  std::vector<BodyId> bodies;
  for (const BodyId body : space.bodies()) {
    (space.is_placed(body) ? bodies : result.unplaced).push_back(body);
  }
  FactWriter writer{store};
  writer.transaction.clear(writer.graph);
  for (const Rule& rule : relations.rules()) {
    if (rule.axes == Axes::kViewer && !viewer) {
      result.left_out.push_back(rule.name);
      continue;
    }
    const std::vector<BodyId> seconds = seconds_for(rule, relations, bodies);
    const std::size_t thirds = rule.ternary ? bodies.size() : 1;
    if (seconds.size() * thirds > 0 &&
        bodies.size() > kMaximumJudgements / seconds.size() / thirds) {
      refuse(rule.name,
             "would be judged for " + std::to_string(bodies.size()) + " bodies with each other",
             "at most " + std::to_string(kMaximumJudgements) +
                 " judgements; ask Relations::find for one body");
    }
    for (const BodyId first : bodies) {
      for (const BodyId second : seconds) {
        for (std::size_t i = 0; i < thirds; ++i) {
          const BodyId third = rule.ternary ? bodies[i] : BodyId{};
          // Of what is between two, either may be named first: it is said once.
          if (first == second || first == third || (rule.ternary && !(second < third))) continue;
          const Judgement judgement = relations.judge({.relation = rule.name,
                                                       .first = first,
                                                       .second = second,
                                                       .third = third,
                                                       .viewer = viewer});
          if (!judgement.holds) continue;
          const BodyId of[] = {first, second, third};
          const FrameId looks = rule.axes == Axes::kViewer ? viewer : FrameId{};
          writer.write(judgement, space.world(),
                       space.read_for(std::span(of, rule.ternary ? 3 : 2), looks));
          ++result.facts;
        }
      }
    }
  }
  writer.transaction.commit();
  return result;
}

}  // namespace sinew::world
