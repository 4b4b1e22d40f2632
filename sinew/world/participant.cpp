#include "sinew/world/participant.h"

#include <utility>

namespace sinew::world {

Participant::Participant(World& world, std::shared_ptr<World> own,
                         std::shared_ptr<Authority> authority, std::string who)
    : world_(&world),
      own_(std::move(own)),
      authority_(std::move(authority)),
      reader_(world, authority_, who),
      actor_(world, authority_, std::move(who)) {}

Status Participant::write(MeasurementId measurement, Stamp stamp, const Pose& pose) {
  return world_->write(measurement, stamp, pose, {who()});
}
Status Participant::write(MeasurementId measurement, Stamp stamp, std::span<const double> values) {
  return world_->write(measurement, stamp, values, {who()});
}
Status Participant::write_together(Stamp stamp, std::span<const World::Value> values) {
  return world_->write_together(stamp, values, {who()});
}
Status Participant::write_block(MeasurementId measurement, std::size_t block, Stamp stamp,
                                const void* value, std::size_t size) {
  return world_->write_block(measurement, block, stamp, value, size, {who()});
}
Writer Participant::claim(MeasurementId measurement) { return world_->claim(measurement, {who()}); }
BatchWriter Participant::claim(std::span<const MeasurementId> measurements) {
  return world_->claim(measurements, {who()});
}
void Participant::done(MeasurementId measurement, const History& history, std::size_t count) {
  world_->done(measurement, who(), history, count);
}

ActionOutcome Participant::perform(const Actions& actions, const std::string& action,
                                   std::map<std::string, std::string> arguments, Stamp now,
                                   FactHistory* history) {
  const Rights rights = authority_->rights();
  return actions.perform(*world_, {action, std::move(arguments), who(), now},
                         {.rights = &rights, .audit = authority_->audit(), .history = history});
}

Participant::Prediction Participant::predict(const Actions& actions, const std::string& action,
                                             std::map<std::string, std::string> arguments,
                                             Stamp now) const {
  World readable = world_->clone();
  reader_.hide_what_follows(readable.graph());
  PredictedAction predicted =
      actions.predict(readable, {action, std::move(arguments), who(), now},
                      {.rights = nullptr, .audit = authority_->audit(), .history = nullptr});
  std::map<std::string, bool> hidden;  // graphs, as N-Triples
  const auto is_hidden = [&](const FactText& fact) {
    const auto [found, fresh] = hidden.try_emplace(fact.graph, false);
    if (fresh) {
      const std::string name = fact.graph.empty() ? std::string(kUnnamedGraph)
                                                  : fact.graph.substr(1, fact.graph.size() - 2);
      found->second = authority_->reason_against_graph(who(), name).has_value();
    }
    return found->second;
  };
  std::erase_if(predicted.outcome.begun, is_hidden);
  std::erase_if(predicted.outcome.ended, is_hidden);
  auto own = std::make_shared<World>(std::move(predicted.world));
  return {Participant(*own, own, authority_, who()), std::move(predicted.outcome)};
}

Participant Participant::clone() const {
  auto own = std::make_shared<World>(world_->clone());
  return {*own, own, authority_, who()};
}

Access::Access(World& world, Rights rights, std::shared_ptr<Audit> audit)
    : world_(world), authority_(std::make_shared<Authority>(std::move(rights), std::move(audit))) {
  enforce(world_, authority_->rights(), authority_->audit());
}

Participant Access::participant(std::string who) {
  return {world_, nullptr, authority_, std::move(who)};
}

void Access::change(const Rights& rights) {
  authority_->change(rights);
  enforce(world_, rights, authority_->audit());
}

}  // namespace sinew::world
