// Reading a plan as a pose.
#include "sinew/world/plan_reading.h"

namespace sinew::world {
namespace {

template <When kWhen>
void compose_poses(const Plan& plan, Stamp time, PlanReading& reading, PoseAnswer& answer,
                   Gathered& gathered) {
  gathered = {};
  Pose X;
  double values[kMaximumValues];
  for (const PlanStep& step : plan.steps) {
    if (step.has_before) X = compose(X, step.before);
    answer.status = read_step<kWhen>(plan, step, time, reading, values, gathered, answer.bounds);
    if (answer.status != Status::kOk) [[unlikely]]
      return;
    if (step.kind == RelationKind::kFree) {
      X = step.inverse ? compose_inverse(X, load_pose(values)) : compose(X, load_pose(values));
    } else {
      X = compose(X, step_pose(step, values));
    }
  }
  answer.pose = plan.has_tail ? compose(X, plan.tail) : X;
  answer.status = Status::kOk;
}

template <When kWhen>
void read_pose(const Plan& plan, Stamp time, Policy policy, PoseAnswer& answer) {
  answer.status = plan.status;
  if (plan.status != Status::kOk) return;
  PlanReading reading;
  Gathered gathered;
  if (!at_one_instant(plan, reading,
                      [&] { compose_poses<kWhen>(plan, time, reading, answer, gathered); })) {
    answer.status = Status::kBusy;
    return;
  }
  finish(gathered, time, policy, answer);
}

}  // namespace

void read_latest(const Plan& plan, Stamp now, Policy policy, PoseAnswer& answer) {
  read_pose<When::kLatest>(plan, now, policy, answer);
}

void read_at(const Plan& plan, Stamp time, Policy policy, PoseAnswer& answer) {
  read_pose<When::kAt>(plan, time, policy, answer);
}

void read_latest_common(const Plan& plan, Policy policy, PoseAnswer& answer) {
  answer.status = plan.status;
  if (plan.status != Status::kOk) return;
  PlanReading reading;
  Gathered gathered;
  Stamp common;
  if (!at_one_instant(plan, reading, [&] {
        // Of each step its latest candidate; of all steps the earliest.
        common = Stamp::max();
        for (const PlanStep& step : plan.steps) {
          const std::uint32_t candidate = freshest(plan, step, reading);
          const Cell::View& view = reading.views[candidate];
          if (view.count == 0 || plan.candidates[candidate].is_static) continue;
          common = std::min(common, plan.candidates[candidate].cell->stamp(view, view.count - 1));
        }
        if (common == Stamp::max()) common = Stamp();  // nothing on the way has a time
        compose_poses<When::kAt>(plan, common, reading, answer, gathered);
      })) {
    answer.status = Status::kBusy;
    return;
  }
  finish(gathered, common, policy, answer);
}

}  // namespace sinew::world
