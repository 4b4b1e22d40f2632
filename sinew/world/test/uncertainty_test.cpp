// Covariances against Monte Carlo: of what is composed, inverted and seen from elsewhere, and along
// the way of a query. And what has to hold exactly: the adjoint against Eigen, inverses.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "random_gaussians.h"
#include "random_poses.h"
#include "sinew/base/error.h"
#include "sinew/world/edit.h"
#include "sinew/world/gaussian_pose.h"
#include "sinew/world/uncertain_path.h"

namespace sinew::world {
namespace {

// With this many draws the error of a variance is about sqrt(2 / draws), 0.6 %.
constexpr int kDraws = 60000;
constexpr double kSampling = 0.02;

TEST(GaussianPose, TheAdjointIsThatOfEigen) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20; ++i) {
    const Pose X = random_pose(random);
    const Covariance S = random_covariance(random, 0.3, 0.5);
    const Eigen::Matrix3d R = Eigen::Quaterniond(X.q.w, X.q.x, X.q.y, X.q.z).toRotationMatrix();
    Eigen::Matrix3d p;
    p << 0, -X.p.z, X.p.y, X.p.z, 0, -X.p.x, -X.p.y, X.p.x, 0;
    EigenMatrix6 ad = EigenMatrix6::Zero();
    ad.topLeftCorner<3, 3>() = ad.bottomRightCorner<3, 3>() = R;
    ad.bottomLeftCorner<3, 3>() = p * R;
    const EigenMatrix6 expected = ad * eigen(S) * ad.transpose();
    EXPECT_LT((eigen(seen_from(X, S)) - expected).norm(), 1e-12 * expected.norm());
  }
}

TEST(GaussianPose, InvertedTwiceItIsTheSame) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 20; ++i) {
    const GaussianPose X{random_pose(random), random_covariance(random, 0.2, 0.4)};
    const GaussianPose again = invert(invert(X));
    EXPECT_LT(difference(again.mean, X.mean), 1e-13);
    EXPECT_LT(apart(again.covariance, X.covariance), 1e-11);
  }
}

// An angle is worth more the farther away one looks: a rotation about z by 0.01 rad, seen 2 m along
// x, is 0.02 m along y.
TEST(GaussianPose, AFrameFarAwayMovesMore) {
  Covariance about_z;
  about_z(2, 2) = 1e-4;
  const GaussianPose far = compose(GaussianPose{{}, about_z}, Pose{{}, {2, 0, 0}});
  EXPECT_NEAR(far.covariance(2, 2), 1e-4, 1e-18);
  EXPECT_NEAR(far.covariance(4, 4), 4e-4, 1e-18);
  EXPECT_NEAR(far.covariance(2, 4), 2e-4, 1e-18);
  EXPECT_EQ(far.covariance(3, 3), 0);
}

TEST(GaussianPose, InversionAgreesWithMonteCarlo) {
  std::mt19937_64 random(3);
  const GaussianPose X{random_pose(random), random_covariance(random, 0.2, 0.3)};
  const Draw draw(X);
  const GaussianPose inverse = invert(X);
  const Covariance drawn = monte_carlo(inverse.mean, kDraws, [&] { return invert(draw(random)); });
  EXPECT_LT(apart(inverse.covariance, drawn), kSampling);
  EXPECT_GT(apart(X.covariance, drawn), 0.1);  // it does matter
}

TEST(GaussianPose, CompositionAgreesWithMonteCarlo) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 3; ++i) {
    const GaussianPose a{random_pose(random), random_covariance(random, 0.1, 0.1)};
    const GaussianPose b{random_pose(random), random_covariance(random, 0.1, 0.1)};
    const Draw draw_a(a), draw_b(b);
    const GaussianPose c = compose(a, b);
    const Covariance drawn =
        monte_carlo(c.mean, kDraws, [&] { return compose(draw_a(random), draw_b(random)); });
    EXPECT_LT(apart(c.covariance, drawn), kSampling);
  }
}

