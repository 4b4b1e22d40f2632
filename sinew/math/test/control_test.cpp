// Control laws against references written here, and the logarithm of poses against Eigen.
#include "sinew/math/control.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <unsupported/Eigen/MatrixFunctions>

namespace sinew::math {
namespace {

Matrix3<double> matrix(const Eigen::Matrix3d& R) {
  return {R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)};
}

Eigen::Vector3d eigen(const Vector3<double>& v) { return {v.x, v.y, v.z}; }

Pose<double> pose(const Eigen::Isometry3d& X) {
  return {matrix(X.linear()), {X.translation().x(), X.translation().y(), X.translation().z()}};
}

Eigen::Matrix3d skew(const Eigen::Vector3d& w) {
  Eigen::Matrix3d S;
  S << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return S;
}

class Random {
 public:
  Eigen::Vector3d axis() {
    Eigen::Vector3d v(normal_(generator_), normal_(generator_), normal_(generator_));
    return v.normalized();
  }
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }

 private:
  std::mt19937 generator_{7};
  std::normal_distribution<double> normal_;
};

TEST(RotationVector, IsAxisTimesAngleFromZeroToHalfATurn) {
  Random random;
  const double angles[] = {0, 1e-12, 1e-9, 1e-6, 1e-3, 0.05, 0.0999, 0.1001, 0.5, 1, 2, 3, 3.14};
  for (const double angle : angles) {
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector3d axis = random.axis();
      const Eigen::Matrix3d R = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
      const Eigen::Vector3d found = eigen(rotation_vector(matrix(R)));
      // Close to half a turn the axis is as good as the entries of R allow.
      EXPECT_LT((found - angle * axis).norm(), 2e-15 * (1 + angle)) << angle;
    }
  }
}

TEST(RotationVector, TakesOneOfTheTwoAxesAtHalfATurn) {
  for (const Eigen::Vector3d axis :
       {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()}) {
    Eigen::Matrix3d R = 2 * axis * axis.transpose() - Eigen::Matrix3d::Identity();
    const Eigen::Vector3d found = eigen(rotation_vector(matrix(R)));
    EXPECT_NEAR(found.norm(), std::numbers::pi, 1e-15);
    EXPECT_NEAR(std::abs(found.dot(axis)), std::numbers::pi, 1e-15);
  }
}

// Eigen's matrix logarithm is made by other means (Schur, inverse scaling and squaring).
TEST(Logarithm, IsThatOfTheHomogeneousMatrix) {
  Random random;
  for (int i = 0; i < 200; ++i) {
    const double angle = i % 4 == 0 ? random(0, 0.2) : random(0, 3.0);
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.linear() = Eigen::AngleAxisd(angle, random.axis()).toRotationMatrix();
    X.translation() = Eigen::Vector3d(random(-1, 1), random(-1, 1), random(-1, 1));
    const Eigen::Matrix4d reference = X.matrix().log();
    const PoseError<double> e = logarithm(pose(X));
    EXPECT_LT((skew(eigen(e.angular)) - reference.topLeftCorner<3, 3>()).norm(), 1e-11);
    EXPECT_LT((eigen(e.linear) - reference.topRightCorner<3, 1>()).norm(), 1e-11);
  }
}

// The series and the closed form meet where one takes over from the other.
TEST(Logarithm, IsTheInverseOfTheExponentialWhereItsFormulasMeet) {
  Random random;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector3d phi = random(0.08, 0.12) * random.axis();
    const Eigen::Vector3d linear(random(-1, 1), random(-1, 1), random(-1, 1));
    const double t = phi.norm();
    const Eigen::Matrix3d S = skew(phi);
    const Eigen::Matrix3d V = Eigen::Matrix3d::Identity() + (1 - std::cos(t)) / (t * t) * S +
                              (t - std::sin(t)) / (t * t * t) * S * S;
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.linear() = Eigen::AngleAxisd(t, phi / t).toRotationMatrix();
    X.translation() = V * linear;
    const PoseError<double> e = logarithm(pose(X));
    EXPECT_LT((eigen(e.angular) - phi).norm(), 1e-15);
    EXPECT_LT((eigen(e.linear) - linear).norm(), 1e-12);
  }
}

