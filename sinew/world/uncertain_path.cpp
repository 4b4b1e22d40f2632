#include "sinew/world/uncertain_path.h"

#include <cmath>
#include <set>

#include "sinew/world/impl.h"
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

World::Sample sample(const World& world, MeasurementId measurement, Stamp time, Asking asking) {
  return asking == Asking::kAt ? world.at(measurement, time) : world.latest(measurement, time);
}

// Of the measurements of a step the one that a pose query uses (plan_reading.h, read_step): the
// preferred one, otherwise the first that has an answer.
Measured measured(const World& world, const Plan& plan, const PlanStep& step, Stamp now,
                  Asking asking) {
  std::vector<World::Sample> samples;
  std::uint32_t preferred = 0;
  for (std::uint32_t i = 0; i < step.count; ++i) {
    samples.push_back(sample(world, plan.candidates[step.first + i].measurement, now, asking));
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

// Whether the displaced pose has the measured one as its mean.
bool is_centred(const PoseDistribution& displacement) {
  Pose mean;
  if (const auto* exact = std::get_if<Pose>(&displacement)) {
    mean = *exact;
  } else if (const auto* gaussian = std::get_if<GaussianPose>(&displacement)) {
    mean = gaussian->mean;
  } else {
    return false;
  }
  return mean.q.w == 1 && mean.p.x == 0 && mean.p.y == 0 && mean.p.z == 0;
}

// Far apart among the seeds, so that the steps of one way do not draw what another's do.
constexpr std::uint64_t kSeedStep = 0x9E3779B97F4A7C15;  // 2^64 / golden ratio

// In a world that is made for one question: what its measurements state becomes what is known of
// them, of whatever kind.
void state_deviations(const World& still, const Uncertainties& known, Stamp time, Asking asking) {
  WorldImpl& impl = still.impl();
  State next = impl.published();
  const EditToken token = fresh_token();
  for (const MeasurementId measurement : known.declared()) {
    const MeasurementRecord* const record = next.measurements.find(measurement.index);
    if (!record || !record->alive) continue;
    const RelationKind kind = next.relations[record->relation].kind;
    const auto displacement = known.find(still, measurement, kind, time, asking);
    if (!displacement) continue;
    MeasurementModel model = *record->model;
    model.standard_deviation = total_deviation(*displacement);
    next.measurements.edit(measurement.index, token).model =
        std::make_shared<const MeasurementModel>(std::move(model));
  }
  impl.publish(std::move(next));
}

}  // namespace

void Uncertainties::set(const World& world, MeasurementId measurement, const Covariance& S) {
  set_distribution(world, measurement, GaussianPose{{}, S});
}

void Uncertainties::set_distribution(const World& world, MeasurementId measurement,
                                     PoseDistribution displacement) {
  const State state = world.state();
  if (record_of(state, world, measurement).quantity != Quantity::kPose) {
    refuse(world.name(measurement), "the uncertainty of a pose for what is no pose",
           "see set_joint for joint positions");
  }
  if (const auto* gaussian = std::get_if<GaussianPose>(&displacement);
      gaussian && !is_covariance(gaussian->covariance)) {
    refuse(world.name(measurement), "its matrix is no covariance",
           "finite, symmetric, and of no negative variance");
  }
  if (const auto fault = fault_of(displacement)) {
    refuse(world.name(measurement), *fault, "a distribution of its displacement");
  }
  declared_[measurement] = std::move(displacement);
}

void Uncertainties::set_measured(const World& world, MeasurementId measurement,
                                 MeasurementId numbers) {
  const State state = world.state();
  const MeasurementRecord& pose = record_of(state, world, measurement);
  const MeasurementRecord& other = record_of(state, world, numbers);
  if (pose.quantity != Quantity::kPose || other.quantity != Quantity::kOther ||
      pose.relation != other.relation) {
    refuse(world.name(measurement), "its uncertainty in " + world.name(numbers),
           "a pose, and a measurement of the same relation that has the numbers of a distribution");
  }
  declared_[measurement] = numbers;
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
  declared_[measurement] = Joint{deviation * deviation};
}

void Uncertainties::set_exact(MeasurementId measurement) {
  declared_[measurement] = PoseDistribution(Pose());
}

std::optional<PoseDistribution> Uncertainties::find(const World& world, MeasurementId measurement,
                                                    RelationKind kind, Stamp time,
                                                    Asking asking) const {
  const auto found = declared_.find(measurement);
  if (found == declared_.end()) return std::nullopt;
  if (const auto* stated = std::get_if<PoseDistribution>(&found->second)) return *stated;
  if (const auto* joint = std::get_if<Joint>(&found->second)) {
    // exp(q e_z) exp(d e_z) = exp((q + d) e_z): the deviation is about z of the moved frame.
    GaussianPose about_z;
    const std::size_t axis = kind == RelationKind::kPrismatic ? 5 : 2;
    about_z.covariance(axis, axis) = joint->variance;
    return about_z;
  }
  const World::Sample numbers = sample(world, std::get<MeasurementId>(found->second), time, asking);
  const World::Sample pose = sample(world, measurement, time, asking);
  if (asking == Asking::kAt ? numbers.stamp != time || pose.stamp != time
                            : numbers.bounds.newest != pose.bounds.newest) {
    return std::nullopt;
  }
  return from_numbers(numbers.values);
}

MeasurementId Uncertainties::numbers_of(MeasurementId measurement) const {
  const auto found = declared_.find(measurement);
  const auto* numbers =
      found == declared_.end() ? nullptr : std::get_if<MeasurementId>(&found->second);
  return numbers ? *numbers : MeasurementId{};
}

std::vector<MeasurementId> Uncertainties::declared() const {
  std::vector<MeasurementId> all;
  for (const auto& [measurement, what] : declared_) all.push_back(measurement);
  return all;
}

namespace {

DistributedPose distribution_of(const World& world, const PoseQuery& query,
                                const Uncertainties& known, Stamp time, Asking asking,
                                const CombineOptions& options, const UncertaintyGuard& guard) {
  const World still = world.clone();
  if (query.choice == Choice::kMostCertain || query.way == Way::kMostCertain) {
    state_deviations(still, known, time, asking);
  }
  const State state = still.state();
  PreparedPose prepared = still.prepare_pose(query);
  if (guard) {
    std::vector<MeasurementId> numbers;
    const auto add = [&](MeasurementId measurement) {
      if (const MeasurementId found = known.numbers_of(measurement)) numbers.push_back(found);
    };
    for (const SymbolicStep& walked : prepared.plan().symbolic) add(walked.measurement_id);
    for (const Candidate& candidate : prepared.plan().candidates) add(candidate.measurement);
    guard(prepared.plan(), numbers);
  }
  DistributedPose answer;
  answer.status = prepared.status();
  if (answer.status != Status::kOk) return answer;
  // What would be answered without uncertainty, and all reasons why not.
  const PoseAnswer certain = asking == Asking::kAt ? prepared.at(time) : prepared.latest(time);
  answer.status = certain.status;
  if (answer.status != Status::kOk) return answer;

  const Plan& plan = prepared.plan();
  std::size_t step = 0;  // of the plan: those that are measured
  std::set<MeasurementId> passed;
  PoseDistribution X = Pose();
  CombineOptions each = options;
  bool all_centred = true;
  for (const SymbolicStep& walked : plan.symbolic) {
    const RelationRecord& relation = state.relations[walked.relation_id.index];
    Pose mean = walked.value;
    MeasurementId used = walked.measurement_id;
    if (!walked.constant) {
      const Measured found = measured(still, plan, plan.steps[step++], time, asking);
      answer.status = found.status;
      if (answer.status != Status::kOk) return answer;
      mean = pose_of(relation, found.values);
      used = found.measurement;
    }
    if (!passed.insert(used).second) {
      refuse(still.name(used), "the way passes it twice, so its parts are not independent",
             "a way without a loop");
    }
    PoseDistribution next = mean;
    if (const auto displacement = known.find(still, used, relation.kind, time, asking)) {
      next = compose(next, *displacement, options);
      all_centred = all_centred && is_centred(*displacement);
    } else {
      answer.undeclared.push_back(still.name(used));
    }
    X = compose(X, walked.inverse ? invert(next) : next, each);
    // Draws of one step are not those of another.
    if (each.seed) *each.seed += kSeedStep;
  }
  answer.pose = answer.undeclared.empty() ? std::move(X) : certain.pose;
  if (all_centred) {
    // To the last bit the pose that is answered without uncertainty.
    if (auto* exact = std::get_if<Pose>(&answer.pose)) *exact = certain.pose;
    if (auto* gaussian = std::get_if<GaussianPose>(&answer.pose)) gaussian->mean = certain.pose;
  }
  return answer;
}

}  // namespace

DistributedPose pose_distribution(const World& world, const PoseQuery& query,
                                  const Uncertainties& known, Stamp now,
                                  const CombineOptions& options, const UncertaintyGuard& guard) {
  return distribution_of(world, query, known, now, Asking::kLatest, options, guard);
}

DistributedPose pose_distribution_at(const World& world, const PoseQuery& query,
                                     const Uncertainties& known, Stamp time,
                                     const CombineOptions& options, const UncertaintyGuard& guard) {
  return distribution_of(world, query, known, time, Asking::kAt, options, guard);
}

UncertainPose uncertain_pose(const World& world, const PoseQuery& query, const Uncertainties& known,
                             Stamp now, Order order, const UncertaintyGuard& guard) {
  const DistributedPose found =
      pose_distribution(world, query, known, now, {.order = order}, guard);
  UncertainPose answer{found.status, {}, found.undeclared};
  if (const auto* gaussian = std::get_if<GaussianPose>(&found.pose)) {
    answer.pose = *gaussian;
  } else if (const auto* exact = std::get_if<Pose>(&found.pose)) {
    answer.pose.mean = *exact;
  } else {
    refuse(world.name(query.of),
           "its pose is a " + std::string(kind_of(found.pose)) + ", no Gaussian",
           "pose_distribution, and gaussian_of if one Gaussian will do");
  }
  return answer;
}

}  // namespace sinew::world