// With large angles the second order is not enough, the fourth is much closer.
TEST(GaussianPose, TheFourthOrderIsCloserWhereAnglesAreLarge) {
  std::mt19937_64 random(5);
  const GaussianPose a{{{}, {1, 0, 0}}, isotropic(0.45, 0.05)};
  const GaussianPose b{{{}, {0, 1, 0}}, isotropic(0.45, 0.05)};
  const Draw draw_a(a), draw_b(b);
  const GaussianPose fourth = compose(a, b), second = compose(a, b, Order::kSecond);
  const Covariance drawn =
      monte_carlo(fourth.mean, 2 * kDraws, [&] { return compose(draw_a(random), draw_b(random)); });
  const double error_4 = apart(fourth.covariance, drawn);
  const double error_2 = apart(second.covariance, drawn);
  EXPECT_LT(error_4, 0.5 * error_2) << error_4 << " and " << error_2;
  EXPECT_GT(error_2, 2 * kSampling);
  RecordProperty("second_order_error", std::to_string(error_2));
  RecordProperty("fourth_order_error", std::to_string(error_4));
}

TEST(GaussianPose, KnowsWhatIsACovariance) {
  std::mt19937_64 random(6);
  for (int i = 0; i < 50; ++i) {
    EXPECT_TRUE(is_covariance(random_covariance(random, 0.1, 2)));
    EigenMatrix6 S = eigen(random_covariance(random, 1, 1));
    const Eigen::SelfAdjointEigenSolver<EigenMatrix6> solver(S);
    EigenVector6 values = solver.eigenvalues();
    values(i % 6) = -0.01 * values(5);  // a negative variance along some axis
    const EigenMatrix6 bad =
        solver.eigenvectors() * values.asDiagonal() * solver.eigenvectors().transpose();
    EXPECT_FALSE(is_covariance(covariance(bad)));
  }
  EXPECT_TRUE(is_covariance({}));
  Covariance S = isotropic(0.1, 0.1);
  EXPECT_TRUE(is_covariance(S));
  S(0, 4) = 1e-3;
  EXPECT_FALSE(is_covariance(S));
  S(4, 0) = 1e-3;
  EXPECT_TRUE(is_covariance(S));
  S(4, 0) = S(0, 4) = 0.02;  // more than the variances
  EXPECT_FALSE(is_covariance(S));
  S = isotropic(0.1, std::nan(""));
  EXPECT_FALSE(is_covariance(S));
}

// base -(constant)-> mount -(joint)-> link <-(measured)- part -(measured)-> tip, so that one
// relation is walked against its direction.
struct UncertainChain {
  UncertainChain() {
    base = world.add_frame("http://x/base");
    const FrameId mount = world.add_frame("http://x/mount"),
                  link = world.add_frame("http://x/link");
    part = world.add_frame("http://x/part");
    tip = world.add_frame("http://x/tip");
    std::mt19937_64 random(7);
    constant =
        world.add_static("http://x/mounting", mount, base, random_pose(random), "http://x/me");
    const RelationId turning = world.add_relation({.name = "http://x/turning",
                                                   .of = link,
                                                   .with_respect_to = mount,
                                                   .kind = RelationKind::kRevolute,
                                                   .placement = random_pose(random)});
    joint = world.add_measurement(
        {.name = "http://x/joint", .relation = turning, .quantity = Quantity::kJointPosition});
    const RelationId backwards =
        world.add_relation({.name = "http://x/backwards", .of = link, .with_respect_to = part});
    seen = world.add_measurement({.name = "http://x/seen", .relation = backwards});
    const RelationId forwards =
        world.add_relation({.name = "http://x/forwards", .of = tip, .with_respect_to = part});
    held = world.add_measurement({.name = "http://x/held", .relation = forwards});
    write(1);
  }
  void write(int second) {
    const Stamp at{std::chrono::seconds(second)};
    std::mt19937_64 random(static_cast<unsigned>(8 + second));
    const double angle[] = {0.7 * second};
    world.write(joint, at, angle, {"me"});
    world.write(seen, at, X_seen = random_pose(random), {"me"});
    world.write(held, at, X_held = random_pose(random), {"me"});
  }
  World world;
  FrameId base, part, tip;
  MeasurementId constant, joint, seen, held;
  Pose X_seen, X_held;
};

constexpr Stamp kNow1{std::chrono::seconds(1)};

