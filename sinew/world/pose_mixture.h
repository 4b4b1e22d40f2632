// A pose that may be one thing or another: a weighted sum of Gaussians on SE(3), as several
// hypotheses of a detector, or a part that lies on one side or the other.
//
// Components are independent hypotheses; those of X_AB are Gaussians of X_AB. What is composed has
// a component for each pair. That grows, so there are at most kMaximumComponents, or as many as the
// caller wants; beyond, the two whose merging costs least become one, again and again:
//
//   which   the least B(i, j) = ((w_i + w_j) log|S_ij| - w_i log|S_i| - w_j log|S_j|) / 2, an upper
//           bound of what is lost in the sense of Kullback and Leibler (Runnalls 2007,
//           "Kullback-Leibler approach to Gaussian mixture reduction", IEEE T-AES 43(3), eq. 21)
//           with S_ij as below, but without the Jacobians, which hardly change the choice
//   how     weight, mean and covariance of the two together stay what they were. The mean is the
//           point on the geodesic between them by their weights, the covariance taken there: the
//           spread of the means, and each covariance carried by the right Jacobian (first order)
//
// What is exactly known counts as kNarrowest wide for the choice (matrix6.h), not in the result.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sinew/world/gaussian_pose.h"

namespace sinew::world {

inline constexpr std::size_t kMaximumComponents = 64;
// Factors of a product with more pairs than this squared are reduced to so many each beforehand.
inline constexpr std::size_t kMaximumFactor = 32;
inline constexpr double kWeightTolerance = 1e-9;  // of the sum of the weights, which is 1

struct PoseComponent {
  double weight = 1;
  GaussianPose pose;
};

struct PoseMixture {
  std::vector<PoseComponent> components;
};

// What keeps it from being one: nothing where the weights are positive and add up to 1, every mean
// is a pose and every covariance one, and there are 1 to kMaximumComponents.
std::optional<std::string> fault_of(const PoseMixture& mixture);

// Preconditions of all that follows: fault_of is nothing. 1 <= most <= kMaximumComponents, or
// Error.
PoseMixture compose(const PoseMixture& X_AB, const PoseMixture& X_BC,
                    std::size_t most = kMaximumComponents, Order order = Order::kFourth);
PoseMixture compose(const Pose& X_AB, const PoseMixture& X_BC);
PoseMixture compose(const PoseMixture& X_AB, const Pose& X_BC);
PoseMixture invert(const PoseMixture& X_AB);
PoseMixture reduce(PoseMixture mixture, std::size_t most);

// The pose mu with sum w_i log(mu^-1 X_i) = 0 over the means, the exponential barycenter (Pennec
// and Arsigny 2013), which moves with the frames and turns with inversion. Nothing where the
// iteration does not settle within kMeanIterations: rotations half a turn apart have no mean.
inline constexpr int kMeanIterations = 200;
std::optional<Pose> mean_of(const PoseMixture& mixture);
// The same for any weighted poses; weights add up to 1.
struct WeightedPose {
  double weight = 1;
  Pose pose;
};
std::optional<Pose> mean_of(const std::vector<WeightedPose>& poses);

// One Gaussian with the same mean and covariance. Nothing where there is no mean.
std::optional<GaussianPose> gaussian_of(const PoseMixture& mixture);
// The mean of that component at which the mixture is densest.
Pose mode_of(const PoseMixture& mixture);
// Density at a pose with respect to the twist seen from it [1 / (rad^3 m^3)].
double density(const PoseMixture& mixture, const Pose& at);

}  // namespace sinew::world