TEST(PoseError, LeadsFromTheMeasuredFrameToTheDesiredOne) {
  Eigen::Isometry3d measured = Eigen::Isometry3d::Identity(), desired = measured;
  measured.linear() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  desired.linear() = Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const PoseError<double> turn = pose_error(pose(measured), pose(desired));
  EXPECT_NEAR(turn.angular.z, 0.3, 1e-15);
  desired = measured;
  desired.translation() = Eigen::Vector3d(1, 0, 0);
  const PoseError<double> move = pose_error(pose(measured), pose(desired));
  EXPECT_NEAR(move.linear.x, std::cos(0.5), 1e-15);
  EXPECT_NEAR(move.linear.y, -std::sin(0.5), 1e-15);
}

TEST(Damping, IsFullAtRestNothingAtTheMaximumAndBrakesBeyond) {
  EXPECT_EQ(damping_force(0.0, 0.1, 10.0), 10);
  EXPECT_NEAR(damping_force(0.1, 0.1, 10.0), 0, 1e-15);
  EXPECT_NEAR(damping_force(0.05, 0.1, 10.0), 5, 1e-15);
  EXPECT_LT(damping_force(0.11, 0.1, 10.0), 0);
  EXPECT_GT(damping_force(-0.05, 0.1, 10.0), 10);
}

TEST(DecayingIntegral, IsThePlainOneWithoutDecayAndSettlesWithIt) {
  double plain = 0, decaying = 0;
  for (int i = 0; i < 2000; ++i) {
    plain = decaying_integral(plain, 3.0, 0.0, 0.01);
    decaying = decaying_integral(decaying, 3.0, 2.0, 0.01);
  }
  EXPECT_NEAR(plain, 60, 1e-9);
  EXPECT_NEAR(decaying, 1.5, 1e-12);  // e / lambda
  for (int i = 0; i < 100; ++i) decaying = decaying_integral(decaying, 0.0, 2.0, 0.01);
  EXPECT_NEAR(decaying, 1.5 * std::pow(1.02, -100), 1e-12);
}

TEST(Rate, IsZeroInTheFirstCycleAndThenTheQuotient) {
  EXPECT_EQ(rate(5.0, 0.0, 0.0, 0.5), 0);
  EXPECT_EQ(rate(5.0, 4.0, 1.0, 0.5), 2);
}

TEST(Limited, KeepsTheSign) {
  EXPECT_EQ(limited(3.0, 2.0), 2);
  EXPECT_EQ(limited(-3.0, 2.0), -2);
  EXPECT_EQ(limited(-1.5, 2.0), -1.5);
}

TEST(AntiWindup, StopsTheIntegralOnlyWhileTheErrorDrivesTheControlOut) {
  struct Case {
    double error, control;
    bool kept;
  };
  for (const Case& one : {Case{1, 11, true}, Case{-1, 11, false}, Case{1, 9, false},
                          Case{-1, -11, true}, Case{1, -11, false}, Case{0, 11, false}}) {
    EXPECT_EQ(anti_windup(5.0, 6.0, one.error, 2.0, one.control, 10.0), one.kept ? 5 : 6)
        << one.error << " " << one.control;
    // A negative gain turns the meaning of the error.
    EXPECT_EQ(anti_windup(5.0, 6.0, -one.error, -2.0, one.control, 10.0), one.kept ? 5 : 6);
  }
}

