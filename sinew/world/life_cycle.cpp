#include "sinew/world/life_cycle.h"

namespace sinew::world {
namespace {

Pose load(const double* at) { return {{at[0], at[1], at[2], at[3]}, {at[4], at[5], at[6]}}; }
void store(const Pose& X, double* at) {
  at[0] = X.q.x, at[1] = X.q.y, at[2] = X.q.z, at[3] = X.q.w;
  at[4] = X.p.x, at[5] = X.p.y, at[6] = X.p.z;
}

Twist scaled(const Twist& V, double s) { return {s * V.angular, s * V.linear}; }

struct Predict {
  bool is_pose;
  std::size_t size;
  const double* last;
  const double* before_last;
  double spacing_s, seconds;
  double* out;

  bool operator()(const ConstantVelocity& model) const {
    if (is_pose) {
      const Pose X = load(last);
      if (!model.twist && (!before_last || !(spacing_s > 0))) return false;
      const Twist V = model.twist
                          ? *model.twist
                          : scaled(logarithm(compose(invert(load(before_last)), X)), 1 / spacing_s);
      store(compose(X, exponential(V, seconds)), out);
      return true;
    }
    const bool estimated = model.rates.empty();
    if (estimated ? !before_last || !(spacing_s > 0) : model.rates.size() != size) return false;
    for (std::size_t i = 0; i < size; ++i) {
      const double rate = estimated ? (last[i] - before_last[i]) / spacing_s : model.rates[i];
      out[i] = last[i] + rate * seconds;
    }
    return true;
  }

  bool operator()(const ConstantAcceleration& model) const {
    if (is_pose) {
      Pose X = load(last);
      const double step = seconds / kIntegrationSteps;
      for (int i = 0; i < kIntegrationSteps; ++i) {
        const double middle = (i + 0.5) * step;
        const Twist rate = scaled(model.twist_rate, middle);
        X = compose(
            X, exponential({model.twist.angular + rate.angular, model.twist.linear + rate.linear},
                           step));
      }
      store(X, out);
      return true;
    }
    if (model.rates.size() != size || model.accelerations.size() != size) return false;
    for (std::size_t i = 0; i < size; ++i) {
      out[i] = last[i] + (model.rates[i] + 0.5 * model.accelerations[i] * seconds) * seconds;
    }
    return true;
  }

  bool operator()(const Conveyor& model) const {
    if (!is_pose) return false;
    Pose X = load(last);
    X.p = X.p + seconds * model.velocity_A;
    store(X, out);
    return true;
  }

  bool operator()(const UserModel& model) const {
    if (!model.predict) return false;
    model.predict(last, seconds, out);
    return true;
  }
};

}  // namespace

std::string to_string(const LifeCycle& life_cycle) {
  static constexpr const char* kNames[] = {"static", "time-dependent", "prediction"};
  return kNames[life_cycle.index()];
}

bool predict(const PredictionModel& model, bool is_pose, std::size_t size, const double* last,
             const double* before_last, double spacing_s, double seconds, double* predicted) {
  return std::visit(Predict{is_pose, size, last, before_last, spacing_s, seconds, predicted},
                    model);
}

}  // namespace sinew::world
