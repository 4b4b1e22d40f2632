#include "sinew/world/pose_particles.h"

#include <cmath>
#include <numbers>
#include <random>

#include "sinew/world/matrix6.h"
#include "sinew/world/refuse.h"

namespace sinew::world {
namespace {

// The generator is the same everywhere; the standard library's distributions are not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  // In [0, 1).
  double uniform() { return static_cast<double>(generator_() >> 11) * 0x1p-53; }
  // Box and Muller 1958, one of the two.
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(generator_() % count); }

 private:
  std::mt19937_64 generator_;
};

// Draws of a mixture, with the roots of its covariances taken once.
class Source {
 public:
  explicit Source(const PoseMixture& of) : of_(of) {
    for (const PoseComponent& one : of.components) roots_.push_back(root_of(one.pose.covariance));
  }
  Pose operator()(Random& random) const {
    double rest = random.uniform();
    std::size_t which = 0;
    while (which + 1 < roots_.size() && rest >= of_.components[which].weight) {
      rest -= of_.components[which++].weight;
    }
    Vector6 unit;
    for (double& number : unit) number = random.normal();
    return compose(of_.components[which].pose.mean, exponential(twist_of(roots_[which] * unit), 1));
  }

 private:
  const PoseMixture& of_;
  std::vector<Matrix6> roots_;
};

void check_count(std::size_t count) {
  if (count == 0 || count > kMaximumParticles) {
    refuse({}, "a set of " + std::to_string(count) + " particles",
           "1 to " + std::to_string(kMaximumParticles));
  }
}

// The numbers of `count` particles, each as often as its weight says.
std::vector<std::size_t> systematic(const PoseParticles& set, std::size_t count, Random& random) {
  std::vector<std::size_t> chosen;
  const double offset = random.uniform();
  double reached = 0;  // sum of the weights up to and with `which`
  std::size_t which = 0;
  reached = set.particles[0].weight;
  for (std::size_t i = 0; i < count; ++i) {
    const double at = (static_cast<double>(i) + offset) / static_cast<double>(count);
    while (at >= reached && which + 1 < set.particles.size()) {
      reached += set.particles[++which].weight;
    }
    chosen.push_back(which);
  }
  return chosen;
}

void shuffle(std::vector<std::size_t>& numbers, Random& random) {
  for (std::size_t i = numbers.size(); i > 1; --i) {
    std::swap(numbers[i - 1], numbers[random.below(i)]);
  }
}

}  // namespace

std::optional<std::string> fault_of(const PoseParticles& set) {
  const std::size_t count = set.particles.size();
  if (count == 0 || count > kMaximumParticles) {
    return "it has " + std::to_string(count) + " particles, not 1 to " +
           std::to_string(kMaximumParticles);
  }
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const WeightedPose& one = set.particles[i];
    if (!std::isfinite(one.weight) || one.weight < 0) {
      return "particle " + std::to_string(i) + " has the weight " + std::to_string(one.weight) +
             ", which is negative or no number";
    }
    Pose pose = one.pose;
    if (!normalise(pose)) return "particle " + std::to_string(i) + " is no pose";
    sum += one.weight;
  }
  if (std::abs(sum - 1) > kWeightTolerance) {
    return "its weights add up to " + std::to_string(sum) + ", not to 1";
  }
  return std::nullopt;
}

PoseParticles compose(const Pose& X_AB, const PoseParticles& X_BC) {
  PoseParticles result = X_BC;
  for (WeightedPose& one : result.particles) one.pose = compose(X_AB, one.pose);
  return result;
}

PoseParticles compose(const PoseParticles& X_AB, const Pose& X_BC) {
  PoseParticles result = X_AB;
  for (WeightedPose& one : result.particles) one.pose = compose(one.pose, X_BC);
  return result;
}

PoseParticles invert(const PoseParticles& X_AB) {
  PoseParticles result = X_AB;
  for (WeightedPose& one : result.particles) one.pose = invert(one.pose);
  return result;
}

PoseParticles compose(const PoseParticles& X_AB, const PoseMixture& X_BC, std::uint64_t seed) {
  Random random(seed);
  const Source source(X_BC);
  PoseParticles result = X_AB;
  for (WeightedPose& one : result.particles) one.pose = compose(one.pose, source(random));
  return result;
}

PoseParticles compose(const PoseMixture& X_AB, const PoseParticles& X_BC, std::uint64_t seed) {
  Random random(seed);
  const Source source(X_AB);
  PoseParticles result = X_BC;
  for (WeightedPose& one : result.particles) one.pose = compose(source(random), one.pose);
  return result;
}

PoseParticles compose_by_sampling(const PoseParticles& X_AB, const PoseParticles& X_BC,
                                  std::size_t count, std::uint64_t seed) {
  check_count(count);
  Random random(seed);
  std::vector<std::size_t> a = systematic(X_AB, count, random);
  std::vector<std::size_t> b = systematic(X_BC, count, random);
  // One of the two in random order is enough for independent pairs.
  shuffle(b, random);
  PoseParticles result;
  for (std::size_t i = 0; i < count; ++i) {
    result.particles.push_back({1 / static_cast<double>(count),
                                compose(X_AB.particles[a[i]].pose, X_BC.particles[b[i]].pose)});
  }
  return result;
}

PoseParticles compose_by_pairing(const PoseParticles& X_AB, const PoseParticles& X_BC) {
  if (X_AB.particles.size() != X_BC.particles.size()) {
    refuse({},
           "pairs of sets of " + std::to_string(X_AB.particles.size()) + " and " +
               std::to_string(X_BC.particles.size()) + " particles",
           "sets of the same size, or compose_by_sampling");
  }
  PoseParticles result;
  double sum = 0;
  for (std::size_t i = 0; i < X_AB.particles.size(); ++i) {
    const WeightedPose& a = X_AB.particles[i];
    const WeightedPose& b = X_BC.particles[i];
    result.particles.push_back({a.weight * b.weight, compose(a.pose, b.pose)});
    sum += a.weight * b.weight;
  }
  if (!(sum > 0)) {
    refuse({}, "pairs of particles of which none has a weight",
           "sets whose particles belong together");
  }
  for (WeightedPose& one : result.particles) one.weight /= sum;
  return result;
}

PoseParticles resample(const PoseParticles& set, std::size_t count, std::uint64_t seed) {
  check_count(count);
  Random random(seed);
  PoseParticles result;
  for (const std::size_t which : systematic(set, count, random)) {
    result.particles.push_back({1 / static_cast<double>(count), set.particles[which].pose});
  }
  return result;
}

double effective_size(const PoseParticles& set) {
  double sum = 0;
  for (const WeightedPose& one : set.particles) sum += one.weight * one.weight;
  return 1 / sum;
}

PoseParticles draw(const PoseMixture& mixture, std::size_t count, std::uint64_t seed) {
  check_count(count);
  Random random(seed);
  const Source source(mixture);
  PoseParticles result;
  for (std::size_t i = 0; i < count; ++i) {
    result.particles.push_back({1 / static_cast<double>(count), source(random)});
  }
  return result;
}

std::optional<GaussianPose> gaussian_of(const PoseParticles& set) {
  const std::optional<Pose> mean = mean_of(set.particles);
  if (!mean) return std::nullopt;
  GaussianPose result{*mean, {}};
  for (const WeightedPose& one : set.particles) {
    add_square(result.covariance, one.weight, between(*mean, one.pose));
  }
  return result;
}

}  // namespace sinew::world
