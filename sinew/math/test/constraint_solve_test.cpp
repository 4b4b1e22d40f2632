// Magnitudes of constraint forces beside Eigen's decompositions; and what the policies promise
// where constraints depend on each other or cannot be moved.
#include "sinew/math/constraint_solve.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "sinew/math/hybrid_dynamics.h"

namespace sinew::math {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

ConstraintSystem<double> system(const MatrixXd& L, const VectorXd& r) {
  ConstraintSystem<double> result;
  result.count = static_cast<int>(r.size());
  for (int i = 0; i < result.count; ++i) {
    result.r[i] = r(i);
    for (int j = 0; j <= i; ++j) result.L[i][j] = L(i, j);
  }
  return result;
}

template <typename Solve>
VectorXd solve(Solve method, const MatrixXd& L, const VectorXd& r, double number) {
  ConstraintSystem<double> s = system(L, r);
  VectorXd x(r.size());
  method(s, number, x.data());
  return x;
}

// J J^T with rows of very different size, as linear and angular constraints have.
MatrixXd coupling(int constraints, int joints, unsigned seed) {
  std::srand(seed);
  MatrixXd J = MatrixXd::Random(constraints, joints);
  for (int i = 0; i < constraints; ++i) J.row(i) *= std::pow(10.0, i % 3);
  return J * J.transpose();
}

TEST(ConstraintSolve, AllPoliciesAgreeWithEigenWhereNothingIsSingular) {
  for (int n = 1; n <= kMostTruncatedConstraints; ++n) {
    SCOPED_TRACE(n);
    const MatrixXd L = coupling(n, n + 5, n);
    const VectorXd r = VectorXd::Random(n), expected = L.ldlt().solve(r);
    const double scale = expected.lpNorm<Eigen::Infinity>();
    EXPECT_LT((solve(solve_in_order<double>, L, r, 1e-10) - expected).norm(), 1e-9 * scale);
    EXPECT_LT((solve(solve_truncated<double>, L, r, 1e-10) - expected).norm(), 1e-9 * scale);
    EXPECT_LT((solve(solve_damped<double>, L, r, 1e-7) - expected).norm(), 1e-6 * scale);
  }
  const int most = kMostConstraints;
  const MatrixXd L = coupling(most, most + 10, 7);
  const VectorXd r = VectorXd::Random(most), expected = L.ldlt().solve(r);
  EXPECT_LT((solve(solve_in_order<double>, L, r, 1e-10) - expected).norm(), 1e-8 * expected.norm());
}

TEST(ConstraintSolve, InOrderMeetsTheFirstAndDropsWhatDependsOnThem) {
  MatrixXd J = MatrixXd::Random(4, 6);
  J.row(2) = 2 * J.row(0) - J.row(1);  // the third says nothing new
  const MatrixXd L = J * J.transpose();
  const VectorXd r = VectorXd::Random(4);  // and contradicts
  const VectorXd x = solve(solve_in_order<double>, L, r, 1e-9);
  EXPECT_EQ(x(2), 0);
  const VectorXd met = L * x - r;
  for (const int i : {0, 1, 3}) EXPECT_NEAR(met(i), 0, 1e-10);
}

TEST(ConstraintSolve, TruncatedIsThePseudoInverseOfTheScaledMatrix) {
  for (int rank = 0; rank <= 6; ++rank) {
    SCOPED_TRACE(rank);
    MatrixXd J = MatrixXd::Random(6, std::max(rank, 1));
    if (rank == 0) J.setZero();
    const MatrixXd L = J * J.transpose();
    const VectorXd r = VectorXd::Random(6);
    VectorXd s = VectorXd::Zero(6);
    for (int i = 0; i < 6; ++i) s(i) = L(i, i) > 0 ? 1 / std::sqrt(L(i, i)) : 0;
    const MatrixXd scaled = s.asDiagonal() * L * s.asDiagonal();
    Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scaled);
    VectorXd inverse = eigen.eigenvalues();
    for (double& value : inverse) value = value > 1e-9 ? 1 / value : 0;
    const MatrixXd V = eigen.eigenvectors();
    const VectorXd expected =
        s.asDiagonal() * (V * (inverse.asDiagonal() * (V.transpose() * (s.asDiagonal() * r))));
    const VectorXd x = solve(solve_truncated<double>, L, r, 1e-9);
    EXPECT_LT((x - expected).norm(), 1e-7 * (1 + expected.norm()));
  }
}

TEST(ConstraintSolve, DampedIsTheLeastOfResidualAndMagnitudes) {
  MatrixXd J = MatrixXd::Random(5, 3);  // singular
  const MatrixXd L = J * J.transpose();
  const VectorXd r = VectorXd::Random(5);
  const double damping = 0.01;
  const VectorXd s = L.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd A = s.asDiagonal() * L * s.asDiagonal();
  // |A y - r|^2 + damping^2 |y|^2 as one least-squares problem, solved by orthogonal factors.
  MatrixXd stacked(10, 5);
  stacked << A, damping * MatrixXd::Identity(5, 5);
  VectorXd right = VectorXd::Zero(10);
  right.head(5) = s.asDiagonal() * r;
  const VectorXd expected = s.asDiagonal() * stacked.colPivHouseholderQr().solve(right);
  EXPECT_LT((solve(solve_damped<double>, L, r, damping) - expected).norm(), 1e-9 * expected.norm());
}

TEST(ConstraintSolve, WhatCannotMoveGetsNoForceAndNothingIsEverNotANumber) {
  MatrixXd L = MatrixXd::Zero(3, 3);
  L(1, 1) = 2;
  const VectorXd r = VectorXd::Constant(3, 1);
  const VectorXd expected = Eigen::Vector3d(0, 0.5, 0);
  EXPECT_LT((solve(solve_in_order<double>, L, r, 1e-9) - expected).norm(), 1e-15);
  EXPECT_LT((solve(solve_truncated<double>, L, r, 1e-9) - expected).norm(), 1e-15);
  EXPECT_LT((solve(solve_damped<double>, L, r, 1e-6) - expected).norm(), 1e-9);
}

double share(std::vector<double> rest, std::vector<double> scaled, std::vector<double> limit) {
  return scale_within_limits<double>(
      static_cast<int>(rest.size()), [&](int j) { return rest[j]; },
      [&](int j) { return scaled[j]; }, [&](int j) { return limit[j]; });
}

TEST(ScaleWithinLimits, IsTheLargestShareThatSaturatesNoActuator) {
  EXPECT_EQ(share({1, -1}, {1, -2}, {3, 4}), 1);      // nothing saturates
  EXPECT_EQ(share({1, -1}, {4, -2}, {3, 4}), 0.5);    // the first does
  EXPECT_EQ(share({1, -1}, {4, -12}, {3, 4}), 0.25);  // and the second earlier
  EXPECT_EQ(share({1}, {-8}, {3}), 0.5);              // the other way
  EXPECT_EQ(share({4}, {-2}, {3}), 1);                // it takes load off
  EXPECT_EQ(share({4}, {-14}, {3}), 0.5);             // it takes too much off
}

TEST(ScaleWithinLimits, IsZeroWhereNoShareHelps) {
  EXPECT_EQ(share({4}, {2}, {3}), 0);            // saturated already, and it makes it worse
  EXPECT_EQ(share({4}, {0}, {3}), 0);            // and it has no effect
  EXPECT_EQ(share({4, 0}, {-2, 8}, {3, 3}), 0);  // what one needs is too much for the other
  EXPECT_EQ(share({3}, {0}, {3}), 1);            // at the limit is within it
}

}  // namespace
}  // namespace sinew::math
