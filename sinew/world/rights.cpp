#include "sinew/world/rights.h"

#include <algorithm>

#include "sinew/world/authority.h"
#include "sinew/world/refuse.h"

namespace sinew::world {
namespace {

std::string forbidden_verb(Act act) {
  switch (act) {
    case Act::kMeasure:
      return " may not write it";
    case Act::kRelate:
      return " may not change this relation";
    case Act::kModel:
      return " may not change this model";
    case Act::kRead:
      return " may not read it";
    case Act::kPerform:
    case Act::kPredict:
      return " may not perform this action";
    case Act::kReadGraph:
      return " may not read this graph";
  }
  return " may not do this";
}

}  // namespace

void Rights::set(std::string_view who, Act act, std::string_view what, bool allowed) {
  if (who.empty() || what.empty()) {
    refuse(what, "a rule without a name", "who may do it, and to what");
  }
  if (rules_.size() == kMaximumRules) {
    refuse(what, "more than " + std::to_string(kMaximumRules) + " rules", "fewer, or kAnything");
  }
  bool& rule =
      rules_.try_emplace({std::string(who), act, std::string(what)}, allowed).first->second;
  rule = rule && allowed;
}

void Rights::allow(std::string_view who, Act act, std::string_view what) {
  set(who, act, what, true);
}
void Rights::forbid(std::string_view who, Act act, std::string_view what) {
  set(who, act, what, false);
}

std::optional<bool> Rights::rule(std::string_view who, Act act, std::string_view what) const {
  const auto found = rules_.find({std::string(who), act, std::string(what)});
  return found == rules_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::string> Rights::reason_against(std::string_view who, Act act,
                                                  std::string_view what,
                                                  std::string_view provenance) const {
  if (who.empty()) return "whoever writes does not say who it is";
  const std::optional<bool> special = rule(who, act, what);
  const std::optional<bool> general = rule(who, act, kAnything);
  const std::string name(who);
  if (special == false || general == false) {
    return name + forbidden_verb(act) + ": a rule forbids it" +
           (act == Act::kMeasure ? "; its provenance is " + std::string(provenance) : "");
  }
  if (special || general) return std::nullopt;
  if (act != Act::kMeasure) return name + forbidden_verb(act) + ": no rule allows it";
  if (who == provenance) return std::nullopt;
  if (provenance.empty()) return name + forbidden_verb(act) + ": it has no declared provenance";
  return name + forbidden_verb(act) + ": its provenance is " + std::string(provenance);
}

std::optional<std::string> Rights::reason_against_reading(std::string_view who,
                                                          std::string_view what,
                                                          std::span<const std::string> users,
                                                          std::string_view provenance) const {
  if (who.empty()) return "whoever reads does not say who it is";
  const std::optional<bool> special = rule(who, Act::kRead, what);
  const std::optional<bool> general = rule(who, Act::kRead, kAnything);
  const std::string refusal = std::string(who) + forbidden_verb(Act::kRead);
  if (special == false || general == false) return refusal + ": a rule forbids it";
  if (special || general || users.empty() || who == provenance) return std::nullopt;
  if (std::find(users.begin(), users.end(), who) != users.end()) return std::nullopt;
  std::string names;
  for (const std::string& user : users) names += (names.empty() ? "" : ", ") + user;
  return refusal + ": its users are " + names;
}

std::optional<std::string> Rights::reason_against_graph(std::string_view who,
                                                        std::string_view graph) const {
  if (who.empty()) return "whoever reads does not say who it is";
  const std::optional<bool> special = rule(who, Act::kReadGraph, graph);
  const std::optional<bool> general = rule(who, Act::kReadGraph, kAnything);
  const std::string refusal = std::string(who) + forbidden_verb(Act::kReadGraph);
  if (special == false || general == false) return refusal + ": a rule forbids it";
  if (special || general) return std::nullopt;
  for (const auto& [key, allowed] : rules_) {
    if (allowed && std::get<1>(key) == Act::kReadGraph && std::get<2>(key) == graph) {
      return refusal + ": it is for those whom a rule allows to, and no rule allows it to";
    }
  }
  return std::nullopt;
}

void Rights::require_single_writer(std::string_view what) {
  if (what.empty()) refuse(what, "a rule without a name", "the measurement, or kAnything");
  single_writers_.emplace(what);
}
bool Rights::single_writer(std::string_view what) const {
  return single_writers_.contains(what) || single_writers_.contains(kAnything);
}

void enforce(World& world, const Rights& rights, std::shared_ptr<Audit> audit) {
  // The guard runs while the world is locked: it knows all it needs and asks the world nothing.
  world.set_write_guard(
      [rights, audit = std::move(audit)](MeasurementId measurement, std::string_view what,
                                         const MeasurementModel& model,
                                         std::string_view who) -> std::optional<std::string> {
        auto reason = rights.reason_against(who, Act::kMeasure, what, model.provenance);
        if (audit) {
          audit->record({.act = Act::kMeasure,
                         .accepted = !reason,
                         .who = std::string(who),
                         .what = std::string(what),
                         .measurement = measurement,
                         .reason = reason.value_or("")});
        }
        return reason;
      });
}

Actor::Actor(World& world, Rights rights, std::string who, std::shared_ptr<Audit> audit)
    : Actor(world, std::make_shared<Authority>(std::move(rights), std::move(audit)),
            std::move(who)) {}
Actor::Actor(World& world, std::shared_ptr<Authority> authority, std::string who)
    : world_(&world), authority_(std::move(authority)), who_(std::move(who)) {}

void Actor::ask(Act act, std::string_view what) { authority_->ask(who_, act, what); }

RelationId Actor::add_relation(const RelationSpec& spec) {
  ask(Act::kRelate, spec.name);
  return world_->add_relation(spec);
}
void Actor::remove(RelationId relation) {
  ask(Act::kRelate, world_->name(relation));
  world_->remove(relation);
}
RelationId Actor::attach(FrameId frame, FrameId parent, Stamp now) {
  ask(Act::kRelate, world_->name(frame));
  return world_->attach(frame, parent, now, who_);
}
RelationId Actor::detach(FrameId frame, FrameId parent, Stamp now) {
  ask(Act::kRelate, world_->name(frame));
  return world_->detach(frame, parent, now, who_);
}
ObjectId Actor::add_object(std::string_view iri, FrameId frame, std::string_view model) {
  ask(Act::kModel, iri);
  return world_->add_object(iri, frame, model);
}
void Actor::remove(ObjectId object) {
  ask(Act::kModel, world_->name(object));
  world_->remove(object);
}

void check_configuration(const World& world, const Rights& rights,
                         std::span<const DeclaredWriter> writers, Report& report) {
  const State state = world.state();
  std::map<Index, const DeclaredWriter*> first_of;
  for (const DeclaredWriter& writer : writers) {
    const MeasurementId measurement = world.find_measurement(writer.what);
    if (!measurement) {
      report.error(writer.place, writer.what,
                   writer.who + " is to write it, and it is no measurement of this world",
                   "the IRI of a measurement");
      continue;
    }
    const MeasurementModel& model = *state.measurements[measurement.index].model;
    if (std::holds_alternative<Static>(model.life_cycle)) {
      report.error(writer.place, writer.what,
                   "it is static, and " + writer.who + " is to write it while the system runs",
                   "a life-cycle that changes, or no writer");
    }
    if (const auto reason =
            rights.reason_against(writer.who, Act::kMeasure, writer.what, model.provenance)) {
      report.error(writer.place, writer.what, writer.who + " is to write it, but " + *reason,
                   "its provenance as the writer, or a rule that allows it");
    }
    const auto [there, added] = first_of.emplace(measurement.index, &writer);
    if (!added && there->second->who != writer.who && rights.single_writer(writer.what)) {
      report.error(writer.place, writer.what,
                   "two write it: " + there->second->who + " and " + writer.who +
                       ", and a rule says that it has a single writer",
                   "one writer, or a measurement for each");
    } else if (!added && there->second->who != writer.who) {
      report.warning(writer.place, writer.what,
                     "two write it: " + there->second->who + " and " + writer.who,
                     "one writer, or a measurement for each: a query may choose by provenance");
    }
  }
  for (Index at = 0; at < state.measurements.size(); ++at) {
    const MeasurementRecord& record = state.measurements[at];
    if (!record.alive || std::holds_alternative<Static>(record.model->life_cycle)) continue;
    if (!first_of.contains(at)) {
      report.warning({}, world.name(MeasurementId{at}), "nobody declares to write it",
                     "a component that writes it: " + record.model->provenance);
    }
  }
}

}  // namespace sinew::world
