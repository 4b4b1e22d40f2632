// Reading all cells of a plan at one instant; for the functions that compose what they hold. Each
// attempt collects the cells' heads, composes, and looks whether a head has changed; from the
// second attempt on it first makes sure that the heads were the same twice, which fixes the
// instant, and afterwards only that nothing was overwritten meanwhile, so that writers in a hurry
// do not starve a reader.
#pragma once

#include "sinew/world/plan.h"
#include "sinew/world/reading.h"

namespace sinew::world {

enum class When : std::uint8_t { kLatest, kAt };

// What was read of one candidate, to be checked afterwards.
struct Used {
  std::uint32_t candidate;
  std::uint64_t first;
};

struct PlanReading {
  Cell::View views[kMaximumPlanCells];
  Used used[kMaximumPlanCells];
  std::size_t uses;
  ReaderPlace* reader = nullptr;  // of histories; null: rings alone
};

// The history that answers for what the candidate's ring no longer covers, while it is looked at.
class HeldHistory {
 public:
  HeldHistory(const Candidate& from, ReaderPlace* reader)
      : reader_(from.published ? reader : nullptr),
        history_(reader_ ? from.published->hold(*reader_) : from.inherited) {}
  ~HeldHistory() {
    if (reader_) PublishedHistory::let_go(*reader_);
  }
  HeldHistory(const HeldHistory&) = delete;
  HeldHistory& operator=(const HeldHistory&) = delete;
  const History* get() const { return history_; }
  bool is_busy() const { return reader_ && !history_; }

 private:
  ReaderPlace* reader_;
  const History* history_;
};

inline bool collect(const Plan& plan, PlanReading& reading) {
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    reading.views[i] = plan.candidates[i].cell->view(plan.candidates[i].as_of);
    if (!reading.views[i].settled) return false;
  }
  return true;
}

inline bool unchanged(const Plan& plan, const PlanReading& reading) {
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    if (!plan.candidates[i].cell->unchanged(reading.views[i], plan.candidates[i].as_of))
      return false;
  }
  return true;
}

inline bool intact(const Plan& plan, const PlanReading& reading) {
  for (std::size_t i = 0; i < reading.uses; ++i) {
    const Used& used = reading.used[i];
    const Candidate& from = plan.candidates[used.candidate];
    if (!from.cell->intact(reading.views[used.candidate], used.first, from.as_of)) return false;
  }
  return true;
}

// Runs `compute` on views of one instant until what it read proved whole. False: kBusy.
template <typename Compute>
bool at_one_instant(const Plan& plan, PlanReading& reading, Compute&& compute) {
  for (int attempt = 0; attempt < kReadAttempts; ++attempt) {
    if (!collect(plan, reading)) continue;
    if (attempt > 0 && !unchanged(plan, reading)) continue;
    reading.uses = 0;
    compute();
    if (attempt == 0 ? unchanged(plan, reading) : intact(plan, reading)) return true;
  }
  return false;
}

// The candidate with the latest entry.
inline std::uint32_t freshest(const Plan& plan, const PlanStep& step, const PlanReading& reading) {
  std::uint32_t best = step.first;
  Stamp best_stamp = Stamp::min();
  for (std::uint32_t i = step.first; i < step.first + step.count; ++i) {
    const Cell::View& view = reading.views[i];
    if (view.count == 0) continue;
    const Stamp stamp = plan.candidates[i].cell->stamp(view, view.count - 1);
    if (stamp > best_stamp) best = i, best_stamp = stamp;
  }
  return best;
}

template <When kWhen>
Status read_one(const Plan& plan, std::uint32_t candidate, Stamp time, PlanReading& reading,
                double* values, Gathered& gathered) {
  const Candidate& from = plan.candidates[candidate];
  const Cell::View& view = reading.views[candidate];
  const CellReading read = kWhen == When::kLatest
                               ? read_last(from, view, time, values, gathered)
                               : read_between(from, view, time, values, gathered);
  reading.used[reading.uses++] = {candidate, read.first};
  if (kWhen == When::kAt && read.status == Status::kTooOld) [[unlikely]] {
    const HeldHistory history(from, reading.reader);
    if (history.is_busy()) return Status::kBusy;
    if (history.get()) {
      // Nothing of the ring was used: it may go on as it likes, but for corrections.
      reading.used[reading.uses - 1].first = view.count - 1;
      return read_past(from, *history.get(), time, values, gathered);
    }
  }
  return read.status;
}

// The numbers of one step by the first candidate that has an answer, the preferred one first.
template <When kWhen>
Status read_step(const Plan& plan, const PlanStep& step, Stamp time, PlanReading& reading,
                 double* values, Gathered& gathered, Bounds& bounds) {
  std::uint32_t candidate = step.first;
  if (step.freshest && step.count > 1) candidate = freshest(plan, step, reading);
  Status status = read_one<kWhen>(plan, candidate, time, reading, values, gathered);
  if (status == Status::kOk) [[likely]]
    return status;
  {
    const HeldHistory history(plan.candidates[candidate], reading.reader);
    bounds = bounds_of(plan.candidates[candidate], reading.views[candidate], history.get());
  }
  for (std::uint32_t i = step.first; i < step.first + step.count; ++i) {
    if (i == candidate) continue;
    if (read_one<kWhen>(plan, i, time, reading, values, gathered) == Status::kOk)
      return Status::kOk;
  }
  return status;
}

// One step, seen from where the way comes from.
inline Pose step_pose(const PlanStep& step, const double* values) {
  if (step.kind == RelationKind::kFree) {
    const Pose X = load_pose(values);
    return step.inverse ? invert(X) : X;
  }
  const double q = step.inverse ? -values[0] : values[0];
  return step.kind == RelationKind::kRevolute ? revolute(q) : prismatic(q);
}

template <typename Answer>
void finish(const Gathered& gathered, Stamp now, Policy policy, Answer& answer) {
  answer.freshness = gathered.at(now);
  if (answer.status == Status::kOk && gathered.expired > 0 && policy != Policy::kInform) {
    answer.status = Status::kExpired;
  }
}

}  // namespace sinew::world
