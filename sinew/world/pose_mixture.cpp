#include "sinew/world/pose_mixture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sinew/world/matrix6.h"
#include "sinew/world/refuse.h"

namespace sinew::world {
namespace {

// A Gaussian seen from another mean: the same draws as deviations from there, to first order, and
// about that mean instead of its own.
Covariance about(const Pose& mean, const GaussianPose& X) {
  const Vector6 d = between(mean, X.mean);
  const Matrix6 J = after_displacement(d);
  Covariance S = J * X.covariance * transpose(J);
  add_square(S, 1, d);
  return S;
}

PoseComponent merged(const PoseComponent& a, const PoseComponent& b) {
  const double weight = a.weight + b.weight;
  const Pose mean = screw(a.pose.mean, b.pose.mean, b.weight / weight);
  Covariance S;
  add(S, a.weight / weight, about(mean, a.pose));
  add(S, b.weight / weight, about(mean, b.pose));
  return {weight, {mean, symmetric(S)}};
}

double weighted_log(double weight, const Covariance& S) {
  return weight * Factored(S).log_determinant();
}

// A component and its w log|S|.
struct Part {
  PoseComponent component;
  double entropy;
  explicit Part(PoseComponent of)
      : component(std::move(of)),
        entropy(weighted_log(component.weight, component.pose.covariance)) {}
};

double loss(const Part& a, const Part& b) {
  const double weight = a.component.weight + b.component.weight;
  const double share = b.component.weight / weight;
  Covariance S;
  add(S, 1 - share, a.component.pose.covariance);
  add(S, share, b.component.pose.covariance);
  add_square(S, share * (1 - share), between(a.component.pose.mean, b.component.pose.mean));
  return 0.5 * (weighted_log(weight, S) - a.entropy - b.entropy);
}

void check_most(std::size_t most) {
  if (most == 0 || most > kMaximumComponents) {
    refuse({}, "a mixture of at most " + std::to_string(most) + " components",
           "1 to " + std::to_string(kMaximumComponents));
  }
}

}  // namespace

std::optional<std::string> fault_of(const PoseMixture& mixture) {
  const std::size_t count = mixture.components.size();
  if (count == 0 || count > kMaximumComponents) {
    return "it has " + std::to_string(count) + " components, not 1 to " +
           std::to_string(kMaximumComponents);
  }
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const PoseComponent& one = mixture.components[i];
    const std::string which = "component " + std::to_string(i);
    if (!std::isfinite(one.weight) || one.weight <= 0) {
      return which + " has the weight " + std::to_string(one.weight) + ", which is not positive";
    }
    Pose mean = one.pose.mean;
    if (!normalise(mean)) return "the mean of " + which + " is no pose";
    if (!is_covariance(one.pose.covariance)) return "the matrix of " + which + " is no covariance";
    sum += one.weight;
  }
  if (std::abs(sum - 1) > kWeightTolerance) {
    return "its weights add up to " + std::to_string(sum) + ", not to 1";
  }
  return std::nullopt;
}

PoseMixture compose(const PoseMixture& X_AB, const PoseMixture& X_BC, std::size_t most,
                    Order order) {
  check_most(most);
  if (X_AB.components.size() * X_BC.components.size() > kMaximumFactor * kMaximumFactor) {
    return compose(reduce(X_AB, kMaximumFactor), reduce(X_BC, kMaximumFactor), most, order);
  }
  PoseMixture product;
  for (const PoseComponent& a : X_AB.components) {
    for (const PoseComponent& b : X_BC.components) {
      product.components.push_back({a.weight * b.weight, compose(a.pose, b.pose, order)});
    }
  }
  return reduce(std::move(product), most);
}

PoseMixture compose(const Pose& X_AB, const PoseMixture& X_BC) {
  PoseMixture result = X_BC;
  for (PoseComponent& one : result.components) one.pose = compose(X_AB, one.pose);
  return result;
}

