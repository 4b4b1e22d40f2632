// How long what was measured holds, and what it becomes afterwards.
//
//   static          the same for as long as it is declared: one value, no stamp needed
//   time-dependent  holds for `validity` after its stamp, or until `expiry`
//   prediction      as time-dependent, and a model tells what it is after its last stamp
//
// Nothing is extrapolated without a declared model, and none beyond its horizon. Whoever asks may
// also take the model itself and predict on his own (World::model).
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sinew/world/clock.h"
#include "sinew/world/pose.h"

namespace sinew::world {

// Of a pose X_AB: B moves with this twist, seen from B. Without one: that of the last two entries,
// whose number must then be two at least. Of numbers (joint positions, …): a rate for each.
struct ConstantVelocity {
  std::optional<Twist> twist = {};
  std::vector<double> rates = {};
};

// Of a pose: the twist at the entry's stamp, and the derivative of its six numbers, both seen from
// B; the motion is integrated over kIntegrationSteps equal steps of the exponential map (midpoint
// rule), exactly where the axis keeps its direction. Of numbers: x + v t + a t^2 / 2.
struct ConstantAcceleration {
  Twist twist = {};
  Twist twist_rate = {};
  std::vector<double> rates = {}, accelerations = {};
};
inline constexpr int kIntegrationSteps = 16;

// What lies on it moves along a direction of A, without turning: X_AB with p + v t.
struct Conveyor {
  Vector3 velocity_A;  // [m/s]
};

// Any pure function: the last entry's numbers, seconds since its stamp, and where the predicted
// numbers go. Called by readers, in real time too: it must not allocate, lock or throw.
struct UserModel {
  std::string name;
  std::function<void(const double* last, double seconds, double* predicted)> predict;
};

using PredictionModel = std::variant<ConstantVelocity, ConstantAcceleration, Conveyor, UserModel>;

struct Static {};
struct TimeDependent {
  Duration validity = kForever;
  Stamp expiry = Stamp::max();
};
struct Prediction {
  PredictionModel model;
  Duration horizon = kForever;  // after the last stamp; beyond it there is no answer
};

using LifeCycle = std::variant<Static, TimeDependent, Prediction>;

std::string to_string(const LifeCycle& life_cycle);  // "static", "time-dependent", "prediction"

// The numbers predicted from an entry (`last`) and, for models that need it, the one before it,
// which is `spacing_s` older. False when the model needs what is not there. Poses are seven
// numbers.
bool predict(const PredictionModel& model, bool is_pose, std::size_t size, const double* last,
             const double* before_last, double spacing_s, double seconds, double* predicted);

}  // namespace sinew::world
