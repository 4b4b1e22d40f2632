// How certain a relative pose is: the covariances that measurements are declared with, composed
// along the way that a pose query takes.
//
//   Uncertainties known;
//   known.set(world, seen, isotropic(0.01, 0.005));
//   known.set_joint(world, elbow, 0.001);
//   UncertainPose answer = uncertain_pose(world, {.of = part, .with_respect_to = base}, known,
//   now);
//
// All measurements are read at one instant (from a clone of the world, made for the question), and
// taken as independent; one that the way passes twice is therefore refused. Nothing is assumed of a
// measurement that has no declared uncertainty: the answer names it. Not for real-time threads.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sinew/world/gaussian_pose.h"
#include "sinew/world/world.h"

namespace sinew::world {

class Uncertainties {
 public:
  // Of a pose X_AB, seen from B. Throws Error when the measurement is no pose, or S no covariance.
  void set(const World& world, MeasurementId measurement, const Covariance& S);
  // Of a joint's position [rad or m]. Throws Error when it is none, or the number is negative or
  // not finite.
  void set_joint(const World& world, MeasurementId measurement, double deviation);
  // Exactly known, as constants of a model may be.
  void set_exact(MeasurementId measurement);

  // Null where nothing is declared. A joint's is about or along z, seen from the moved frame.
  const Covariance* find(MeasurementId measurement, RelationKind kind) const;

 private:
  struct Declared {
    Covariance pose;       // of a pose, or of a revolute joint
    Covariance prismatic;  // of a prismatic joint
  };
  std::map<MeasurementId, Declared> declared_;
};

struct UncertainPose {
  Status status = Status::kNoData;      // as of a pose query
  GaussianPose pose;                    // when it is kOk
  std::vector<std::string> undeclared;  // measurements on the way without an uncertainty; then the
                                        // covariance is none, all zero
  explicit operator bool() const { return status == Status::kOk && undeclared.empty(); }
};

UncertainPose uncertain_pose(const World& world, const PoseQuery& query, const Uncertainties& known,
                             Stamp now, Order order = Order::kFourth);

}  // namespace sinew::world
