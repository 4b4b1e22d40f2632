// Mixtures of Gaussians on SE(3): what holds exactly, and the rest against Monte Carlo.
#include "sinew/world/pose_mixture.h"

#include <gtest/gtest.h>

#include "random_gaussians.h"
#include "random_poses.h"
#include "sinew/base/error.h"
#include "sinew/world/matrix6.h"

namespace sinew::world {
namespace {

constexpr int kDraws = 40000;
constexpr double kSampling = 0.03;  // the error of a variance is about sqrt(2 / draws), 0.7 %

// A pose near another: within some 0.3 rad and 0.3 m.
Pose near(const Pose& X, std::mt19937_64& random, double size = 0.3) {
  std::normal_distribution<double> normal(0, size / 2);
  const auto d = [&] { return normal(random); };
  return compose(X, exponential({{d(), d(), d()}, {d(), d(), d()}}, 1));
}

PoseMixture random_mixture(std::mt19937_64& random, std::size_t count, double deviation = 0.05,
                           double spread = 0.3) {
  std::uniform_real_distribution<double> uniform(0.2, 1);
  PoseMixture mixture;
  const Pose middle = random_pose(random);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double weight = uniform(random);
    sum += weight;
    mixture.components.push_back(
        {weight, {near(middle, random, spread), random_covariance(random, deviation, deviation)}});
  }
  for (PoseComponent& one : mixture.components) one.weight /= sum;
  return mixture;
}

// Draws by Eigen's roots and the standard library's distributions, not by what is tested.
struct DrawMixture {
  explicit DrawMixture(const PoseMixture& of) {
    for (const PoseComponent& one : of.components) {
      weights.push_back(one.weight);
      draws.emplace_back(one.pose);
    }
  }
  Pose operator()(std::mt19937_64& random) const {
    std::discrete_distribution<std::size_t> which(weights.begin(), weights.end());
    return draws[which(random)](random);
  }
  std::vector<double> weights;
  std::vector<Draw> draws;
};

double sum_of_weights(const PoseMixture& mixture) {
  double sum = 0;
  for (const PoseComponent& one : mixture.components) sum += one.weight;
  return sum;
}

TEST(PoseMixture, OfOneComponentIsThatGaussian) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20; ++i) {
    const GaussianPose a{random_pose(random), random_covariance(random, 0.1, 0.2)};
    const GaussianPose b{random_pose(random), random_covariance(random, 0.1, 0.2)};
    const PoseMixture product = compose(PoseMixture{{{1, a}}}, PoseMixture{{{1, b}}});
    const GaussianPose expected = compose(a, b);
    const auto all = gaussian_of(product);
    ASSERT_TRUE(all);
    EXPECT_EQ(difference(all->mean, expected.mean), 0);
    EXPECT_EQ(all->covariance.entries, expected.covariance.entries);
    EXPECT_EQ(difference(mode_of(product), expected.mean), 0);
    const auto inverse = gaussian_of(invert(PoseMixture{{{1, a}}}));
    EXPECT_EQ(inverse->covariance.entries, invert(a).covariance.entries);
    EXPECT_EQ(difference(inverse->mean, invert(a).mean), 0);
  }
}

TEST(PoseMixture, CompositionIsAssociativeInMean) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 10; ++i) {
    const PoseMixture a = random_mixture(random, 2), b = random_mixture(random, 3),
                      c = random_mixture(random, 2);
    const PoseMixture left = compose(compose(a, b), c), right = compose(a, compose(b, c));
    ASSERT_EQ(left.components.size(), 12u);
    ASSERT_EQ(right.components.size(), 12u);
    EXPECT_NEAR(sum_of_weights(left), 1, 1e-12);
    const auto mean_left = mean_of(left), mean_right = mean_of(right);
    ASSERT_TRUE(mean_left && mean_right);
    EXPECT_LT(difference(*mean_left, *mean_right), 1e-11);
  }
}

