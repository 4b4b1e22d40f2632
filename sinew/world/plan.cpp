#include "sinew/world/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "sinew/world/reading.h"
#include "sinew/world/refuse.h"

namespace sinew::world {
namespace {

// A relation that is measured while the world runs, against one that is constant.
constexpr double kMeasuredCost = 1.0;
constexpr double kConstantCost = 1e-6;

Quantity position_of(RelationKind kind) {
  return kind == RelationKind::kFree ? Quantity::kPose : Quantity::kJointPosition;
}

struct Planner {
  const State& state;
  const Names& names;
  const AsOf& as_of;
  const PoseQuery& query;
  bool motion;
  std::shared_ptr<Plan> plan = std::make_shared<Plan>();
  Pose before = {};  // constants since the last step
  bool has_before = false;

  // The measurements of a relation with this quantity, in the order of preference.
  std::vector<Index> measurements(const RelationRecord& relation, Quantity quantity) const {
    std::vector<Index> found;
    for (Index at = relation.first_measurement; at != kNone; at = state.measurements[at].next) {
      const MeasurementRecord& record = state.measurements[at];
      if (record.alive && record.quantity == quantity) found.push_back(at);
    }
    std::reverse(found.begin(), found.end());  // as they were added
    const auto model = [&](Index at) -> const MeasurementModel& {
      return *state.measurements[at].model;
    };
    if (query.choice == Choice::kMostCertain) {
      // Equal ones stay as they were added: by their numbers.
      const auto deviation = [&](Index at) {
        const double stated = model(at).standard_deviation;
        return std::isnan(stated) ? std::numeric_limits<double>::infinity() : stated;
      };
      std::sort(found.begin(), found.end(), [&](Index a, Index b) {
        return std::pair(deviation(a), a) < std::pair(deviation(b), b);
      });
    } else if (query.choice == Choice::kByProvenance) {
      const auto rank = [&](Index at) {
        return std::find(query.provenances.begin(), query.provenances.end(), model(at).provenance) -
               query.provenances.begin();
      };
      const auto last = static_cast<std::ptrdiff_t>(query.provenances.size());
      std::erase_if(found, [&](Index at) { return rank(at) == last; });
      std::sort(found.begin(), found.end(),
                [&](Index a, Index b) { return std::pair(rank(a), a) < std::pair(rank(b), b); });
    }
    return found;
  }

  Cell::View view(const MeasurementRecord& record) const {
    const Epoch epoch = as_of(record.cell->owner());
    Cell::View view = record.cell->view(epoch);
    for (int attempt = 0; !view.settled && attempt < kReadAttempts; ++attempt) {
      view = record.cell->view(epoch);
    }
    return view;
  }

  // The one measurement that may be folded into the constants: static, written, and the only
  // choice.
  const MeasurementRecord* constant(const std::vector<Index>& found) const {
    if (found.empty()) return nullptr;
    if (query.choice == Choice::kFreshest && found.size() > 1) return nullptr;
    const MeasurementRecord& record = state.measurements[found.front()];
    if (!std::holds_alternative<Static>(record.model->life_cycle)) return nullptr;
    return view(record).count > 0 ? &record : nullptr;
  }

  bool usable(Index at) const {
    const RelationRecord& relation = state.relations[at];
    if (!relation.alive || relation.suspended || relation.kind == RelationKind::kProperty) {
      return false;
    }
    for (const RelationId avoided : query.avoid) {
      if (avoided.index == at) return false;
    }
    return true;
  }

  double cost(const RelationRecord& relation, const std::vector<Index>& found) const {
    if (query.way == Way::kMostCertain) {
      const double stated = state.measurements[found.front()].model->standard_deviation;
      const double deviation = std::isnan(stated) ? kUnstatedDeviation : stated;
      return deviation * deviation + kConstantCost * kConstantCost;
    }
    (void)relation;
    return constant(found) ? kConstantCost : kMeasuredCost + kConstantCost;
  }

