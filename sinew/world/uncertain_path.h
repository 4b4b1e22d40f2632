// How certain a relative pose is: what measurements are declared, or measured, to be uncertain by,
// composed along the way that a pose query takes.
//
//   Uncertainties known;
//   known.set(world, seen, isotropic(0.01, 0.005));
//   known.set_joint(world, elbow, 0.001);
//   known.set_distribution(world, guessed, PoseMixture{{{0.7, upright}, {0.3, upside_down}}});
//   DistributedPose answer = pose_distribution(world, {.of = part, .with_respect_to = base}, known,
//                                              now);
//
// All measurements are read at one instant (from a clone of the world, made for the question), and
// taken as independent; one that the way passes twice is therefore refused. Nothing is assumed of a
// measurement that has no declared uncertainty: the answer names it. Not for real-time threads.
//
// What is declared is about the *displacement* X_measured^-1 X_true, seen from the measured frame,
// so that it goes with the measured pose: of a Gaussian, mean identity.
//
// Choice::kMostCertain and Way::kMostCertain go by what is declared here, of whatever kind
// (total_deviation), and by the measurement's stated deviation where nothing is.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sinew/world/pose_distribution.h"
#include "sinew/world/world.h"

namespace sinew::world {

// The last entries, as of now, or the state at a time (prepared.h).
enum class Asking : std::uint8_t { kLatest, kAt };

class Uncertainties {
 public:
  // Of a pose X_AB, seen from B. Throws Error when the measurement is no pose, or S no covariance.
  void set(const World& world, MeasurementId measurement, const Covariance& S);
  // Of a pose: the displacement. Throws Error when the measurement is no pose, or it is no
  // distribution.
  void set_distribution(const World& world, MeasurementId measurement,
                        PoseDistribution displacement);
  // Of a pose: the displacement is measured, and lies as numbers (`to_numbers`) in another
  // measurement of the same relation. It counts only with the pose that has the same stamp, so the
  // two are written as one (World::write_together). Throws Error unless they are a pose and a
  // Quantity::kOther of one relation.
  void set_measured(const World& world, MeasurementId measurement, MeasurementId numbers);
  // Of a joint's position [rad or m]. Throws Error when it is none, or the number is negative or
  // not finite.
  void set_joint(const World& world, MeasurementId measurement, double deviation);
  // Exactly known, as constants of a model may be.
  void set_exact(MeasurementId measurement);

  // The displacement of a relation's measurement, as `world` has it now. Nothing where nothing is
  // declared, or what is measured is of another stamp than the pose (and, for Asking::kAt, than the
  // time: between two entries nothing is said), or no distribution. A joint's is about or along z.
  std::optional<PoseDistribution> find(const World& world, MeasurementId measurement,
                                       RelationKind kind, Stamp time,
                                       Asking asking = Asking::kLatest) const;
  // Where the displacement is measured as numbers; index kNone where it is not.
  MeasurementId numbers_of(MeasurementId measurement) const;
  std::vector<MeasurementId> declared() const;

 private:
  struct Joint {
    double variance;
  };
  std::map<MeasurementId, std::variant<PoseDistribution, Joint, MeasurementId>> declared_;
};

struct DistributedPose {
  Status status = Status::kNoData;      // as of a pose query
  PoseDistribution pose;                // when it is kOk
  std::vector<std::string> undeclared;  // measurements on the way without an uncertainty; then only
                                        // the pose that would be answered without
  explicit operator bool() const { return status == Status::kOk && undeclared.empty(); }
};

// Looks at what is read before it is (reader.h): the plan, and the measurements that are read as
// the numbers of distributions. Throws Error where somebody may not.
using UncertaintyGuard =
    std::function<void(const Plan& plan, const std::vector<MeasurementId>& numbers)>;

// Throws Error where kinds meet that need more than `options` says (pose_distribution.h).
DistributedPose pose_distribution(const World& world, const PoseQuery& query,
                                  const Uncertainties& known, Stamp now,
                                  const CombineOptions& options = {},
                                  const UncertaintyGuard& guard = {});
// At a time: between entries, by models, and from histories, as PreparedPose::at.
DistributedPose pose_distribution_at(const World& world, const PoseQuery& query,
                                     const Uncertainties& known, Stamp time,
                                     const CombineOptions& options = {},
                                     const UncertaintyGuard& guard = {});

struct UncertainPose {
  Status status = Status::kNoData;      // as of a pose query
  GaussianPose pose;                    // when it is kOk
  std::vector<std::string> undeclared;  // measurements on the way without an uncertainty; then the
                                        // covariance is none, all zero
  explicit operator bool() const { return status == Status::kOk && undeclared.empty(); }
};

// Where all is exact or Gaussian. Throws Error where it is not: ask pose_distribution, and take its
// gaussian_of if that will do.
UncertainPose uncertain_pose(const World& world, const PoseQuery& query, const Uncertainties& known,
                             Stamp now, Order order = Order::kFourth,
                             const UncertaintyGuard& guard = {});

}  // namespace sinew::world