TEST(UncertainPath, AgreesWithMonteCarloOverTheWorldsOwnQueries) {
  UncertainChain chain;
  std::mt19937_64 random(9);
  const Covariance S_seen = random_covariance(random, 0.08, 0.1);
  const Covariance S_held = random_covariance(random, 0.08, 0.1);
  Uncertainties known;
  known.set_exact(chain.constant);
  known.set_joint(chain.world, chain.joint, 0.1);
  known.set(chain.world, chain.seen, S_seen);
  known.set(chain.world, chain.held, S_held);
  const PoseQuery query{.of = chain.tip, .with_respect_to = chain.base};
  const UncertainPose answer = uncertain_pose(chain.world, query, known, kNow1);
  ASSERT_TRUE(answer);
  const Pose mean = chain.world.pose(chain.tip, chain.base, kNow1).pose;
  EXPECT_LT(difference(answer.pose.mean, mean), 1e-14);
  EXPECT_TRUE(is_covariance(answer.pose.covariance));

  // Write what might have been measured, and ask the world where the tip would be.
  World other = chain.world.clone();
  PreparedPose prepared = other.prepare_pose(query);
  const Draw draw_seen({chain.X_seen, S_seen}), draw_held({chain.X_held, S_held});
  std::normal_distribution<double> normal;
  std::int64_t ns = ns_of(kNow1);
  const Covariance drawn = monte_carlo(mean, 30000, [&] {
    const Stamp at = stamp_of_ns(++ns);
    const double angle[] = {0.7 + 0.1 * normal(random)};
    other.write(chain.joint, at, angle, {"me"});
    other.write(chain.seen, at, draw_seen(random), {"me"});
    other.write(chain.held, at, draw_held(random), {"me"});
    return prepared.latest(at).pose;
  });
  EXPECT_LT(apart(answer.pose.covariance, drawn), 0.03);
  // The question did not touch the world.
  EXPECT_LT(difference(chain.world.pose(chain.tip, chain.base, kNow1).pose, mean), 1e-15);
}

TEST(UncertainPath, NamesWhatIsNotDeclaredAndAssumesNothing) {
  UncertainChain chain;
  Uncertainties known;
  known.set_joint(chain.world, chain.joint, 0.1);
  known.set(chain.world, chain.seen, isotropic(0.1, 0.1));
  const UncertainPose answer =
      uncertain_pose(chain.world, {.of = chain.tip, .with_respect_to = chain.base}, known, kNow1);
  EXPECT_EQ(answer.status, Status::kOk);
  EXPECT_FALSE(answer);
  EXPECT_EQ(answer.undeclared.size(), 2u);  // the constant, and what is held
  EXPECT_EQ(answer.undeclared.back(), "http://x/held");
  EXPECT_EQ(answer.pose.covariance(0, 0), 0);
  const FrameId nowhere = chain.world.add_frame("http://x/nowhere");
  EXPECT_EQ(
      uncertain_pose(chain.world, {.of = nowhere, .with_respect_to = chain.base}, known, kNow1)
          .status,
      Status::kNotConnected);
}

TEST(UncertainPath, UsesTheMeasurementThatTheQueryChooses) {
  UncertainChain chain;
  const MeasurementId other =
      chain.world.add_measurement({.name = "http://x/held-otherwise",
                                   .relation = chain.world.find_relation("http://x/forwards"),
                                   .model = {.provenance = "http://x/other"}});
  Uncertainties known;
  known.set(chain.world, chain.held, isotropic(0.1, 0.1));
  known.set(chain.world, other, isotropic(0.2, 0.2));
  const PoseQuery query{.of = chain.tip, .with_respect_to = chain.part};
  const auto variance = [&] {
    return uncertain_pose(chain.world, query, known, Stamp(std::chrono::seconds(9)))
        .pose.covariance(0, 0);
  };
  EXPECT_NEAR(variance(), 0.01, 1e-15);
  chain.world.write(other, Stamp(std::chrono::seconds(2)), Pose{}, {"http://x/other"});
  EXPECT_NEAR(variance(), 0.04, 1e-15);
  chain.world.write(chain.held, Stamp(std::chrono::seconds(3)), Pose{}, {"me"});
  EXPECT_NEAR(variance(), 0.01, 1e-15);
}

TEST(UncertainPath, RefusesWhatIsNoUncertainty) {
  UncertainChain chain;
  Uncertainties known;
  EXPECT_THROW(known.set(chain.world, chain.joint, isotropic(0.1, 0.1)), Error);
  EXPECT_THROW(known.set_joint(chain.world, chain.seen, 0.1), Error);
  EXPECT_THROW(known.set_joint(chain.world, chain.joint, -0.1), Error);
  EXPECT_THROW(known.set(chain.world, chain.seen, isotropic(std::nan(""), 0)), Error);
  EXPECT_THROW(known.set_joint(chain.world, MeasurementId{99}, 0.1), Error);
}

}  // namespace
}  // namespace sinew::world
