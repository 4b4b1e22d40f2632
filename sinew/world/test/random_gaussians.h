// Gaussians for the tests, by Eigen: random covariances, draws, and what many draws say.
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <random>

#include "sinew/world/gaussian_pose.h"

namespace sinew::world {

using EigenMatrix6 = Eigen::Matrix<double, 6, 6>;
using EigenVector6 = Eigen::Matrix<double, 6, 1>;

inline EigenMatrix6 eigen(const Covariance& S) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(S.entries.data());
}
inline Covariance covariance(const EigenMatrix6& S) {
  Covariance result;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) result(i, j) = S(i, j);
  }
  return result;
}

// Correlated, with deviations of about these sizes.
inline Covariance random_covariance(std::mt19937_64& random, double angular, double linear) {
  std::normal_distribution<double> normal;
  EigenMatrix6 A;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) A(i, j) = normal(random) * (i < 3 ? angular : linear) / 2.5;
  }
  return covariance(A * A.transpose());
}

// Draws poses of a Gaussian.
struct Draw {
  explicit Draw(const GaussianPose& of) : mean(of.mean) {
    const Eigen::SelfAdjointEigenSolver<EigenMatrix6> solver(eigen(of.covariance));
    root = solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
  }
  Pose operator()(std::mt19937_64& random) const {
    std::normal_distribution<double> normal;
    EigenVector6 unit;
    for (int i = 0; i < 6; ++i) unit(i) = normal(random);
    const EigenVector6 xi = root * unit;
    return compose(mean, exponential({{xi(0), xi(1), xi(2)}, {xi(3), xi(4), xi(5)}}, 1.0));
  }
  Pose mean;
  EigenMatrix6 root;
};

// The mean square of log(mean^-1 X) over many draws of X.
inline Covariance monte_carlo(const Pose& mean, int draws, const std::function<Pose()>& draw) {
  EigenMatrix6 sum = EigenMatrix6::Zero();
  const Pose to_mean = invert(mean);
  for (int i = 0; i < draws; ++i) {
    const Twist t = logarithm(compose(to_mean, draw()));
    EigenVector6 xi;
    xi << t.angular.x, t.angular.y, t.angular.z, t.linear.x, t.linear.y, t.linear.z;
    sum += xi * xi.transpose();
  }
  return covariance(sum / draws);
}

// How far apart, relative to the size of the second (Frobenius), with angles and lengths weighed
// by the second's deviations, so that neither hides the other.
inline double apart(const Covariance& a, const Covariance& b) {
  const EigenVector6 scale = eigen(b).diagonal().cwiseMax(1e-30).cwiseSqrt().cwiseInverse();
  const EigenMatrix6 A = scale.asDiagonal() * eigen(a) * scale.asDiagonal();
  const EigenMatrix6 B = scale.asDiagonal() * eigen(b) * scale.asDiagonal();
  return (A - B).norm() / B.norm();
}

}  // namespace sinew::world