  // Dijkstra's algorithm; the relations from `from` to `to`. False when there is no way.
  bool find_way(Index from, Index to, std::vector<Index>& way) const {
    if (from == to) return true;
    struct Reached {
      double cost = std::numeric_limits<double>::infinity();
      Index by = kNone;
    };
    std::vector<Reached> reached(state.frames.size());
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    reached[from].cost = 0;
    open.emplace(0.0, from);
    while (!open.empty()) {
      const auto [so_far, frame] = open.top();
      open.pop();
      if (so_far > reached[frame].cost) continue;
      if (frame == to) break;
      for (Index at = state.frames[frame].first_relation; at != kNone;) {
        const RelationRecord& relation = state.relations[at];
        const bool is_of = relation.of == frame;
        const Index next = is_of ? relation.next_at_of : relation.next_at_with_respect_to;
        const Index other = is_of ? relation.with_respect_to : relation.of;
        if (other != frame && usable(at)) {
          const std::vector<Index> found = measurements(relation, position_of(relation.kind));
          if (!found.empty()) {
            const double total = so_far + cost(relation, found);
            Reached& there = reached[other];
            // Equal costs: the older relation, so that the same structure gives the same way.
            if (total < there.cost || (total == there.cost && at < there.by)) {
              there = {total, at};
              open.emplace(total, other);
            }
          }
        }
        at = next;
      }
    }
    if (reached[to].by == kNone) return false;
    std::vector<Index> back;
    for (Index frame = to; frame != from;) {
      const Index by = reached[frame].by;
      back.push_back(by);
      frame = state.relations[by].of == frame ? state.relations[by].with_respect_to
                                              : state.relations[by].of;
    }
    way.insert(way.end(), back.rbegin(), back.rend());
    return true;
  }

  void add_constant(const Pose& X) {
    before = has_before ? compose(before, X) : X;
    has_before = true;
  }

  std::uint32_t add_candidate(Index at) {
    if (plan->candidates.size() == kMaximumPlanCells) {
      refuse(names.text(state.frames[query.of.index].name),
             "the query needs more than " + std::to_string(kMaximumPlanCells) + " measurements",
             "ask for parts of the way");
    }
    const MeasurementRecord& record = state.measurements[at];
    plan->candidates.push_back(
        candidate_of(record, MeasurementId{at}, as_of(record.cell->owner())));
    plan->keep.push_back(record.cell);
    plan->keep.push_back(record.model);
    if (record.history) {
      plan->keep.push_back(record.published);
      plan->keep.push_back(record.history);
      plan->keeps_past = true;
    }
    return static_cast<std::uint32_t>(plan->candidates.size() - 1);
  }

  Index motion_candidate(const RelationRecord& relation, Quantity quantity) {
    const std::vector<Index> found = measurements(relation, quantity);
    return found.empty() ? kNone : add_candidate(found.front());
  }

  void describe(Index at, bool inverse, const std::vector<Index>& found, bool is_constant,
                const Pose& value = {}) {
    const RelationRecord& relation = state.relations[at];
    plan->symbolic.push_back({inverse ? "compose-inverse" : "compose", names.text(relation.name),
                              names.text(state.measurements[found.front()].name),
                              std::string(to_string(position_of(relation.kind))), is_constant,
                              inverse, RelationId{at}, MeasurementId{found.front()}, value});
  }

