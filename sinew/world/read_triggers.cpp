// Reading what declared_triggers.h describes.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "sinew/rdf/sparql/engine.h"
#include "sinew/world/declared_triggers.h"
#include "sinew/world/scene_conditions.h"
#include "sinew/world/scene_numbers.h"

namespace sinew::world {
namespace {

using graph::Id;

constexpr std::string_view kOccasions[] = {"on-change", "on-structure", "on-condition", "threshold",
                                           "every"};

struct TriggerReader {
  const World& world;
  const DeclaredScene& scene;
  graph::Store& store;
  model::GraphReader& reader;
  SceneNumbers numbers;

  Id w(std::string_view term) { return numbers.w(term); }

  std::optional<int> priority(Id node) {
    if (!numbers.has(node, "priority")) return 0;
    const auto literal = reader.one(node, w("priority"), "the priority");
    if (!literal) return std::nullopt;
    const auto number = reader.view.terms().integer_value(*literal);
    if (number && *number >= std::numeric_limits<int>::min() &&
        *number <= std::numeric_limits<int>::max()) {
      return static_cast<int>(*number);
    }
    reader.error(node, w("priority"), "a priority of " + numbers.text(*literal),
                 "an integer; the higher, the sooner");
    return std::nullopt;
  }

  std::optional<OnChange> change(Id node) {
    const auto named = reader.one(node, w("on-change"), "the measurement that changes");
    if (!named) return std::nullopt;
    if (const MeasurementId found = world.find_measurement(reader.text(*named))) {
      return OnChange{found};
    }
    reader.error(node, w("on-change"), numbers.text(*named) + " is no measurement of this world",
                 "a Measurement of the scene, or JOINT/position of a robot that was added before");
    return std::nullopt;
  }

  std::optional<OnStructure> structure(Id node) {
    const auto stated = reader.one(node, w("on-structure"), "whether the structure counts");
    if (!stated) return std::nullopt;
    if (reader.text(*stated) == "true" || reader.text(*stated) == "1") return OnStructure{};
    reader.error(node, w("on-structure"), "is '" + numbers.text(*stated) + "'",
                 "true, or another occasion");
    return std::nullopt;
  }

  std::optional<AskedCondition> asked(Id node) {
    const auto text = reader.one(node, w("on-condition"), "what the condition asks");
    if (!text) return std::nullopt;
    AskedCondition condition{numbers.text(*text)};
    try {
      graph::Store empty;
      const auto answer = rdf::sparql::query(empty.view(), empty.terms(), condition.query,
                                             {.name = numbers.text(node), .base = {}});
      if (answer.kind == rdf::sparql::AnswerKind::kBoolean) return condition;
      reader.error(node, w("on-condition"), "is a query that is not true or false", "an ASK");
    } catch (const Error& error) {
      const Problem& problem = error.problems().front();
      const std::string within =
          problem.place.line ? fmt::format(" (line {} of the text)", problem.place.line) : "";
      reader.error(node, w("on-condition"), problem.what + within, problem.remedy);
    }
    return std::nullopt;
  }

  // A body with a shape, that is no area.
  std::optional<std::string> body(Id node, std::string_view term) {
    const auto named = reader.one(node, w(term), "a body between which is measured");
    if (!named) return std::nullopt;
    std::string name = numbers.text(*named);
    const bool is_there =
        std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const DeclaredBody& each) {
          return each.iri == name && each.kind != DeclaredKind::kArea && !each.shapes.empty();
        });
    if (is_there) return name;
    reader.error(node, w(term), name + " is no body of the scene",
                 "an object or frame with a shape");
    return std::nullopt;
  }

  std::optional<Threshold> threshold(Id node) {
    const auto first = body(node, "first"), second = body(node, "second");
    const std::vector<Id> stated = reader.objects(node, w("threshold"));
    Threshold result{first.value_or(""), second.value_or(""), {}};
    if (stated.size() > kMaximumThresholds) {
      reader.error(node, w("threshold"), fmt::format("{} bounds", stated.size()),
                   fmt::format("at most {}", kMaximumThresholds));
      return std::nullopt;
    }
    for (const Id each : stated) {
      auto condition = read_condition(numbers, each);
      if (!condition) return std::nullopt;
      result.conditions.push_back(std::move(*condition));
    }
    if (!first || !second) return std::nullopt;
    try {
      check_rule({.name = numbers.text(node), .conditions = result.conditions});
    } catch (const Error& error) {
      for (const Problem& problem : error.problems()) {
        reader.error(node, w("threshold"), problem.what, problem.remedy);
      }
      return std::nullopt;
    }
    for (const Condition& condition : result.conditions) {
      if (condition.maximum_of.empty()) continue;
      reader.error(node, w("threshold"), "a maximum that is a declared number of a body",
                   "the number itself; rules have maximum-of");
      return std::nullopt;
    }
    return result;
  }

  std::optional<Cyclic> cyclic(Id node) {
    const auto period = numbers.duration(node, "every");
    if (!period) return std::nullopt;
    if (*period > Duration::zero()) return Cyclic{*period};
    reader.error(node, w("every"), fmt::format("a period of {} ns", period->count()),
                 "more than nothing");
    return std::nullopt;
  }

  std::optional<DeclaredTrigger> trigger(Id node) {
    if (reader.view.terms().is_blank(node)) {
      reader.error(node, {}, "a trigger without a name", "an IRI, by which it is shown and bound");
      return std::nullopt;
    }
    DeclaredTrigger result{.iri = numbers.text(node), .when = OnStructure{}, .action = {}};
    const auto action = reader.one(node, w("action"), "what is to be done");
    const auto urgency = priority(node);
    int occasions = 0;
    for (const std::string_view each : kOccasions) occasions += numbers.has(node, each);
    if (occasions != 1) {
      reader.error(node, {}, fmt::format("a trigger on {} occasions", occasions),
                   "one of on-change, on-structure, on-condition, threshold, every");
      return std::nullopt;
    }
    bool whole = true;
    const auto take = [&](auto&& when) {
      whole = when.has_value();
      if (whole) result.when = std::move(*when);
    };
    if (numbers.has(node, "on-change")) take(change(node));
    if (numbers.has(node, "on-structure")) take(structure(node));
    if (numbers.has(node, "on-condition")) take(asked(node));
    if (numbers.has(node, "threshold")) take(threshold(node));
    if (numbers.has(node, "every")) take(cyclic(node));
    if (numbers.has(node, "who")) {
      const auto who = reader.one(node, w("who"), "the component on whose behalf is looked");
      if (!who) return std::nullopt;
      result.who = numbers.text(*who);
    }
    if (!whole || !action || !urgency) return std::nullopt;
    result.action = numbers.text(*action);
    result.priority = *urgency;
    return result;
  }
};

}  // namespace

std::vector<DeclaredTrigger> read_triggers(const World& world, const DeclaredScene& scene,
                                           graph::Store& store, const graph::Places& places,
                                           Report& report) {
  model::GraphReader reader(store, places, report);
  TriggerReader triggers{world, scene, store, reader, {reader, store}};
  std::vector<DeclaredTrigger> result;
  for (const Id node : reader.all(triggers.w("Trigger"))) {
    auto read = triggers.trigger(node);
    if (!read) continue;
    if (result.size() == kMaximumTriggers) {
      reader.error(node, {}, fmt::format("more than {} triggers", kMaximumTriggers), "fewer");
      break;
    }
    result.push_back(std::move(*read));
  }
  return result;
}

}  // namespace sinew::world
