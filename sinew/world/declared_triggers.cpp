#include "sinew/world/declared_triggers.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sinew/rdf/sparql/engine.h"
#include "sinew/world/situation.h"

namespace sinew::world {
namespace {

// The two bodies of a threshold, placed by whoever looks; kept from look to look.
struct Measured {
  Space space;
  Relations relations;
  std::string first, second;

  Measured(Space made, const DeclaredScene& scene, const Threshold& threshold)
      : space(std::move(made)),
        relations(space, {{"threshold", Axes::kSpace, threshold.conditions}}),
        first(threshold.first),
        second(threshold.second) {
    DeclaredScene both;
    for (const DeclaredBody& body : scene.bodies) {
      if (body.iri == first || body.iri == second) both.bodies.push_back(body);
    }
    add_bodies(space, both);
  }
  Measured(const Measured&) = delete;

  bool holds(Stamp now) {
    space.update(now);
    return relations
        .judge({.relation = "threshold", .first = space.find(first), .second = space.find(second)})
        .holds;
  }
};

FrameId frame_of(const DeclaredScene& scene, const std::string& body) {
  for (const DeclaredBody& each : scene.bodies) {
    if (each.iri == body) return each.frame;
  }
  return {};
}

bool ask(const graph::View& view, graph::Terms& terms, const std::string& query) {
  return rdf::sparql::query(view, terms, query, {.name = {}, .base = {}}).results.boolean.value();
}

// What waits for the same on behalf of its owner, or of a component.
struct Binding {
  World& world;
  const DeclaredScene& scene;

  Occasion operator()(const OnChange& change) const { return change; }
  Occasion operator()(const OnStructure& structure) const { return structure; }
  Occasion operator()(const Cyclic& cyclic) const { return cyclic; }
  Occasion operator()(const AskedCondition& condition) const {
    return OnCondition{[&world = world, query = condition.query](const World&, Stamp) {
      const Situation situation = world.situation();
      return ask(situation.facts, world.graph().terms(), query);
    }};
  }
  Occasion operator()(const Threshold& threshold) const {
    auto measured = std::make_shared<Measured>(Space(world, frame_of(scene, threshold.second)),
                                               scene, threshold);
    return OnCondition{[measured](const World&, Stamp now) { return measured->holds(now); }};
  }
};

struct JudgedBinding {
  const Participant& who;
  const DeclaredScene& scene;
  using Judged = decltype(JudgedTrigger::when);

  Judged operator()(const OnChange& change) const { return change; }
  Judged operator()(const OnStructure& structure) const { return structure; }
  Judged operator()(const Cyclic& cyclic) const { return cyclic; }
  Judged operator()(const AskedCondition& condition) const {
    return JudgedCondition{[query = condition.query](const Reader& reader, Stamp) {
      JudgedFacts facts = reader.facts();
      return ask(facts.store.view(), facts.store.terms(), query);
    }};
  }
  Judged operator()(const Threshold& threshold) const {
    auto measured = std::make_shared<Measured>(Space(who.read(), frame_of(scene, threshold.second)),
                                               scene, threshold);
    return JudgedCondition{[measured](const Reader&, Stamp now) { return measured->holds(now); }};
  }
};

}  // namespace

std::string to_string(const DeclaredTrigger& trigger, const World& world) {
  struct Words {
    const World& world;
    std::string operator()(const OnChange& change) const {
      return "on change of " + world.name(change.measurement);
    }
    std::string operator()(const OnStructure&) const { return "on change of the structure"; }
    std::string operator()(const AskedCondition& condition) const {
      return "when " + condition.query;
    }
    std::string operator()(const Threshold& threshold) const {
      std::string text = "when of " + threshold.first + " and " + threshold.second;
      const char* between = " ";
      for (const Condition& condition : threshold.conditions) {
        text += between + condition.quantity;
        if (condition.minimum != -kUnbounded) text += fmt::format(" from {:g}", condition.minimum);
        if (condition.maximum != kUnbounded) text += fmt::format(" up to {:g}", condition.maximum);
        between = ", ";
      }
      return text;
    }
    std::string operator()(const Cyclic& cyclic) const {
      return fmt::format("every {:g} s", seconds_of(cyclic.period));
    }
  };
  return std::visit(Words{world}, trigger.when);
}

BoundTriggers bind_triggers(Triggers& triggers, World& world, Access& access,
                            const DeclaredScene& scene,
                            const std::vector<DeclaredTrigger>& declared,
                            const TriggerActions& actions,
                            const std::shared_ptr<EventQueue>& queue) {
  BoundTriggers result;
  std::set<std::string> named;
  for (const DeclaredTrigger& trigger : declared) {
    named.insert(trigger.action);
    const auto action = actions.find(trigger.action);
    if (action == actions.end()) {
      result.open.push_back(trigger);
      continue;
    }
    const auto callback = [trigger, act = action->second](const Event& event) {
      act(trigger, event);
    };
    TriggerId id;
    if (trigger.who.empty()) {
      id = triggers.add({.when = std::visit(Binding{world, scene}, trigger.when),
                         .priority = trigger.priority,
                         .callback = callback},
                        queue);
    } else {
      const Participant who = access.participant(trigger.who);
      id = who.read().listen(triggers,
                             {.when = std::visit(JudgedBinding{who, scene}, trigger.when),
                              .priority = trigger.priority,
                              .callback = callback},
                             queue);
    }
    result.bound.emplace_back(id, trigger);
  }
  for (const auto& [action, function] : actions) {
    if (!named.contains(action)) result.unused.push_back(action);
  }
  return result;
}

}  // namespace sinew::world