// The mean and the covariance move with the frames, and the inverse's mean is the mean's inverse.
TEST(PoseMixture, MovesWithItsFrames) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20; ++i) {
    const PoseMixture X = random_mixture(random, 4);
    const Pose Y = random_pose(random);
    const auto own = gaussian_of(X);
    const auto before = gaussian_of(compose(Y, X)), after = gaussian_of(compose(X, Y)),
               inverse = gaussian_of(invert(X));
    ASSERT_TRUE(own && before && after && inverse);
    EXPECT_LT(difference(before->mean, compose(Y, own->mean)), 1e-11);
    EXPECT_LT(apart(before->covariance, own->covariance), 1e-9);
    EXPECT_LT(difference(after->mean, compose(own->mean, Y)), 1e-11);
    EXPECT_LT(apart(after->covariance, seen_from(invert(Y), own->covariance)), 1e-9);
    EXPECT_LT(difference(inverse->mean, invert(own->mean)), 1e-11);
    EXPECT_LT(apart(inverse->covariance, seen_from(own->mean, own->covariance)), 1e-9);
    const PoseMixture again = invert(invert(X));
    for (std::size_t k = 0; k < X.components.size(); ++k) {
      EXPECT_LT(difference(again.components[k].pose.mean, X.components[k].pose.mean), 1e-13);
      EXPECT_LT(apart(again.components[k].pose.covariance, X.components[k].pose.covariance), 1e-11);
    }
  }
}

TEST(PoseMixture, ComposedWithItsInverseIsAboutTheIdentity) {
  std::mt19937_64 random(4);
  // Known exactly, and one hypothesis: nothing but the identity is left.
  const PoseMixture exact{{{1, {random_pose(random), {}}}}};
  const auto nothing = gaussian_of(compose(exact, invert(exact)));
  EXPECT_LT(difference(nothing->mean, Pose()), 1e-13);
  EXPECT_EQ(nothing->covariance.entries, Covariance().entries);
  // Several: as many ways there and back; the mean stays at the identity, for pairs are symmetric.
  const PoseMixture X = random_mixture(random, 3);
  const auto mean = mean_of(compose(X, invert(X)));
  ASSERT_TRUE(mean);
  EXPECT_LT(difference(*mean, Pose()), 1e-10);
}

TEST(PoseMixture, AgreesWithMonteCarlo) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 3; ++i) {
    const PoseMixture a = random_mixture(random, 3, 0.05), b = random_mixture(random, 2, 0.05);
    const DrawMixture draw_a(a), draw_b(b);
    const auto product = gaussian_of(compose(a, b)), inverse = gaussian_of(invert(a));
    ASSERT_TRUE(product && inverse);
    EXPECT_LT(apart(product->covariance,
                    monte_carlo(product->mean, kDraws,
                                [&] { return compose(draw_a(random), draw_b(random)); })),
              kSampling);
    EXPECT_LT(apart(inverse->covariance,
                    monte_carlo(inverse->mean, kDraws, [&] { return invert(draw_a(random)); })),
              kSampling);
  }
}

// Merging keeps weight, mean and covariance of the whole, exactly for a pair, and the components
// that remain are fewer.
TEST(PoseMixture, ReductionPreservesTheMoments) {
  std::mt19937_64 random(6);
  for (int i = 0; i < 20; ++i) {
    const PoseMixture pair = random_mixture(random, 2);
    const auto expected = gaussian_of(pair);
    const PoseMixture one = reduce(pair, 1);
    ASSERT_EQ(one.components.size(), 1u);
    EXPECT_NEAR(one.components[0].weight, 1, 1e-15);
    EXPECT_LT(difference(one.components[0].pose.mean, expected->mean), 1e-11);
    EXPECT_LT(apart(one.components[0].pose.covariance, expected->covariance), 1e-9);

    const PoseMixture many = random_mixture(random, 12);
    const auto whole = gaussian_of(many);
    for (const std::size_t most : {7u, 3u, 1u}) {
      const PoseMixture few = reduce(many, most);
      ASSERT_EQ(few.components.size(), most);
      EXPECT_EQ(fault_of(few), std::nullopt);
      const auto left = gaussian_of(few);
      ASSERT_TRUE(left);
      // Merging three one after the other is not merging them at once: to second order only.
      EXPECT_LT(difference(left->mean, whole->mean), 0.01);
      EXPECT_LT(apart(left->covariance, whole->covariance), 0.05);
    }
    EXPECT_EQ(reduce(many, 12).components.size(), 12u);
  }
}

