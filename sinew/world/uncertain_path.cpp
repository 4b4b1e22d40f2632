#include "sinew/world/uncertain_path.h"

#include <cmath>
#include <set>

#include "sinew/world/plan.h"
#include "sinew/world/reading.h"
#include "sinew/world/refuse.h"

namespace sinew::world {
namespace {

const MeasurementRecord& record_of(const State& state, const World& world,
                                   MeasurementId measurement) {
  world.name(measurement);  // throws where there is none
  return state.measurements[measurement.index];
}

// One step of the way: what was measured there, and which measurement it was.
struct Measured {
  Status status = Status::kNoData;
  MeasurementId measurement;
  std::vector<double> values;
};

// Of the measurements of a step the one that a pose query uses (plan_reading.h, read_step): the
// preferred one, otherwise the first that has an answer.
Measured measured(const World& world, const Plan& plan, const PlanStep& step, Stamp now) {
  std::vector<World::Sample> samples;
  std::uint32_t preferred = 0;
  for (std::uint32_t i = 0; i < step.count; ++i) {
    samples.push_back(world.latest(plan.candidates[step.first + i].measurement, now));
    if (step.freshest && samples[i].bounds.newest > samples[preferred].bounds.newest) preferred = i;
  }
  std::uint32_t used = preferred;
  for (std::uint32_t i = 0; samples[used].status != Status::kOk && i < step.count; ++i) {
    if (samples[i].status == Status::kOk) used = i;
  }
  if (samples[used].status != Status::kOk) used = preferred;
  return {samples[used].status, plan.candidates[step.first + used].measurement,
          std::move(samples[used].values)};
}

Pose pose_of(const RelationRecord& relation, const std::vector<double>& values) {
  if (relation.kind == RelationKind::kFree) return load_pose(values.data());
  return compose(relation.placement, relation.kind == RelationKind::kRevolute
                                         ? revolute(values[0])
                                         : prismatic(values[0]));
}

}  // namespace

void Uncertainties::set(const World& world, MeasurementId measurement, const Covariance& S) {
  const State state = world.state();
  if (record_of(state, world, measurement).quantity != Quantity::kPose) {
    refuse(world.name(measurement), "six by six numbers for what is no pose",
           "see set_joint for joint positions");
  }
  if (!is_covariance(S)) {
    refuse(world.name(measurement), "its matrix is no covariance",
           "finite, symmetric, and of no negative variance");
  }
  declared_[measurement] = {S, S};
}

void Uncertainties::set_joint(const World& world, MeasurementId measurement, double deviation) {
  const State state = world.state();
  if (record_of(state, world, measurement).quantity != Quantity::kJointPosition) {
    refuse(world.name(measurement), "a joint's deviation for what is no joint position",
           "see set for poses");
  }
  if (!std::isfinite(deviation) || deviation < 0) {
    refuse(world.name(measurement), "a standard deviation of " + std::to_string(deviation),
           "a finite number, zero or more");
  }
  // exp(q e_z) exp(d e_z) = exp((q + d) e_z): the deviation is about z of the moved frame.
  Declared declared;
  declared.pose(2, 2) = declared.prismatic(5, 5) = deviation * deviation;
  declared_[measurement] = declared;
}

void Uncertainties::set_exact(MeasurementId measurement) { declared_[measurement] = {}; }

const Covariance* Uncertainties::find(MeasurementId measurement, RelationKind kind) const {
  const auto found = declared_.find(measurement);
  if (found == declared_.end()) return nullptr;
  return kind == RelationKind::kPrismatic ? &found->second.prismatic : &found->second.pose;
}

UncertainPose uncertain_pose(const World& world, const PoseQuery& query, const Uncertainties& known,
                             Stamp now, Order order) {
  const World still = world.clone();
  const State state = still.state();
  const PreparedPose prepared = still.prepare_pose(query);
  UncertainPose answer;
  answer.status = prepared.status();
  if (answer.status != Status::kOk) return answer;
  // What would be answered without uncertainty, and all reasons why not.
  const PoseAnswer certain = prepared.latest_realtime(now);
  answer.status = certain.status;
  if (answer.status != Status::kOk) return answer;

  const Plan& plan = prepared.plan();
  std::size_t step = 0;  // of the plan: those that are measured
  std::set<MeasurementId> passed;
  GaussianPose X;
  for (const SymbolicStep& walked : plan.symbolic) {
    const RelationRecord& relation = state.relations[walked.relation_id.index];
    GaussianPose next{walked.value, {}};
    MeasurementId used = walked.measurement_id;
    if (!walked.constant) {
      const Measured found = measured(still, plan, plan.steps[step++], now);
      answer.status = found.status;
      if (answer.status != Status::kOk) return answer;
      next.mean = pose_of(relation, found.values);
      used = found.measurement;
    }
    if (!passed.insert(used).second) {
      refuse(still.name(used), "the way passes it twice, so its parts are not independent",
             "a way without a loop");
    }
    if (const Covariance* const S = known.find(used, relation.kind)) {
      next.covariance = *S;
    } else {
      answer.undeclared.push_back(still.name(used));
    }
    X = compose(X, walked.inverse ? invert(next) : next, order);
  }
  answer.pose = X;
  answer.pose.mean = certain.pose;
  if (!answer.undeclared.empty()) answer.pose.covariance = {};
  return answer;
}

}  // namespace sinew::world
