// What is known of a pose: exactly that, one Gaussian, a mixture of them, or particles. Any may be
// composed with any; the result is of the kind that can hold it:
//
//              exact       Gaussian    mixture     particles
//   exact      exact       Gaussian    mixture     particles
//   Gaussian   Gaussian    Gaussian    mixture     particles, drawn
//   mixture    mixture     mixture     mixture     particles, drawn
//   particles  particles   drawn       drawn       drawn, or paired
//
// What is drawn needs a seed; without one it is refused, for nothing here draws in secret.
//
// A distribution can be written as numbers, beside the pose that it is about and at the same
// instant (World::write_together): see `to_numbers`, and Uncertainties::set_measured
// (uncertain_path.h).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sinew/world/pose_mixture.h"
#include "sinew/world/pose_particles.h"

namespace sinew::world {

// Alternatives in the order of the table: the later can hold what the earlier says.
using PoseDistribution = std::variant<Pose, GaussianPose, PoseMixture, PoseParticles>;

std::string_view kind_of(const PoseDistribution& distribution);  // "exact", "gaussian", …
std::optional<std::string> fault_of(const PoseDistribution& distribution);

enum class Pairs : std::uint8_t { kSampled, kPaired };  // of two sets of particles

struct CombineOptions {
  Order order = Order::kFourth;
  std::size_t components = kMaximumComponents;  // of a mixture, at most
  std::optional<std::uint64_t> seed = {};       // for what is drawn
  Pairs pairs = Pairs::kSampled;
  std::size_t particles = 0;  // of kSampled; 0: as many as the larger set
};

// Throws Error where particles meet something uncertain and there is no seed (and not kPaired).
PoseDistribution compose(const PoseDistribution& X_AB, const PoseDistribution& X_BC,
                         const CombineOptions& options = {});
PoseDistribution invert(const PoseDistribution& X_AB);

// Of mixtures and particles the one Gaussian with the same mean and covariance; nothing where there
// is no mean.
std::optional<GaussianPose> gaussian_of(const PoseDistribution& distribution);

// One number for how uncertain it is [m], for policies that choose: the root of the variances along
// the axes and, with kLever for a radian, about them. What has no mean is infinitely uncertain.
inline constexpr double kLever = 1.0;  // [m]
double total_deviation(const PoseDistribution& distribution);

// ---- as numbers: kind, how many, and for each component its weight, its pose (quaternion, point)
// and, of Gaussians, the upper triangle of the covariance by rows; then zeros ----

// How many numbers so many components, or particles, need at most.
constexpr std::uint32_t numbers_of_components(std::size_t count) {
  return static_cast<std::uint32_t>(2 + 29 * count);
}
constexpr std::uint32_t numbers_of_particles(std::size_t count) {
  return static_cast<std::uint32_t>(2 + 8 * count);
}
// Throws Error when `size` numbers are not enough, or the distribution is none.
std::vector<double> to_numbers(const PoseDistribution& distribution, std::size_t size);
// Nothing when the numbers are no distribution.
std::optional<PoseDistribution> from_numbers(std::span<const double> numbers);

}  // namespace sinew::world
