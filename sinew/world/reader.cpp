#include "sinew/world/reader.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "sinew/world/fact_history.h"
#include "sinew/world/impl.h"
#include "sinew/world/plan.h"
#include "sinew/world/situation.h"
#include "sinew/world/situation_rules.h"
#include "sinew/world/symbols.h"

namespace sinew::world {
namespace {

// All measurements that a plan may read.
std::vector<WantedReading> readings_of(const WorldImpl& world, const Plan& plan) {
  const State state = world.published();
  std::vector<WantedReading> wanted;
  for (const MeasurementId measurement : measurements_of(plan)) {
    const MeasurementRecord* const record = state.measurements.find(measurement.index);
    // One that was removed since cannot be read with the next plan.
    if (!record || !record->alive) continue;
    wanted.push_back({measurement, world.family->names.text(record->name), record->model});
  }
  return wanted;
}

}  // namespace

Reader::Reader(const World& world, Rights rights, std::string who, std::shared_ptr<Audit> audit)
    : Reader(world, std::make_shared<Authority>(std::move(rights), std::move(audit)),
             std::move(who)) {}

Reader::Reader(const World& world, std::shared_ptr<Authority> authority, std::string who)
    : world_(&world), who_(std::move(who)), authority_(std::move(authority)) {
  // The prepared query keeps the world alive, and has this guard: no circle.
  guard_ = std::make_shared<const PlanGuard>(
      [authority = authority_, who = who_, impl = std::weak_ptr<WorldImpl>(world.impl_)](
          const Plan& plan) -> std::shared_ptr<const Permit> {
        const auto alive = impl.lock();
        return alive ? authority->permit(who, readings_of(*alive, plan)) : nullptr;
      });
}

WantedReading Reader::wanted(MeasurementId measurement) const {
  return {measurement, world_->name(measurement), world_->model(measurement)};
}
void Reader::ask(MeasurementId measurement) const {
  authority_->ask_to_read(who_, wanted(measurement));
}
bool Reader::may_read(MeasurementId measurement) const {
  return !authority_->reason_against_reading(who_, wanted(measurement));
}

// ---- queries ----

PreparedPose Reader::prepare_pose(const PoseQuery& query) const {
  return {world_->impl_, query, guard_};
}
PreparedMotion Reader::prepare_motion(const PoseQuery& query) const {
  return {world_->impl_, query, guard_};
}
PoseAnswer Reader::pose(FrameId of, FrameId with_respect_to, Stamp now) const {
  return prepare_pose({.of = of, .with_respect_to = with_respect_to}).latest(now);
}

UncertaintyGuard Reader::uncertainty_guard() const {
  return [this](const Plan& plan, const std::vector<MeasurementId>& numbers) {
    for (const WantedReading& each : readings_of(*world_->impl_, plan)) {
      authority_->ask_to_read(who_, each);
    }
    for (const MeasurementId each : numbers) ask(each);
  };
}
DistributedPose Reader::pose_distribution(const PoseQuery& query, const Uncertainties& known,
                                          Stamp now, const CombineOptions& options) const {
  return world::pose_distribution(*world_, query, known, now, options, uncertainty_guard());
}
DistributedPose Reader::pose_distribution_at(const PoseQuery& query, const Uncertainties& known,
                                             Stamp time, const CombineOptions& options) const {
  return world::pose_distribution_at(*world_, query, known, time, options, uncertainty_guard());
}
UncertainPose Reader::uncertain_pose(const PoseQuery& query, const Uncertainties& known, Stamp now,
                                     Order order) const {
  return world::uncertain_pose(*world_, query, known, now, order, uncertainty_guard());
}
PoseProgram Reader::pose_program(const PoseQuery& query, graph::Store& store,
                                 std::string_view name) const {
  prepare_pose(query);  // the program has the constants of the same plan
  return make_pose_program(*world_, query, store, name);
}

// ---- single measurements ----

World::Sample Reader::latest(MeasurementId measurement, Stamp now) const {
  ask(measurement);
  return world_->latest(measurement, now);
}
World::Sample Reader::at(MeasurementId measurement, Stamp time) const {
  ask(measurement);
  return world_->at(measurement, time);
}
History Reader::history(MeasurementId measurement) const {
  ask(measurement);
  return world_->history(measurement);
}
Status Reader::read_blocks(MeasurementId measurement, std::span<const World::BlockBuffer> buffers,
                           Stamp* stamp) const {
  ask(measurement);
  return world_->read_blocks(measurement, buffers, stamp);
}
Status Reader::read_blocks_at(MeasurementId measurement, Stamp time,
                              std::span<const World::BlockBuffer> buffers) const {
  ask(measurement);
  return world_->read_blocks_at(measurement, time, buffers);
}
std::shared_ptr<const MeasurementModel> Reader::model(MeasurementId measurement) const {
  ask(measurement);
  return world_->model(measurement);
}

// ---- triggers ----

TriggerId Reader::listen(Triggers& triggers, JudgedTrigger trigger,
                         std::shared_ptr<EventQueue> listener) const {
  std::vector<WantedReading> reads;
  TriggerSpec spec{.when = OnStructure{}, .priority = trigger.priority};
  if (const auto* change = std::get_if<OnChange>(&trigger.when)) {
    reads.push_back(wanted(change->measurement));
    spec.when = *change;
  } else if (auto* condition = std::get_if<JudgedCondition>(&trigger.when)) {
    OnCondition judged;
    if (condition->holds) {
      judged.holds = [reader = *this, holds = std::move(condition->holds)](const World&,
                                                                           Stamp now) {
        try {
          return holds(reader, now);
        } catch (const Error&) {
          return false;  // the audit has it
        }
      };
    }
    spec.when = std::move(judged);
  } else if (const auto* cyclic = std::get_if<Cyclic>(&trigger.when)) {
    spec.when = *cyclic;
  }
  auto permit = authority_->permit(who_, std::move(reads));
  if (trigger.callback) {
    spec.callback = [permit = std::move(permit),
                     callback = std::move(trigger.callback)](const Event& event) {
      if (permit->holds.load(std::memory_order_acquire)) callback(event);
    };
  }
  return triggers.add(std::move(spec), std::move(listener));
}

// ---- the graph ----

struct Reader::Hidden {
  std::unordered_set<std::uint32_t> terms;  // with all that is said of them
  // Graph, first, property and second of what follows from measurements.
  std::set<std::tuple<graph::Id, graph::Id, graph::Id, graph::Id>> facts;
  std::vector<std::string> names;  // IRIs of the measurements

