#include "sinew/world/prepared.h"

#include "sinew/world/impl.h"

namespace sinew::world {
namespace {

// What `read` writes into an answer, unless whoever asks may no longer.
template <typename Answer, typename Read>
Answer answer_of(const PreparedPlan& prepared, Read read) {
  Answer answer;
  if (prepared.permit && !prepared.permit->holds.load(std::memory_order_acquire)) [[unlikely]] {
    answer.status = Status::kForbidden;
    return answer;
  }
  read(*prepared.plan, answer);
  answer.structure_changed = !prepared.is_current();
  return answer;
}

PreparedPlan prepared_plan(std::shared_ptr<WorldImpl> world, PoseQuery query, bool with_motion,
                           std::shared_ptr<const PlanGuard> guard) {
  PreparedPlan prepared{std::move(world), std::move(query), with_motion, std::move(guard)};
  prepared.refresh();
  return prepared;
}

}  // namespace

bool PreparedPlan::is_current() const {
  return plan->structure_version == world->structure.load(std::memory_order_acquire);
}

// A new plan, when whoever asks may use it; and a place to read histories, when it needs one.
void PreparedPlan::refresh() {
  std::shared_ptr<const Plan> next = world->plan(query, with_motion);
  if (guard) permit = (*guard)(*next);
  if (next->keeps_past && !place.get()) place = OwnReaderPlace(world->family->readers);
  plan = std::move(next);
}

PreparedPose::PreparedPose(std::shared_ptr<WorldImpl> world, PoseQuery query,
                           std::shared_ptr<const PlanGuard> guard)
    : prepared_(prepared_plan(std::move(world), std::move(query), false, std::move(guard))) {}

Status PreparedPose::status() const { return plan().status; }
std::size_t PreparedPose::measured_steps() const { return plan().steps.size(); }
std::vector<SymbolicStep> PreparedPose::symbolic() const { return plan().symbolic; }

PoseAnswer PreparedPose::latest_realtime(Stamp now) const {
  return answer_of<PoseAnswer>(prepared_, [&](const Plan& plan, PoseAnswer& answer) {
    read_latest(plan, now, prepared_.query.policy, answer);
  });
}
PoseAnswer PreparedPose::at_realtime(Stamp time) const {
  return answer_of<PoseAnswer>(prepared_, [&](const Plan& plan, PoseAnswer& answer) {
    read_at(plan, time, prepared_.query.policy, prepared_.place.get(), answer);
  });
}
PoseAnswer PreparedPose::latest_common_realtime() const {
  return answer_of<PoseAnswer>(prepared_, [&](const Plan& plan, PoseAnswer& answer) {
    read_latest_common(plan, prepared_.query.policy, prepared_.place.get(), answer);
  });
}
PoseAnswer PreparedPose::latest(Stamp now) {
  if (!is_current()) refresh();
  return latest_realtime(now);
}
PoseAnswer PreparedPose::at(Stamp time) {
  if (!is_current()) refresh();
  return at_realtime(time);
}
PoseAnswer PreparedPose::latest_common() {
  if (!is_current()) refresh();
  return latest_common_realtime();
}

PreparedMotion::PreparedMotion(std::shared_ptr<WorldImpl> world, PoseQuery query,
                               std::shared_ptr<const PlanGuard> guard)
    : prepared_(prepared_plan(std::move(world), std::move(query), true, std::move(guard))) {}

Status PreparedMotion::status() const { return prepared_.plan->status; }
bool PreparedMotion::has_twist() const {
  const std::vector<PlanStep>& steps = prepared_.plan->steps;
  return std::all_of(steps.begin(), steps.end(),
                     [](const PlanStep& step) { return step.velocity != kNone; });
}
bool PreparedMotion::has_acceleration() const {
  const std::vector<PlanStep>& steps = prepared_.plan->steps;
  return has_twist() && std::all_of(steps.begin(), steps.end(), [](const PlanStep& step) {
           return step.acceleration != kNone;
         });
}

MotionAnswer PreparedMotion::latest_realtime(Stamp now) const {
  return answer_of<MotionAnswer>(prepared_, [&](const Plan& plan, MotionAnswer& answer) {
    read_motion(plan, now, true, prepared_.query.policy, prepared_.place.get(), answer);
  });
}
MotionAnswer PreparedMotion::at_realtime(Stamp time) const {
  return answer_of<MotionAnswer>(prepared_, [&](const Plan& plan, MotionAnswer& answer) {
    read_motion(plan, time, false, prepared_.query.policy, prepared_.place.get(), answer);
  });
}
MotionAnswer PreparedMotion::latest(Stamp now) {
  if (!is_current()) refresh();
  return latest_realtime(now);
}
MotionAnswer PreparedMotion::at(Stamp time) {
  if (!is_current()) refresh();
  return at_realtime(time);
}

}  // namespace sinew::world
