// Particle sets on SE(3), and distributions of any kind together.
#include "sinew/world/pose_particles.h"

#include <gtest/gtest.h>

#include "random_gaussians.h"
#include "random_poses.h"
#include "sinew/base/error.h"
#include "sinew/world/matrix6.h"
#include "sinew/world/pose_distribution.h"

namespace sinew::world {
namespace {

// With 4096 draws the error of a variance is about sqrt(2 / 4096), 2 %, and of a whole matrix of
// them some times that.
constexpr double kSampling = 0.12;

GaussianPose random_gaussian(std::mt19937_64& random, double deviation = 0.1) {
  return {random_pose(random), random_covariance(random, deviation, deviation)};
}

PoseParticles weighted(std::mt19937_64& random, std::size_t count) {
  const GaussianPose about = random_gaussian(random);
  PoseParticles set = draw(PoseMixture{{{1, about}}}, count, random());
  std::uniform_real_distribution<double> uniform(0, 1);
  double sum = 0;
  for (WeightedPose& one : set.particles) sum += one.weight = uniform(random);
  for (WeightedPose& one : set.particles) one.weight /= sum;
  return set;
}

TEST(PoseParticles, DrawsHaveTheMomentsOfWhatTheyAreDrawnFrom) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 5; ++i) {
    const GaussianPose X = random_gaussian(random);
    const PoseParticles set = draw(PoseMixture{{{1, X}}}, kMaximumParticles, random());
    EXPECT_EQ(fault_of(set), std::nullopt);
    const auto found = gaussian_of(set);
    ASSERT_TRUE(found);
    EXPECT_LT(difference(found->mean, X.mean), 0.02);
    EXPECT_LT(apart(found->covariance, X.covariance), kSampling);
  }
}

TEST(PoseParticles, TheSameSeedGivesTheSameSet) {
  std::mt19937_64 random(2);
  const PoseMixture X{{{0.5, random_gaussian(random)}, {0.5, random_gaussian(random)}}};
  const PoseParticles a = draw(X, 100, 7), b = draw(X, 100, 7), c = draw(X, 100, 8);
  double same = 0, other = 0;
  for (std::size_t i = 0; i < 100; ++i) {
    same = std::max(same, difference(a.particles[i].pose, b.particles[i].pose));
    other = std::max(other, difference(a.particles[i].pose, c.particles[i].pose));
  }
  EXPECT_EQ(same, 0);
  EXPECT_GT(other, 0.1);
}

TEST(PoseParticles, CompositionAgreesWithTheGaussians) {
  std::mt19937_64 random(3);
  const GaussianPose a = random_gaussian(random), b = random_gaussian(random);
  const PoseMixture only_a{{{1, a}}}, only_b{{{1, b}}};
  const PoseParticles set_a = draw(only_a, kMaximumParticles, 1);
  const PoseParticles set_b = draw(only_b, kMaximumParticles, 2);
  const GaussianPose expected = compose(a, b);
  const PoseParticles all[] = {compose(set_a, only_b, 3), compose(only_a, set_b, 4),
                               compose_by_sampling(set_a, set_b, kMaximumParticles, 5),
                               compose_by_pairing(set_a, set_b)};
  for (const PoseParticles& product : all) {
    EXPECT_EQ(product.particles.size(), kMaximumParticles);
    const auto found = gaussian_of(product);
    ASSERT_TRUE(found);
    EXPECT_LT(difference(found->mean, expected.mean), 0.03);
    EXPECT_LT(apart(found->covariance, expected.covariance), kSampling);
  }
  const auto inverse = gaussian_of(invert(set_a));
  EXPECT_LT(apart(inverse->covariance, invert(a).covariance), kSampling);
}

// What is one hypothesis, held twice, cancels pair by pair; drawn it does not.
TEST(PoseParticles, PairedWithItsInverseIsTheIdentity) {
  std::mt19937_64 random(4);
  const PoseParticles X = draw(PoseMixture{{{1, random_gaussian(random)}}}, 500, 1);
  const PoseParticles identity = compose_by_pairing(X, invert(X));
  for (const WeightedPose& one : identity.particles) {
    EXPECT_LT(difference(one.pose, Pose()), 1e-13);
    EXPECT_NEAR(one.weight, 1.0 / 500, 1e-15);
  }
  const auto drawn = gaussian_of(compose_by_sampling(X, invert(X), 500, 2));
  EXPECT_GT(drawn->covariance(3, 3), 1e-3);
}

