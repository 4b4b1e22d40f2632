// Momentum, motion between frames and coordinates of rotation, beside dense algebra and Eigen.
#include "sinew/math/relative_motion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "sinew/math/momentum.h"

namespace sinew::math {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

class Random {
 public:
  double number() { return std::uniform_real_distribution<>(-1, 1)(generator_); }
  Vector3<double> vector() { return {number(), number(), number()}; }
  Quaterniond quaternion() {
    return Quaterniond(number(), number(), number(), number()).normalized();
  }

 private:
  std::mt19937 generator_{5};
};

Pose<double> pose(const Quaterniond& q, const Vector3<double>& p) {
  const Matrix3d R = q.toRotationMatrix();
  return {{R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)}, p};
}

Vector3d dense(const Vector3<double>& v) { return {v.x, v.y, v.z}; }

void expect_quaternion_of(Quaterniond q) {
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const FloatingPosition<double> X = position_and_quaternion(pose(q, {1, 2, 3}));
  EXPECT_NEAR(X.v.x, q.x(), 1e-14);
  EXPECT_NEAR(X.v.y, q.y(), 1e-14);
  EXPECT_NEAR(X.v.z, q.z(), 1e-14);
  EXPECT_NEAR(X.w, q.w(), 1e-14);
  EXPECT_EQ(X.p.y, 2);
}

TEST(Quaternion, IsReadOffAnyRotation) {
  Random random;
  for (int i = 0; i < 1000; ++i) expect_quaternion_of(random.quaternion());
}

// Half turns: the scalar part is zero, and each of the others may be the largest.
TEST(Quaternion, IsReadOffNearHalfTurns) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    Quaterniond q = random.quaternion();
    q.w() = 1e-9;
    expect_quaternion_of(q.normalized());
  }
  expect_quaternion_of(Quaterniond(1, 0, 0, 0));
}

TEST(Quaternion, RatesAreHalfTheAngularVelocityTimesIt) {
  Random random;
  for (int i = 0; i < 100; ++i) {
    const Quaterniond q = random.quaternion();
    const VelocityTwist<double> V = {random.vector(), random.vector()};
    const auto rate = quaternion_rates(
        FloatingPosition<double>{random.vector(), {q.x(), q.y(), q.z()}, q.w()}, V);
    const Quaterniond omega(0, V.angular.x, V.angular.y, V.angular.z);
    const Quaterniond expected = omega * q;
    EXPECT_NEAR(rate.w, 0.5 * expected.w(), 1e-15);
    EXPECT_NEAR(rate.v.x, 0.5 * expected.x(), 1e-15);
    EXPECT_NEAR(rate.v.y, 0.5 * expected.y(), 1e-15);
    EXPECT_NEAR(rate.v.z, 0.5 * expected.z(), 1e-15);
    EXPECT_EQ(rate.p.x, V.linear.x);
  }
}

// A cloud of points with these masses: momentum is what the points have.
TEST(Momentum, IsThatOfTheBodysPoints) {
  Random random;
  for (int i = 0; i < 20; ++i) {
    RigidBodyInertia<double> I;
    const VelocityTwist<double> V = {random.vector(), random.vector()};
    Vector3d angular = Vector3d::Zero(), linear = Vector3d::Zero();
    double energy = 0;
    for (int k = 0; k < 10; ++k) {
      const double m = 1 + random.number();
      const Vector3<double> r = random.vector();
      I = add(I, RigidBodyInertia<double>{
                     m,
                     {m * r.x, m * r.y, m * r.z},
                     {m * (r.y * r.y + r.z * r.z), -m * r.x * r.y, -m * r.x * r.z,
                      m * (r.x * r.x + r.z * r.z), -m * r.y * r.z, m * (r.x * r.x + r.y * r.y)}});
      const Vector3d v = dense(V.linear) + dense(V.angular).cross(dense(r));
      linear += m * v;
      angular += dense(r).cross(m * v);
      energy += 0.5 * m * v.squaredNorm();
    }
    const Momentum<double> P = momentum(I, V);
    EXPECT_LT((dense(P.angular) - angular).norm(), 1e-12);
    EXPECT_LT((dense(P.linear) - linear).norm(), 1e-12);
    EXPECT_NEAR(kinetic_energy(V, P), energy, 1e-12);
    const Vector3<double> c = center_of_mass(I);
    EXPECT_LT((dense(about(P, c).angular) - (angular - dense(c).cross(linear))).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace sinew::math