TEST(ConstraintErrors, AreZeroWhereTheConstraintHoldsAndPointToIt) {
  EXPECT_EQ(error_of_equality(3.0, 5.0), 2);
  EXPECT_EQ(error_of_lower_bound(3.0, 5.0), 2);
  EXPECT_EQ(error_of_lower_bound(6.0, 5.0), 0);
  EXPECT_EQ(error_of_upper_bound(6.0, 5.0), -1);
  EXPECT_EQ(error_of_upper_bound(3.0, 5.0), 0);
  EXPECT_EQ(error_of_interval(0.0, 1.0, 2.0), 1);
  EXPECT_EQ(error_of_interval(1.5, 1.0, 2.0), 0);
  EXPECT_EQ(error_of_interval(2.5, 1.0, 2.0), -0.5);
}

TEST(Monitors, LevelHoldsWithinItsTolerance) {
  EXPECT_EQ(holds_within(0.1, 0.1), 1);
  EXPECT_EQ(holds_within(-0.1, 0.1), 1);
  EXPECT_EQ(holds_within(0.11, 0.1), 0);
  EXPECT_EQ(holds_within(-0.11, 0.1), 0);
  EXPECT_EQ(holds_within(0.0, 0.0), 1);
}

TEST(Monitors, HysteresisRemembersBetweenItsTwoTolerances) {
  for (const double before : {0.0, 1.0}) {
    EXPECT_EQ(holds_with_hysteresis(0.05, 0.1, 0.2, before), 1);
    EXPECT_EQ(holds_with_hysteresis(-0.15, 0.1, 0.2, before), before);
    EXPECT_EQ(holds_with_hysteresis(0.25, 0.1, 0.2, before), 0);
  }
}

TEST(Monitors, EdgesAndConnectivesFollowTheirTruthTables) {
  for (const double now : {0.0, 1.0})
    for (const double before : {0.0, 1.0}) {
      EXPECT_EQ(rising_edge(now, before), now == 1 && before == 0);
      EXPECT_EQ(falling_edge(now, before), now == 0 && before == 1);
      EXPECT_EQ(any_edge(now, before), now != before);
      EXPECT_EQ(both(now, before), now == 1 && before == 1);
      EXPECT_EQ(either(now, before), now == 1 || before == 1);
    }
}

TEST(GuardedMotion, WaitsIsActiveAndIsDone) {
  constexpr double kWaiting = 0, kActive = 1, kDone = 2;
  for (const double when : {0.0, 1.0})
    for (const double holds : {0.0, 1.0})
      for (const double until : {0.0, 1.0}) {
        const double running = until ? kDone : holds ? kActive : kWaiting;
        EXPECT_EQ(motion_phase(kWaiting, when, holds, until), when ? running : kWaiting);
        EXPECT_EQ(motion_phase(kActive, when, holds, until), running);
        EXPECT_EQ(motion_phase(kDone, when, holds, until), kDone);
      }
  EXPECT_EQ(motion_is_active(kWaiting), 0);
  EXPECT_EQ(motion_is_active(kActive), 1);
  EXPECT_EQ(motion_is_active(kDone), 0);
}

TEST(Rates, CountStartsAgainAfterItsCycles) {
  double count = 0;
  for (int cycle = 0; cycle < 20; ++cycle) {
    EXPECT_EQ(count_is_zero(count), cycle % 5 == 0) << cycle;
    count = count_up(count, 5.0);
  }
  EXPECT_EQ(count_up(0.0, 1.0), 0);
}

TEST(Impedance, ActsOnEachAxisOfTheFrameAlone) {
  const PoseError<double> e = {{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}};
  const VelocityTwist<double> V = {{1, 2, 3}, {4, 5, 6}};
  const SpatialGains<double> K = {{10, 20, 30}, {40, 50, 60}}, D = {{1, 2, 3}, {4, 5, 6}};
  const Wrench<double> W = impedance_wrench(e, V, K, D);
  EXPECT_NEAR(W.moment.y, 20 * 0.2 - 2 * 2, 1e-15);
  EXPECT_NEAR(W.force.z, 60 * 0.6 - 6 * 6, 1e-14);
}

}  // namespace
}  // namespace sinew::math