TEST(PoseParticles, FramesChangeEveryParticle) {
  std::mt19937_64 random(5);
  const PoseParticles X = weighted(random, 300);
  const Pose Y = random_pose(random);
  const auto own = gaussian_of(X), before = gaussian_of(compose(Y, X)),
             after = gaussian_of(compose(X, Y)), inverse = gaussian_of(invert(X));
  EXPECT_LT(difference(before->mean, compose(Y, own->mean)), 1e-11);
  EXPECT_LT(apart(before->covariance, own->covariance), 1e-9);
  EXPECT_LT(difference(after->mean, compose(own->mean, Y)), 1e-11);
  EXPECT_LT(apart(after->covariance, seen_from(invert(Y), own->covariance)), 1e-9);
  EXPECT_LT(difference(inverse->mean, invert(own->mean)), 1e-11);
  EXPECT_LT(apart(inverse->covariance, seen_from(own->mean, own->covariance)), 1e-9);
}

// Of each particle floor or ceil of count times its weight, for every seed: that is what makes it
// systematic.
TEST(PoseParticles, ResamplingIsSystematic) {
  std::mt19937_64 random(6);
  for (int round = 0; round < 50; ++round) {
    PoseParticles X = weighted(random, 20);
    for (std::size_t i = 0; i < 20; ++i) X.particles[i].pose.p.x = static_cast<double>(i);
    const std::size_t count = 1 + random() % 200;
    const PoseParticles again = resample(X, count, random());
    ASSERT_EQ(again.particles.size(), count);
    EXPECT_EQ(fault_of(again), std::nullopt);
    std::vector<int> times(20);
    for (const WeightedPose& one : again.particles) ++times[static_cast<std::size_t>(one.pose.p.x)];
    for (std::size_t i = 0; i < 20; ++i) {
      const double wanted = static_cast<double>(count) * X.particles[i].weight;
      EXPECT_GE(times[i], std::floor(wanted - 1e-9));
      EXPECT_LE(times[i], std::ceil(wanted + 1e-9));
    }
  }
}

TEST(PoseParticles, TheEffectiveSizeTellsWhenFewCarryAll) {
  PoseParticles set{std::vector<WeightedPose>(10, {0.1, {}})};
  EXPECT_NEAR(effective_size(set), 10, 1e-12);
  for (WeightedPose& one : set.particles) one.weight = 0;
  set.particles[3].weight = 1;
  EXPECT_NEAR(effective_size(set), 1, 1e-12);
}

TEST(PoseParticles, FaultsAreNamed) {
  const PoseParticles two{{{0.5, {}}, {0.5, {}}}}, one{{{1, {}}}};
  EXPECT_EQ(fault_of(two), std::nullopt);
  EXPECT_TRUE(fault_of(PoseParticles{}));
  EXPECT_TRUE(fault_of(PoseParticles{{{0.5, {}}, {0.4, {}}}}));
  EXPECT_TRUE(fault_of(PoseParticles{{{1.5, {}}, {-0.5, {}}}}));
  EXPECT_TRUE(fault_of(PoseParticles{{{1, {{0, 0, 0, 2}, {}}}}}));
  EXPECT_TRUE(
      fault_of(PoseParticles{std::vector<WeightedPose>(kMaximumParticles + 1, {1.0 / 4097, {}})}));
  EXPECT_THROW(compose_by_pairing(one, two), Error);
  EXPECT_THROW(compose_by_pairing(PoseParticles{{{1, {}}, {0, {}}}}, {{{0, {}}, {1, {}}}}), Error);
  EXPECT_THROW(resample(two, 0, 1), Error);
  EXPECT_THROW(resample(two, kMaximumParticles + 1, 1), Error);
  EXPECT_THROW(compose_by_sampling(two, two, 0, 1), Error);
  EXPECT_THROW(draw(PoseMixture{{{1, {}}}}, 0, 1), Error);
}

// ---- any kind with any ----

std::vector<PoseDistribution> one_of_each(std::mt19937_64& random) {
  const GaussianPose a = random_gaussian(random), b = random_gaussian(random, 0.05);
  return {random_pose(random), a,
          PoseMixture{{{0.4, a}, {0.6, {compose(a.mean, Pose{{}, {0.1, 0, 0}}), b.covariance}}}},
          draw(PoseMixture{{{1, a}}}, 2000, random())};
}