  void add_step(Index at, bool inverse) {
    const RelationRecord& relation = state.relations[at];
    const Quantity quantity = position_of(relation.kind);
    const std::vector<Index> found = measurements(relation, quantity);
    const bool joint = relation.kind != RelationKind::kFree;
    if (const MeasurementRecord* const record = constant(found)) {
      const Cell::View last = view(*record);
      std::vector<double> values(record->cell->values());
      record->cell->read(last, last.count - 1, values.data(), record->cell->values());
      Pose X = joint ? compose(relation.placement, relation.kind == RelationKind::kRevolute
                                                       ? revolute(values[0])
                                                       : prismatic(values[0]))
                     : load_pose(values.data());
      add_constant(inverse ? invert(X) : X);
      describe(at, inverse, found, true, X);
      return;
    }
    if (joint && !inverse) add_constant(relation.placement);
    PlanStep step;
    step.kind = relation.kind;
    step.inverse = inverse;
    step.freshest = query.choice == Choice::kFreshest;
    step.first = static_cast<std::uint32_t>(plan->candidates.size());
    step.count = static_cast<std::uint32_t>(found.size());
    for (const Index measurement : found) add_candidate(measurement);
    const Candidate& only = plan->candidates[step.first];
    step.is_simple = !joint && step.count == 1 && !only.is_static && !only.prediction &&
                     only.model->interpolation == Interpolation::kLinear;
    if (motion) {
      step.velocity =
          motion_candidate(relation, joint ? Quantity::kJointVelocity : Quantity::kTwist);
      step.acceleration = motion_candidate(
          relation, joint ? Quantity::kJointAcceleration : Quantity::kAcceleration);
    }
    step.has_before = has_before;
    step.before = before;
    before = {};
    has_before = false;
    plan->steps.push_back(step);
    if (joint && inverse) add_constant(invert(relation.placement));
    describe(at, inverse, found, false);
  }

  bool alive(FrameId frame) const {
    const FrameRecord* const record = state.frames.find(frame.index);
    return record && record->alive;
  }

  void run() {
    std::vector<FrameId> stops = {query.with_respect_to};
    stops.insert(stops.end(), query.via.begin(), query.via.end());
    stops.push_back(query.of);
    for (const FrameId stop : stops) {
      if (!alive(stop)) {
        plan->status = Status::kRemoved;
        return;
      }
    }
    std::vector<Index> way;
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      if (!find_way(stops[i].index, stops[i + 1].index, way)) {
        plan->status = Status::kNotConnected;
        return;
      }
    }
    Index frame = query.with_respect_to.index;
    for (const Index at : way) {
      const bool inverse = state.relations[at].with_respect_to != frame;
      add_step(at, inverse);
      frame = inverse ? state.relations[at].with_respect_to : state.relations[at].of;
    }
    plan->has_tail = has_before;
    plan->tail = before;
  }
};

}  // namespace

Candidate candidate_of(const MeasurementRecord& record, MeasurementId measurement, Epoch as_of) {
  Candidate candidate;
  candidate.cell = record.cell.get();
  candidate.as_of = as_of;
  candidate.model = record.model.get();
  candidate.measurement = measurement;
  candidate.quantity = record.quantity;
  candidate.period = record.model->period;
  const LifeCycle& life_cycle = record.model->life_cycle;
  candidate.is_static = std::holds_alternative<Static>(life_cycle);
  candidate.prediction = std::get_if<Prediction>(&life_cycle);
  if (const auto* timed = std::get_if<TimeDependent>(&life_cycle)) {
    candidate.validity = timed->validity;
    candidate.expiry = timed->expiry;
  } else if (candidate.prediction) {
    candidate.validity = candidate.prediction->horizon;
  }
  candidate.is_timed = candidate.validity != kForever || candidate.expiry != Stamp::max() ||
                       candidate.period != kForever;
  if (as_of == kNow) {
    candidate.published = record.published.get();
  } else {
    candidate.inherited = record.history.get();
  }
  return candidate;
}

std::vector<MeasurementId> measurements_of(const Plan& plan) {
  std::vector<MeasurementId> found;
  for (const SymbolicStep& step : plan.symbolic) found.push_back(step.measurement_id);
  for (const Candidate& candidate : plan.candidates) found.push_back(candidate.measurement);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::shared_ptr<const Plan> make_plan(const State& state, const Names& names, const AsOf& as_of,
                                      const PoseQuery& query, bool motion,
                                      std::uint64_t structure_version) {
  Planner planner{state, names, as_of, query, motion};
  planner.plan->structure_version = structure_version;
  planner.run();
  return planner.plan;
}

}  // namespace sinew::world
