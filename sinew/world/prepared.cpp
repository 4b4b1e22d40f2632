#include "sinew/world/prepared.h"

#include "sinew/world/impl.h"

namespace sinew::world {
namespace {

bool is_forbidden(const std::shared_ptr<const Permit>& permit) {
  return permit && !permit->holds.load(std::memory_order_acquire);
}

// A new plan, when whoever asks may use it; and a place to read histories, when it needs one.
void plan_anew(const std::shared_ptr<WorldImpl>& world, const PoseQuery& query, bool motion,
               const std::shared_ptr<const PlanGuard>& guard, std::shared_ptr<const Plan>& plan,
               std::shared_ptr<const Permit>& permit, OwnReaderPlace& place) {
  std::shared_ptr<const Plan> next = world->plan(query, motion);
  if (guard) permit = (*guard)(*next);
  if (next->keeps_past && !place.get()) place = OwnReaderPlace(world->family->readers);
  plan = std::move(next);
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
void PreparedPose::refresh() { plan_anew(world_, query_, false, guard_, plan_, permit_, place_); }
Status PreparedPose::status() const { return plan_->status; }
std::size_t PreparedPose::measured_steps() const { return plan_->steps.size(); }
std::vector<SymbolicStep> PreparedPose::symbolic() const { return plan_->symbolic; }

PoseAnswer PreparedPose::latest_realtime(Stamp now) const {
  PoseAnswer answer;
  if (is_forbidden(permit_)) [[unlikely]] {
    answer.status = Status::kForbidden;
    return answer;
  }
  read_latest(*plan_, now, query_.policy, answer);
  answer.structure_changed = !is_current();
  return answer;
}
PoseAnswer PreparedPose::at_realtime(Stamp time) const {
  PoseAnswer answer;
  if (is_forbidden(permit_)) [[unlikely]] {
    answer.status = Status::kForbidden;
    return answer;
  }
  read_at(*plan_, time, query_.policy, place_.get(), answer);
  answer.structure_changed = !is_current();
  return answer;
}
PoseAnswer PreparedPose::latest_common_realtime() const {
  PoseAnswer answer;
  if (is_forbidden(permit_)) [[unlikely]] {
    answer.status = Status::kForbidden;
    return answer;
  }
  read_latest_common(*plan_, query_.policy, place_.get(), answer);
  answer.structure_changed = !is_current();
  return answer;
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
    : world_(std::move(world)), query_(std::move(query)), guard_(std::move(guard)) {
  refresh();
}

bool PreparedMotion::is_current() const {
  return plan_->structure_version == world_->structure.load(std::memory_order_acquire);
}
void PreparedMotion::refresh() { plan_anew(world_, query_, true, guard_, plan_, permit_, place_); }
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
  if (is_forbidden(permit_)) [[unlikely]] {
    answer.status = Status::kForbidden;
    return answer;
  }
  read_motion(*plan_, now, true, query_.policy, place_.get(), answer);
  answer.structure_changed = !is_current();
  return answer;
}
MotionAnswer PreparedMotion::at_realtime(Stamp time) const {
  MotionAnswer answer;
  if (is_forbidden(permit_)) [[unlikely]] {
    answer.status = Status::kForbidden;
    return answer;
  }
  read_motion(*plan_, time, false, query_.policy, place_.get(), answer);
  answer.structure_changed = !is_current();
  return answer;
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