// Two that are nearly the same become one; the one that is apart stays, light as it is.
TEST(PoseMixture, ReductionMergesWhatIsAlike) {
  const Covariance S = isotropic(0.02, 0.02);
  const Pose here, beside{{}, {0.005, 0, 0}}, far{{}, {1, 0, 0}};
  const PoseMixture mixture{{{0.45, {here, S}}, {0.1, {far, S}}, {0.45, {beside, S}}}};
  const PoseMixture two = reduce(mixture, 2);
  ASSERT_EQ(two.components.size(), 2u);
  EXPECT_NEAR(two.components[0].weight, 0.9, 1e-15);
  EXPECT_NEAR(two.components[0].pose.mean.p.x, 0.0025, 1e-12);
  // Between the two, and their half distance squared (by hand).
  EXPECT_NEAR(two.components[0].pose.covariance(3, 3), 0.0004 + 0.0025 * 0.0025, 1e-12);
  EXPECT_NEAR(two.components[1].weight, 0.1, 1e-15);
  EXPECT_EQ(two.components[1].pose.mean.p.x, 1);
}

TEST(PoseMixture, ModeAndMeanOfTwoSides) {
  const Covariance S = isotropic(0.01, 0.01);
  const PoseMixture sides{{{0.7, {Pose{{}, {0, 0, 0}}, S}}, {0.3, {Pose{{}, {1, 0, 0}}, S}}}};
  EXPECT_NEAR(mean_of(sides)->p.x, 0.3, 1e-12);
  EXPECT_EQ(mode_of(sides).p.x, 0);
  EXPECT_LT(density(sides, *mean_of(sides)), 1e-100 * density(sides, mode_of(sides)));
  // A light but narrow one is the densest.
  const PoseMixture narrow{{{0.9, {Pose(), isotropic(0.1, 0.1)}},
                            {0.1, {Pose{{}, {1, 0, 0}}, isotropic(0.001, 0.001)}}}};
  EXPECT_EQ(mode_of(narrow).p.x, 1);
}

// By its definition, also where rotations are spread over the whole circle: then it is one of
// several such poses, or none is found.
TEST(PoseMixture, TheMeanBalancesWhatIsAroundIt) {
  std::mt19937_64 random(17);
  int found = 0;
  for (int i = 0; i < 200; ++i) {
    PoseMixture spread = random_mixture(random, 4);
    for (PoseComponent& one : spread.components) one.pose.mean = random_pose(random);
    const auto mean = mean_of(spread);
    if (!mean) continue;
    ++found;
    Vector6 sum = {};
    for (const PoseComponent& one : spread.components) {
      const Vector6 d = between(*mean, one.pose.mean);
      for (std::size_t k = 0; k < 6; ++k) sum[k] += one.weight * d[k];
    }
    for (const double number : sum) EXPECT_LT(std::abs(number), 1e-12);
  }
  EXPECT_GT(found, 100);
}

TEST(PoseMixture, ProductsAreBounded) {
  std::mt19937_64 random(7);
  const PoseMixture a = random_mixture(random, kMaximumComponents, 0.05),
                    b = random_mixture(random, kMaximumComponents, 0.05);
  const PoseMixture product = compose(a, b);
  EXPECT_EQ(product.components.size(), kMaximumComponents);
  EXPECT_EQ(fault_of(product), std::nullopt);
  const auto mean_a = mean_of(a), mean_b = mean_of(b), mean = mean_of(product);
  ASSERT_TRUE(mean_a && mean_b && mean);
  EXPECT_LT(difference(*mean, compose(*mean_a, *mean_b)), 0.05);
}

