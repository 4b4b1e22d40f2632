#include "sinew/world/pose_distribution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sinew/world/refuse.h"

namespace sinew::world {
namespace {

constexpr std::string_view kKinds[] = {"exact", "gaussian", "mixture", "particles"};

PoseMixture as_mixture(const PoseDistribution& X) {
  if (const auto* mixture = std::get_if<PoseMixture>(&X)) return *mixture;
  if (const auto* gaussian = std::get_if<GaussianPose>(&X)) return {{{1, *gaussian}}};
  return {{{1, {std::get<Pose>(X), {}}}}};
}

std::uint64_t seed_of(const CombineOptions& options) {
  if (!options.seed) {
    refuse({}, "particles composed with something uncertain, and no seed for what is drawn",
           "CombineOptions::seed; or Pairs::kPaired for two sets that belong together");
  }
  return *options.seed;
}

PoseDistribution with_particles(const PoseDistribution& X_AB, const PoseDistribution& X_BC,
                                const CombineOptions& options) {
  const auto* a = std::get_if<PoseParticles>(&X_AB);
  const auto* b = std::get_if<PoseParticles>(&X_BC);
  if (a && b) {
    if (options.pairs == Pairs::kPaired) return compose_by_pairing(*a, *b);
    const std::size_t count =
        options.particles ? options.particles : std::max(a->particles.size(), b->particles.size());
    return compose_by_sampling(*a, *b, count, seed_of(options));
  }
  if (a) {
    if (const auto* exact = std::get_if<Pose>(&X_BC)) return compose(*a, *exact);
    return compose(*a, as_mixture(X_BC), seed_of(options));
  }
  if (const auto* exact = std::get_if<Pose>(&X_AB)) return compose(*exact, *b);
  return compose(as_mixture(X_AB), *b, seed_of(options));
}

void put(const Pose& X, std::vector<double>& numbers) {
  numbers.insert(numbers.end(), {X.q.x, X.q.y, X.q.z, X.q.w, X.p.x, X.p.y, X.p.z});
}

// Numbers one after the other; `whole` tells whether there were enough.
struct Numbers {
  std::span<const double> rest;
  bool whole = true;
  double next() {
    if (rest.empty()) {
      whole = false;
      return 0;
    }
    const double number = rest.front();
    rest = rest.subspan(1);
    return number;
  }
  Pose pose() {
    std::array<double, 7> n;
    for (double& number : n) number = next();
    Pose X{{n[0], n[1], n[2], n[3]}, {n[4], n[5], n[6]}};
    normalise(X);  // where it is none, fault_of will say so
    return X;
  }
  Covariance covariance() {
    Covariance S;
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = i; j < 6; ++j) S(i, j) = S(j, i) = next();
    }
    return S;
  }
};

}  // namespace

std::string_view kind_of(const PoseDistribution& distribution) {
  return kKinds[distribution.index()];
}

std::optional<std::string> fault_of(const PoseDistribution& distribution) {
  if (const auto* particles = std::get_if<PoseParticles>(&distribution))
    return fault_of(*particles);
  return fault_of(as_mixture(distribution));
}

PoseDistribution compose(const PoseDistribution& X_AB, const PoseDistribution& X_BC,
                         const CombineOptions& options) {
  const std::size_t kind = std::max(X_AB.index(), X_BC.index());
  if (kind == 3) return with_particles(X_AB, X_BC, options);
  if (kind == 2) {
    return compose(as_mixture(X_AB), as_mixture(X_BC), options.components, options.order);
  }
  const auto* a = std::get_if<Pose>(&X_AB);
  const auto* b = std::get_if<Pose>(&X_BC);
  if (a && b) return compose(*a, *b);
  if (a) return compose(*a, std::get<GaussianPose>(X_BC));
  if (b) return compose(std::get<GaussianPose>(X_AB), *b);
  return compose(std::get<GaussianPose>(X_AB), std::get<GaussianPose>(X_BC), options.order);
}

PoseDistribution invert(const PoseDistribution& X_AB) {
  return std::visit([](const auto& X) -> PoseDistribution { return invert(X); }, X_AB);
}

std::optional<GaussianPose> gaussian_of(const PoseDistribution& distribution) {
  if (const auto* particles = std::get_if<PoseParticles>(&distribution)) {
    return gaussian_of(*particles);
  }
  return gaussian_of(as_mixture(distribution));
}

double total_deviation(const PoseDistribution& distribution) {
  const std::optional<GaussianPose> X = gaussian_of(distribution);
  if (!X) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    sum += X->covariance(i, i) * (i < 3 ? kLever * kLever : 1);
  }
  return std::sqrt(sum);
}

std::vector<double> to_numbers(const PoseDistribution& distribution, std::size_t size) {
  if (const auto fault = fault_of(distribution)) {
    refuse({}, "a " + std::string(kind_of(distribution)) + " that is none: " + *fault,
           "a distribution of a pose");
  }
  std::vector<double> numbers = {static_cast<double>(distribution.index()), 0};
  if (const auto* particles = std::get_if<PoseParticles>(&distribution)) {
    numbers[1] = static_cast<double>(particles->particles.size());
    for (const WeightedPose& one : particles->particles) {
      numbers.push_back(one.weight);
      put(one.pose, numbers);
    }
  } else {
    const PoseMixture mixture = as_mixture(distribution);
    numbers[1] = static_cast<double>(mixture.components.size());
    for (const PoseComponent& one : mixture.components) {
      numbers.push_back(one.weight);
      put(one.pose.mean, numbers);
      for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = i; j < 6; ++j) numbers.push_back(one.pose.covariance(i, j));
      }
    }
  }
  if (numbers.size() > size) {
    refuse({},
           "a distribution of " + std::to_string(numbers.size()) + " numbers where " +
               std::to_string(size) + " have room",
           "reduce or resample it, or a measurement of more numbers");
  }
  numbers.resize(size, 0.0);
  return numbers;
}

std::optional<PoseDistribution> from_numbers(std::span<const double> numbers) {
  Numbers from{numbers};
  const double kind = from.next(), count = from.next();
  // Also false for what is not a number.
  if (!(kind >= 0 && kind <= 3 && count >= 1 && count <= kMaximumParticles)) return std::nullopt;
  if (kind != std::floor(kind) || count != std::floor(count)) return std::nullopt;
  const auto many = static_cast<std::size_t>(count);
  PoseDistribution result;
  if (kind == 3) {
    PoseParticles set;
    for (std::size_t i = 0; i < many && from.whole; ++i) {
      const double weight = from.next();
      set.particles.push_back({weight, from.pose()});
    }
    result = std::move(set);
  } else {
    if (many > kMaximumComponents || (kind < 2 && many != 1)) return std::nullopt;
    PoseMixture mixture;
    for (std::size_t i = 0; i < many && from.whole; ++i) {
      const double weight = from.next();
      const Pose mean = from.pose();
      mixture.components.push_back({weight, {mean, from.covariance()}});
    }
    if (kind == 2) {
      result = std::move(mixture);
    } else if (kind == 1) {
      result = mixture.components.front().pose;
    } else {
      result = mixture.components.front().pose.mean;
    }
  }
  if (!from.whole || fault_of(result)) return std::nullopt;
  return result;
}

}  // namespace sinew::world
