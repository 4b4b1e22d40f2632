// A pose as a bounded set of weighted guesses: for what is neither one Gaussian nor a few, as the
// result of a particle filter.
//
// Whatever draws numbers takes a seed, and gives the same set for the same seed on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sinew/world/pose_mixture.h"

namespace sinew::world {

inline constexpr std::size_t kMaximumParticles = 4096;

struct PoseParticles {
  std::vector<WeightedPose> particles;  // of X_AB; weights add up to 1
};

// What keeps it from being one: as of a mixture, and 1 to kMaximumParticles; weights may be zero.
std::optional<std::string> fault_of(const PoseParticles& set);

// Preconditions of all that follows: fault_of is nothing.
PoseParticles compose(const Pose& X_AB, const PoseParticles& X_BC);
PoseParticles compose(const PoseParticles& X_AB, const Pose& X_BC);
PoseParticles invert(const PoseParticles& X_AB);

// Each particle with a draw of its own of the other, of which there is a draw for every particle.
// Weights stay.
PoseParticles compose(const PoseParticles& X_AB, const PoseMixture& X_BC, std::uint64_t seed);
PoseParticles compose(const PoseMixture& X_AB, const PoseParticles& X_BC, std::uint64_t seed);

// Two independent sets: `count` pairs, each particle in as many as its weight says (systematic, in
// random order), all of equal weight. Error unless 1 <= count <= kMaximumParticles.
PoseParticles compose_by_sampling(const PoseParticles& X_AB, const PoseParticles& X_BC,
                                  std::size_t count, std::uint64_t seed);
// The first with the first, and so on, weights multiplied: for sets whose particles of the same
// number belong together (X_AB and X_BC of the same hypothesis), or that are in random order. Error
// when the sizes differ, or no pair has a weight.
PoseParticles compose_by_pairing(const PoseParticles& X_AB, const PoseParticles& X_BC);

// Systematic resampling: `count` particles of equal weight, of each floor or ceil of count times
// its weight (Kitagawa 1996). Error as above.
PoseParticles resample(const PoseParticles& set, std::size_t count, std::uint64_t seed);
// 1 / sum w^2: how many of equal weight would be as good. Small: time to resample.
double effective_size(const PoseParticles& set);

// Draws. Error as above.
PoseParticles draw(const PoseMixture& mixture, std::size_t count, std::uint64_t seed);

// Mean as of a mixture's means, and the covariance about it. Nothing where there is no mean.
std::optional<GaussianPose> gaussian_of(const PoseParticles& set);

}  // namespace sinew::world