TEST(PoseDistribution, AnyTwoComposeToTheKindThatHoldsThem) {
  std::mt19937_64 random(7);
  const auto left = one_of_each(random), right = one_of_each(random);
  for (const PoseDistribution& a : left) {
    for (const PoseDistribution& b : right) {
      const PoseDistribution product = compose(a, b, {.seed = 1, .particles = 4000});
      EXPECT_EQ(product.index(), std::max(a.index(), b.index()));
      EXPECT_EQ(fault_of(product), std::nullopt);
      // All agree on mean and covariance with the two Gaussians that have those.
      const auto found = gaussian_of(product), X = gaussian_of(a), Y = gaussian_of(b);
      ASSERT_TRUE(found && X && Y);
      const GaussianPose expected = compose(*X, *Y);
      EXPECT_LT(difference(found->mean, expected.mean), 0.05) << kind_of(a) << " " << kind_of(b);
      if (product.index() > 0) {
        EXPECT_LT(apart(found->covariance, expected.covariance), 0.2)
            << kind_of(a) << " " << kind_of(b);
      }
    }
  }
}

TEST(PoseDistribution, NothingIsDrawnWithoutASeed) {
  std::mt19937_64 random(8);
  const auto all = one_of_each(random);
  for (const PoseDistribution& other : {all[1], all[2], all[3]}) {
    for (const bool first : {false, true}) {
      try {
        first ? compose(all[3], other) : compose(other, all[3]);
        ADD_FAILURE() << "drawn without a seed";
      } catch (const Error& error) {
        EXPECT_NE(error.problems().front().remedy.find("seed"), std::string::npos);
      }
    }
  }
  EXPECT_EQ(compose(all[0], all[3]).index(), 3u);  // nothing to draw
  EXPECT_EQ(compose(all[3], all[3], {.pairs = Pairs::kPaired}).index(), 3u);
}

TEST(PoseDistribution, OfOneComponentIsTheGaussianInEveryComposition) {
  std::mt19937_64 random(9);
  const GaussianPose a = random_gaussian(random), b = random_gaussian(random);
  const auto mixed = compose(PoseMixture{{{1, a}}}, PoseDistribution(b));
  const auto& one = std::get<PoseMixture>(mixed).components;
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].pose.covariance.entries, compose(a, b).covariance.entries);
}

TEST(PoseDistribution, SurvivesTheWayThroughNumbers) {
  std::mt19937_64 random(10);
  const auto all = one_of_each(random);
  const std::size_t room[] = {numbers_of_components(1), numbers_of_components(1),
                              numbers_of_components(2), numbers_of_particles(2000)};
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::vector<double> numbers = to_numbers(all[k], room[k] + 3);
    EXPECT_EQ(numbers.size(), room[k] + 3);
    const auto back = from_numbers(numbers);
    ASSERT_TRUE(back);
    ASSERT_EQ(back->index(), k);
    EXPECT_EQ(to_numbers(*back, room[k] + 3), numbers);
    EXPECT_THROW(to_numbers(all[k], room[k] - 1), Error);
    EXPECT_EQ(from_numbers(std::span(numbers).first(room[k] - 1)), std::nullopt);
  }
}

// Whatever the numbers are, the answer is a distribution or nothing.
TEST(PoseDistribution, NumbersThatAreNoneAreRefused) {
  std::mt19937_64 random(11);
  std::vector<double> numbers = to_numbers(one_of_each(random)[2], 60);
  for (const double bad :
       {-1.0, 0.5, 4.0, 1e300, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    for (const std::size_t at : {0u, 1u, 2u, 3u}) {
      std::vector<double> changed = numbers;
      changed[at] = bad;
      EXPECT_EQ(from_numbers(changed), std::nullopt) << at << " " << bad;
    }
  }
  EXPECT_EQ(from_numbers({}), std::nullopt);
  std::uniform_real_distribution<double> uniform(-2, 2);
  for (int i = 0; i < 1000; ++i) {
    std::vector<double> noise(40);
    for (double& number : noise) number = uniform(random);
    noise[0] = static_cast<double>(random() % 5), noise[1] = static_cast<double>(random() % 5);
    if (const auto found = from_numbers(noise)) {
      EXPECT_EQ(fault_of(*found), std::nullopt);
    }
  }
}

TEST(PoseDistribution, TheTotalDeviationIsOneScaleForAllKinds) {
  std::mt19937_64 random(12);
  const GaussianPose X = random_gaussian(random);
  const double own = total_deviation(X);
  EXPECT_NEAR(own, std::sqrt(eigen(X.covariance).trace()), 1e-12);
  EXPECT_EQ(total_deviation(Pose()), 0);
  EXPECT_NEAR(total_deviation(PoseMixture{{{1, X}}}), own, 1e-12);
  EXPECT_NEAR(total_deviation(draw(PoseMixture{{{1, X}}}, 4000, 1)), own, 0.05 * own);
}

}  // namespace
}  // namespace sinew::world
