// Poses against Eigen.
#include "sinew/world/pose.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "random_poses.h"

namespace sinew::world {
namespace {

Eigen::Isometry3d eigen(const Pose& X) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(X.q.w, X.q.x, X.q.y, X.q.z).toRotationMatrix();
  T.translation() = Eigen::Vector3d(X.p.x, X.p.y, X.p.z);
  return T;
}

double difference(const Pose& X, const Eigen::Isometry3d& T) {
  return (eigen(X).matrix() - T.matrix()).cwiseAbs().maxCoeff();
}

TEST(Pose, ComposesInvertsAndConverts) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000; ++i) {
    const Pose a = random_pose(random), b = random_pose(random);
    EXPECT_LT(difference(compose(a, b), eigen(a) * eigen(b)), 1e-14);
    EXPECT_LT(difference(invert(a), eigen(a).inverse()), 1e-14);
    EXPECT_LT(difference(compose_inverse(a, b), eigen(a) * eigen(b).inverse()), 1e-14);
    EXPECT_LT(difference(from_matrix(to_matrix(a)), eigen(a)), 1e-14);
  }
}

TEST(Pose, SlerpIsEigensForSmallAndLargeAngles) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> share(0, 1), size(-9, 0.3);
  for (int i = 0; i < 5000; ++i) {
    const Pose a = random_pose(random);
    Twist V = logarithm(random_pose(random));
    const double scale = std::pow(10.0, size(random)) / 3;
    V = {scale * V.angular, scale * V.linear};
    const Pose b = compose(a, exponential(V, 1));
    const double t = share(random);
    const Eigen::Quaterniond qa(a.q.w, a.q.x, a.q.y, a.q.z), qb(b.q.w, b.q.x, b.q.y, b.q.z);
    const Eigen::Quaterniond expected = qa.slerp(t, qb);
    const Pose result = slerp(a, b, t);
    const Eigen::Quaterniond got(result.q.w, result.q.x, result.q.y, result.q.z);
    // Eigen goes over to a linear blend near 1 and loses half the digits in acos.
    EXPECT_LT((expected.toRotationMatrix() - got.toRotationMatrix()).cwiseAbs().maxCoeff(), 2e-9);
    EXPECT_NEAR(got.norm(), 1, 1e-15);
    // The defining property: the angle from a is the share of the whole, to round-off.
    const Twist part = logarithm(compose(invert(a), result));
    const Twist whole = logarithm(compose(invert(a), b));
    EXPECT_NEAR(part.angular.x, t * whole.angular.x, 1e-14);
    EXPECT_NEAR(part.angular.y, t * whole.angular.y, 1e-14);
    EXPECT_NEAR(part.angular.z, t * whole.angular.z, 1e-14);
  }
}

TEST(Pose, ExponentialUndoesLogarithm) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 2000; ++i) {
    const Pose X = random_pose(random);
    EXPECT_LT(difference(exponential(logarithm(X), 1), eigen(X)), 1e-13);
    const Pose tiny = exponential({{1e-9, 2e-9, -1e-9}, {1, 2, 3}}, 1);
    EXPECT_LT(difference(exponential(logarithm(tiny), 1), eigen(tiny)), 1e-15);
  }
}

TEST(Pose, ScrewMovesAsAConstantTwistDoes) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 500; ++i) {
    const Pose a = random_pose(random);
    const Twist V = logarithm(random_pose(random));
    const Pose b = compose(a, exponential(V, 1));
    EXPECT_LT(difference(screw(a, b, 0.3), eigen(compose(a, exponential(V, 0.3)))), 1e-12);
  }
}

TEST(Pose, RefusesWhatIsNoRotation) {
  Pose bad{{0, 0, 0, 1.1}, {}};
  EXPECT_FALSE(normalise(bad));
  Pose far{{}, {NAN, 0, 0}};
  EXPECT_FALSE(normalise(far));
  Pose nearly{{0, 0, 1e-8, 1}, {}};
  EXPECT_TRUE(normalise(nearly));
  EXPECT_EQ(nearly.q.w, 1.0);
}

}  // namespace
}  // namespace sinew::world
