#include "sinew/world/reader.h"

#include <set>
#include <utility>

#include "sinew/world/impl.h"
#include "sinew/world/refuse.h"

namespace sinew::world {

struct Reader::Judge {
  Rights rights;
  std::string who;
  std::shared_ptr<Audit> audit;

  void ask(MeasurementId measurement, const std::string& name,
           const MeasurementModel& model) const {
    const auto reason = rights.reason_against_reading(who, name, model.used_by, model.provenance);
    if (audit) {
      audit->record({.act = Act::kRead,
                     .accepted = !reason,
                     .who = who,
                     .what = name,
                     .measurement = measurement,
                     .reason = reason.value_or("")});
    }
    if (reason) {
      refuse(name, *reason,
             "name it in used_by, or a rule that allows " + who +
                 " to read-measurement; a query "
                 "may avoid the relation, or choose another provenance");
    }
  }

  void ask(const World& world, MeasurementId measurement) const {
    const auto model = world.model(measurement);
    ask(measurement, world.name(measurement), *model);
  }

  void ask(const WorldImpl& world, const Plan& plan) const {
    const State state = world.published();
    std::set<MeasurementId> asked;
    const auto once = [&](MeasurementId measurement) {
      const MeasurementRecord* const record = state.measurements.find(measurement.index);
      // One that was removed since cannot be read with the next plan.
      if (!record || !record->alive || !asked.insert(measurement).second) return;
      ask(measurement, world.family->names.text(record->name), *record->model);
    };
    for (const SymbolicStep& step : plan.symbolic) once(step.measurement_id);
    for (const Candidate& candidate : plan.candidates) once(candidate.measurement);
  }
};

Reader::Reader(const World& world, Rights rights, std::string who, std::shared_ptr<Audit> audit)
    : world_(world),
      judge_(std::make_shared<const Judge>(
          Judge{std::move(rights), std::move(who), std::move(audit)})) {
  // The prepared query keeps the world alive, and has this guard: no circle.
  guard_ = std::make_shared<const PlanGuard>(
      [judge = judge_, impl = std::weak_ptr<WorldImpl>(world.impl_)](const Plan& plan) {
        if (const auto alive = impl.lock()) judge->ask(*alive, plan);
      });
}

PreparedPose Reader::prepare_pose(const PoseQuery& query) const {
  return {world_.impl_, query, guard_};
}
PreparedMotion Reader::prepare_motion(const PoseQuery& query) const {
  return {world_.impl_, query, guard_};
}
PoseAnswer Reader::pose(FrameId of, FrameId with_respect_to, Stamp now) const {
  return prepare_pose({.of = of, .with_respect_to = with_respect_to}).latest(now);
}

World::Sample Reader::latest(MeasurementId measurement, Stamp now) const {
  judge_->ask(world_, measurement);
  return world_.latest(measurement, now);
}
World::Sample Reader::at(MeasurementId measurement, Stamp time) const {
  judge_->ask(world_, measurement);
  return world_.at(measurement, time);
}
History Reader::history(MeasurementId measurement) const {
  judge_->ask(world_, measurement);
  return world_.history(measurement);
}
Status Reader::read_blocks(MeasurementId measurement, std::span<const World::BlockBuffer> buffers,
                           Stamp* stamp) const {
  judge_->ask(world_, measurement);
  return world_.read_blocks(measurement, buffers, stamp);
}
std::shared_ptr<const MeasurementModel> Reader::model(MeasurementId measurement) const {
  judge_->ask(world_, measurement);
  return world_.model(measurement);
}

}  // namespace sinew::world