  bool has(const graph::Quad& quad) const {
    return terms.contains(quad.subject.value) || terms.contains(quad.object.value) ||
           facts.contains({quad.graph, quad.subject, quad.predicate, quad.object});
  }
};

Reader::Hidden Reader::hidden(const graph::View& facts) const {
  const graph::Terms& terms = facts.terms();
  Hidden result;
  const State state = world_->state();
  const Names& names = world_->impl_->family->names;
  std::unordered_set<std::string_view> readable;
  for (Index at = 0; at < state.measurements.size(); ++at) {
    const MeasurementRecord& record = state.measurements[at];
    if (!record.alive) continue;
    const std::string& name = names.text(record.name);
    if (!authority_->reason_against_reading(who_, {MeasurementId{at}, name, record.model})) {
      readable.insert(name);
      continue;
    }
    result.names.push_back(name);
    const auto hide = [&](std::string_view iri) {
      if (const graph::Id term = terms.find_iri(iri)) result.terms.insert(term.value);
    };
    hide(name);
    hide(name + "/data");
    for (std::size_t i = 0; record.blocks && i < record.blocks->blocks.size(); ++i) {
      hide(record.blocks->blocks[i].name);
    }
  }
  // Of a measurement that is none any more, nobody knows who might read it.
  const auto w = [&](std::string_view term) {
    return terms.find_iri(std::string(kWorldNamespace) + std::string(term));
  };
  const graph::Id derived_from = w("derived-from"), called = w("called");
  if (!derived_from) return result;
  const auto stated = [&](const graph::Quad& of, graph::Id property) {  // in the same graph
    graph::Id found;
    facts.match_in(of.subject, property, {}, of.graph, [&](const graph::Quad& quad) {
      found = quad.object;
      return true;
    });
    return found;
  };
  std::vector<graph::Quad> withheld;
  const auto withhold = [&](const graph::Quad& quad) {
    if (!readable.contains(terms.text(quad.object))) withheld.push_back(quad);
    return true;
  };
  facts.match_named({}, derived_from, {}, withhold);
  facts.match_in({}, derived_from, {}, {}, withhold);
  for (const graph::Quad& quad : withheld) {
    if (!result.terms.insert(quad.subject.value).second) continue;
    const graph::Id first = stated(quad, w("first")), second = stated(quad, w("second"));
    const graph::Id name = stated(quad, called);
    if (!first || !second || !name) continue;
    result.facts.insert({quad.graph, first, w(terms.text(name)), second});
  }
  return result;
}

JudgedFacts Reader::judged(const graph::View& facts) const {
  const graph::Terms& terms = facts.terms();
  const Hidden hidden = this->hidden(facts);
  JudgedFacts result;
  result.left_out = hidden.names;
  std::map<graph::Id, bool> readable;  // graphs
  const auto keep = [&](const graph::Quad& quad) {
    const auto [graph, fresh] = readable.try_emplace(quad.graph, true);
    if (fresh) {
      const std::string name(quad.graph ? terms.text(quad.graph) : kUnnamedGraph);
      graph->second = !authority_->reason_against_graph(who_, name) &&
                      (hidden.facts.empty() || name != kDerivedGraph);
      if (!graph->second) result.left_out.push_back(name);
    }
    return graph->second && !hidden.has(quad);
  };
  copy_facts(facts, result.store, keep);
  std::sort(result.left_out.begin(), result.left_out.end());
  return result;
}

// In a store that is his alone.
void Reader::hide_what_follows(graph::Store& store) const {
  const graph::View view = store.view();
  const Hidden hidden = this->hidden(view);
  if (hidden.facts.empty()) return;
  const graph::Id derived = store.terms().find_iri(kDerivedGraph);
  std::vector<graph::Quad> gone;
  view.match_named({}, {}, {}, [&](const graph::Quad& quad) {
    if (quad.graph == derived || hidden.has(quad)) gone.push_back(quad);
    return true;
  });
  graph::Transaction transaction = store.begin();
  for (const graph::Quad& quad : gone) transaction.remove(quad);
  transaction.commit();
}

JudgedFacts Reader::facts() const {
  World same(world_->impl_);
  const Situation situation = same.situation();
  return judged(situation.facts);
}

JudgedFacts Reader::facts_at(const FactHistory& history, Stamp time) const {
  World same(world_->impl_);
  const graph::Store past = history.at(same.graph(), time);
  return judged(past.view());
}

// ---- scenes ----

void Reader::write_scene(const DeclaredScene& scene, graph::Store& store, Report& report,
                         SceneWriting options) const {
  options.leave_out_values = [this](MeasurementId measurement) { return !may_read(measurement); };
  world::write_scene(*world_, scene, store, report, options);
}

}  // namespace sinew::world