PoseMixture compose(const PoseMixture& X_AB, const Pose& X_BC) {
  PoseMixture result = X_AB;
  for (PoseComponent& one : result.components) one.pose = compose(one.pose, X_BC);
  return result;
}

PoseMixture invert(const PoseMixture& X_AB) {
  PoseMixture result = X_AB;
  for (PoseComponent& one : result.components) one.pose = invert(one.pose);
  return result;
}

PoseMixture reduce(PoseMixture mixture, std::size_t most) {
  check_most(most);
  if (mixture.components.size() <= most) return mixture;
  std::vector<Part> rest;
  for (PoseComponent& one : mixture.components) rest.emplace_back(std::move(one));
  // losses[i][j], j < i, so that each merging computes only what it changed.
  std::vector<std::vector<double>> losses(rest.size());
  for (std::size_t i = 0; i < rest.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) losses[i].push_back(loss(rest[i], rest[j]));
  }
  while (rest.size() > most) {
    std::size_t first = 1, second = 0;
    for (std::size_t i = 1; i < rest.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (losses[i][j] < losses[first][second]) first = i, second = j;
      }
    }
    rest[second] = Part(merged(rest[second].component, rest[first].component));
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(first));
    losses.erase(losses.begin() + static_cast<std::ptrdiff_t>(first));
    for (std::size_t i = first; i < losses.size(); ++i) {
      losses[i].erase(losses[i].begin() + static_cast<std::ptrdiff_t>(first));
    }
    for (std::size_t other = 0; other < rest.size(); ++other) {
      if (other == second) continue;
      losses[std::max(other, second)][std::min(other, second)] = loss(rest[other], rest[second]);
    }
  }
  mixture.components.clear();
  for (Part& one : rest) mixture.components.push_back(std::move(one.component));
  return mixture;
}

std::optional<Pose> mean_of(const std::vector<WeightedPose>& poses) {
  if (poses.empty()) return std::nullopt;
  const auto heaviest = std::max_element(
      poses.begin(), poses.end(), [](const auto& a, const auto& b) { return a.weight < b.weight; });
  Pose mean = heaviest->pose;
  for (int iteration = 0; iteration < kMeanIterations; ++iteration) {
    Vector6 step = {};
    double size = 0;
    for (const WeightedPose& one : poses) {
      const Vector6 d = between(mean, one.pose);
      for (std::size_t i = 0; i < 6; ++i) step[i] += one.weight * d[i];
    }
    for (const double number : step) size += number * number;
    mean = compose(mean, exponential(twist_of(step), 1));
    if (!normalise(mean)) return std::nullopt;
    if (size < 1e-28) return mean;
  }
  return std::nullopt;
}

std::optional<Pose> mean_of(const PoseMixture& mixture) {
  std::vector<WeightedPose> means;
  for (const PoseComponent& one : mixture.components) means.push_back({one.weight, one.pose.mean});
  return mean_of(means);
}

std::optional<GaussianPose> gaussian_of(const PoseMixture& mixture) {
  if (mixture.components.size() == 1) return mixture.components.front().pose;
  const std::optional<Pose> mean = mean_of(mixture);
  if (!mean) return std::nullopt;
  Covariance S;
  for (const PoseComponent& one : mixture.components) add(S, one.weight, about(*mean, one.pose));
  return GaussianPose{*mean, symmetric(S)};
}

double density(const PoseMixture& mixture, const Pose& at) {
  double sum = 0;
  for (const PoseComponent& one : mixture.components) {
    const Factored S(one.pose.covariance);
    const double square = S.square_length(between(one.pose.mean, at));
    sum += one.weight *
           std::exp(-0.5 * (square + S.log_determinant() + 6 * std::log(2 * std::numbers::pi)));
  }
  return sum;
}

Pose mode_of(const PoseMixture& mixture) {
  const Pose* best = &mixture.components.front().pose.mean;
  double highest = -1;
  for (const PoseComponent& one : mixture.components) {
    const double there = density(mixture, one.pose.mean);
    if (there > highest) highest = there, best = &one.pose.mean;
  }
  return *best;
}

}  // namespace sinew::world