TEST(PoseMixture, FaultsAreNamed) {
  const PoseComponent half{0.5, {}};
  EXPECT_EQ(fault_of(PoseMixture{{half, half}}), std::nullopt);
  EXPECT_EQ(*fault_of(PoseMixture{{half, half, half}}), "its weights add up to 1.500000, not to 1");
  EXPECT_EQ(*fault_of(PoseMixture{}), "it has 0 components, not 1 to 64");
  EXPECT_EQ(*fault_of(PoseMixture{{{1.5, {}}, {-0.5, {}}}}),
            "component 1 has the weight -0.500000, which is not positive");
  PoseMixture skew{{half, half}};
  skew.components[1].pose.covariance(0, 1) = 1;
  EXPECT_EQ(*fault_of(skew), "the matrix of component 1 is no covariance");
  skew.components[0].pose.mean.q.w = 2;
  EXPECT_EQ(*fault_of(skew), "the mean of component 0 is no pose");
  EXPECT_TRUE(fault_of(PoseMixture{std::vector<PoseComponent>(65, {1.0 / 65, {}})}));
  EXPECT_THROW(reduce(PoseMixture{{half, half}}, 0), Error);
  EXPECT_THROW(compose(PoseMixture{{half, half}}, PoseMixture{{half, half}}, 65), Error);
}

// log(exp(d) exp(xi)) by the Jacobian and by finite differences.
TEST(Matrix6, AfterADisplacementAgreesWithDifferences) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 50; ++i) {
    const Vector6 d = numbers_of(logarithm(random_pose(random)));
    if (std::hypot(d[0], d[1], d[2]) > 3.0) continue;  // differences would cross half a turn
    const Matrix6 J = after_displacement(d);
    const Pose D = exponential(twist_of(d), 1);
    constexpr double kStep = 1e-5;
    for (std::size_t k = 0; k < 6; ++k) {
      Vector6 forward = {}, back = {};
      forward[k] = kStep, back[k] = -kStep;
      const Vector6 u = numbers_of(logarithm(compose(D, exponential(twist_of(forward), 1))));
      const Vector6 v = numbers_of(logarithm(compose(D, exponential(twist_of(back), 1))));
      for (std::size_t j = 0; j < 6; ++j) {
        EXPECT_NEAR(J(j, k), (u[j] - v[j]) / (2 * kStep), 1e-5 * (1 + std::abs(J(j, k))));
      }
    }
  }
}

TEST(Matrix6, RootsAndDeterminantsAreEigens) {
  std::mt19937_64 random(9);
  for (int i = 0; i < 50; ++i) {
    const Covariance S = random_covariance(random, 0.3, 2);
    const Matrix6 L = root_of(S);
    EXPECT_LT((eigen(L) * eigen(L).transpose() - eigen(S)).norm(), 1e-12 * eigen(S).norm());
    const Factored factored(S);
    const EigenMatrix6 widened = eigen(S) + kNarrowest * kNarrowest * EigenMatrix6::Identity();
    EXPECT_NEAR(factored.log_determinant(), std::log(widened.determinant()), 1e-6);
    const Vector6 x = numbers_of(logarithm(random_pose(random)));
    const Eigen::Map<const EigenVector6> e(x.data());
    const double expected = e.dot(widened.ldlt().solve(e));
    EXPECT_NEAR(factored.square_length(x), expected, 1e-6 * expected);
  }
  Covariance rank_one;
  rank_one(2, 2) = 0.04;
  EXPECT_NEAR(root_of(rank_one)(2, 0), 0.2, 1e-15);
}

}  // namespace
}  // namespace sinew::world
