// Reading a plan as a pose.
#include "sinew/world/plan_reading.h"
#include "sinew/world/slerp.h"

namespace sinew::world {
namespace {

// The pose of a simple step; false when it needs the general way, for its status.
template <When kWhen>
[[gnu::always_inline]] inline bool read_simple(const Plan& plan, const PlanStep& step, Stamp time,
                                               PlanReading& reading, Pose& X, Gathered& gathered) {
  const Candidate& from = plan.candidates[step.first];
  const Cell::View& view = reading.views[step.first];
  if (view.count == 0) return false;
  std::uint64_t entry = view.count - 1;
  const auto* words = from.cell->words(view, entry);
  Stamp stamp = load_stamp(words);
  if constexpr (kWhen == When::kLatest) {
    X = load_entry(words);
  } else {
    if (time > stamp) return false;
    if (time == stamp) {
      X = load_entry(words);
    } else {
      const std::uint64_t oldest = from.cell->oldest(view);
      if (entry == oldest) return false;
      // Most are asked for a time near the present.
      const auto* after = words;
      words = from.cell->words(view, --entry);
      Stamp next = stamp;
      stamp = load_stamp(words);
      if (time < stamp) {
        if (time < from.cell->stamp(view, oldest)) return false;
        entry = from.cell->find(view, time);
        words = from.cell->words(view, entry);
        after = from.cell->words(view, entry + 1);
        stamp = load_stamp(words);
        next = load_stamp(after);
      }
      X = load_entry(words);
      if (time != stamp) {
        const double share = static_cast<double>((time - stamp).count()) /
                             static_cast<double>((next - stamp).count());
        X = slerp_in_line(X, load_entry(after), share);
      }
    }
  }
  reading.used[reading.uses++] = {step.first, entry};
  gathered.add(from, stamp, time);
  return true;
}

template <When kWhen>
void compose_poses(const Plan& plan, Stamp time, PlanReading& reading, PoseAnswer& answer,
                   Gathered& gathered) {
  gathered = {};
  Pose X;
  double values[kMaximumValues];
  for (const PlanStep& step : plan.steps) {
    if (step.has_before) X = compose(X, step.before);
    Pose own;
    if (step.is_simple && read_simple<kWhen>(plan, step, time, reading, own, gathered)) [[likely]] {
      X = step.inverse ? compose_inverse(X, own) : compose(X, own);
      continue;
    }
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
void read_pose(const Plan& plan, Stamp time, Policy policy, PoseAnswer& answer,
               ReaderPlace* reader = nullptr) {
  answer.status = plan.status;
  if (plan.status != Status::kOk) return;
  PlanReading reading;
  reading.reader = reader;
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

void read_at(const Plan& plan, Stamp time, Policy policy, ReaderPlace* reader, PoseAnswer& answer) {
  read_pose<When::kAt>(plan, time, policy, answer, reader);
}

void read_latest_common(const Plan& plan, Policy policy, ReaderPlace* reader, PoseAnswer& answer) {
  answer.status = plan.status;
  if (plan.status != Status::kOk) return;
  PlanReading reading;
  reading.reader = reader;
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
