#include "sinew/world/prepared.h"

#include "sinew/world/impl.h"

namespace sinew::world {
namespace {

std::shared_ptr<const Plan> checked(std::shared_ptr<const Plan> plan,
                                    const std::shared_ptr<const PlanGuard>& guard) {
  if (guard) (*guard)(*plan);
  return plan;
}

// Whether the past is to be asked: at first where a ring does not go back so far, then again where
// entries came while it was asked.
bool asks_histories(Status status, int attempt) {
  return attempt == 0 ? status == Status::kTooOld : status == Status::kBusy;
}

}  // namespace

PreparedPose::PreparedPose(std::shared_ptr<WorldImpl> world, PoseQuery query,
                           std::shared_ptr<const PlanGuard> guard)
    : world_(std::move(world)), query_(std::move(query)), guard_(std::move(guard)) {
  refresh();
}

bool PreparedPose::is_current() const {
  return plan_->structure_version == world_->structure.load(std::memory_order_acquire);
}
void PreparedPose::refresh() { plan_ = checked(world_->plan(query_, false), guard_); }
Status PreparedPose::status() const { return plan_->status; }
std::size_t PreparedPose::measured_steps() const { return plan_->steps.size(); }
std::vector<SymbolicStep> PreparedPose::symbolic() const { return plan_->symbolic; }

PoseAnswer PreparedPose::latest_realtime(Stamp now) const {
  PoseAnswer answer;
  read_latest(*plan_, now, query_.policy, answer);
  answer.structure_changed = !is_current();
  return answer;
}
PoseAnswer PreparedPose::at_realtime(Stamp time) const {
  PoseAnswer answer;
  read_at(*plan_, time, query_.policy, answer);
  answer.structure_changed = !is_current();
  return answer;
}
PoseAnswer PreparedPose::latest_common_realtime() const {
  PoseAnswer answer;
  read_latest_common(*plan_, query_.policy, answer);
  answer.structure_changed = !is_current();
  return answer;
}
PoseAnswer PreparedPose::latest(Stamp now) {
  if (!is_current()) refresh();
  return latest_realtime(now);
}
PoseAnswer PreparedPose::at(Stamp time) {
  if (!is_current()) refresh();
  PoseAnswer answer = at_realtime(time);
  for (int attempt = 0; attempt < kReadAttempts && asks_histories(answer.status, attempt);
       ++attempt) {
    const State past = world_->published();
    read_at_past(*plan_, past, time, query_.policy, answer);
    answer.structure_changed = !is_current();
  }
  return answer;
}
PoseAnswer PreparedPose::latest_common() {
  if (!is_current()) refresh();
  return latest_common_realtime();
}

PreparedMotion::PreparedMotion(std::shared_ptr<WorldImpl> world, PoseQuery query,
                               std::shared_ptr<const PlanGuard> guard)
    : world_(std::move(world)), query_(std::move(query)), guard_(std::move(guard)) {
  refresh();
}

bool PreparedMotion::is_current() const {
  return plan_->structure_version == world_->structure.load(std::memory_order_acquire);
}
void PreparedMotion::refresh() { plan_ = checked(world_->plan(query_, true), guard_); }
Status PreparedMotion::status() const { return plan_->status; }
bool PreparedMotion::has_twist() const {
  return std::all_of(plan_->steps.begin(), plan_->steps.end(),
                     [](const PlanStep& step) { return step.velocity != kNone; });
}
bool PreparedMotion::has_acceleration() const {
  return has_twist() &&
         std::all_of(plan_->steps.begin(), plan_->steps.end(),
                     [](const PlanStep& step) { return step.acceleration != kNone; });
}

MotionAnswer PreparedMotion::latest_realtime(Stamp now) const {
  MotionAnswer answer;
  read_motion(*plan_, now, true, query_.policy, answer);
  answer.structure_changed = !is_current();
  return answer;
}
MotionAnswer PreparedMotion::at_realtime(Stamp time) const {
  MotionAnswer answer;
  read_motion(*plan_, time, false, query_.policy, answer);
  answer.structure_changed = !is_current();
  return answer;
}
MotionAnswer PreparedMotion::latest(Stamp now) {
  if (!is_current()) refresh();
  return latest_realtime(now);
}
MotionAnswer PreparedMotion::at(Stamp time) {
  if (!is_current()) refresh();
  MotionAnswer answer = at_realtime(time);
  for (int attempt = 0; attempt < kReadAttempts && asks_histories(answer.status, attempt);
       ++attempt) {
    const State past = world_->published();
    read_motion_past(*plan_, past, time, query_.policy, answer);
    answer.structure_changed = !is_current();
  }
  return answer;
}

}  // namespace sinew::world
