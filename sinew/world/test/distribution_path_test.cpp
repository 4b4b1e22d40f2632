// Mixtures and particles along the way of a query, against Monte Carlo over the world's own
// queries; the policies that choose by certainty; distributions that are measured.
#include <gtest/gtest.h>

#include "random_gaussians.h"
#include "random_poses.h"
#include "sinew/base/error.h"
#include "sinew/world/edit.h"
#include "sinew/world/uncertain_path.h"

namespace sinew::world {
namespace {

constexpr Stamp kThen{std::chrono::seconds(1)};

// base -(constant)-> shelf <-(seen)- part -(held)-> grip: `seen` is walked against its direction.
struct Shelf {
  Shelf() {
    std::mt19937_64 random(1);
    base = world.add_frame("http://x/base");
    const FrameId shelf = world.add_frame("http://x/shelf");
    part = world.add_frame("http://x/part");
    grip = world.add_frame("http://x/grip");
    constant =
        world.add_static("http://x/shelf-on-base", shelf, base, random_pose(random), "http://x/me");
    const RelationId seeing =
        world.add_relation({.name = "http://x/seeing", .of = shelf, .with_respect_to = part});
    const RelationId holding =
        world.add_relation({.name = "http://x/holding", .of = grip, .with_respect_to = part});
    seen = world.add_measurement({.name = "http://x/seen", .relation = seeing});
    held = world.add_measurement({.name = "http://x/held", .relation = holding});
    known.set_exact(constant);
    X_seen = random_pose(random);
    X_held = random_pose(random);
    world.write(seen, kThen, X_seen, {"me"});
    world.write(held, kThen, X_held, {"me"});
  }
  PoseQuery query() const { return {.of = grip, .with_respect_to = base}; }
  World world;
  Uncertainties known;
  FrameId base, part, grip;
  MeasurementId constant, seen, held;
  Pose X_seen, X_held;
};

// A displacement: a part that lies as seen, or turned by a quarter about z.
PoseMixture two_sides(std::mt19937_64& random) {
  return {{{0.7, {Pose(), random_covariance(random, 0.05, 0.02)}},
           {0.3, {revolute(0.6), random_covariance(random, 0.05, 0.02)}}}};
}

TEST(DistributedPath, CarriesMixturesAndParticlesAsMonteCarloDoes) {
  std::mt19937_64 random(2);
  const PoseMixture side = two_sides(random);
  const GaussianPose slip{Pose(), random_covariance(random, 0.05, 0.02)};
  const Draw first(side.components[0].pose), second(side.components[1].pose), slips(slip);
  std::bernoulli_distribution is_second(side.components[1].weight);

  const PoseDistribution seen_as[] = {side, draw(side, 4000, 3)};
  for (const PoseDistribution& uncertain : seen_as) {
    Shelf cell;
    cell.known.set_distribution(cell.world, cell.seen, uncertain);
    cell.known.set_distribution(cell.world, cell.held, slip);
    const DistributedPose answer =
        pose_distribution(cell.world, cell.query(), cell.known, kThen, {.seed = 4});
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer.pose.index(), uncertain.index());
    const auto found = gaussian_of(answer.pose);
    ASSERT_TRUE(found);

    World clone = cell.world.clone();
    PreparedPose query = clone.prepare_pose(cell.query());
    int draws = 0;
    const Covariance drawn = monte_carlo(found->mean, 20000, [&] {
      const Stamp at = kThen + std::chrono::milliseconds(++draws);
      const Pose D = is_second(random) ? second(random) : first(random);
      clone.write(cell.seen, at, compose(cell.X_seen, D), {"me"});
      clone.write(cell.held, at, compose(cell.X_held, slips(random)), {"me"});
      return query.latest(at).pose;
    });
    EXPECT_LT(apart(found->covariance, drawn), uncertain.index() == 2 ? 0.04 : 0.12);
  }
}

TEST(DistributedPath, AMixtureOfOneAnswersAsTheGaussianDoes) {
  std::mt19937_64 random(5);
  Shelf cell;
  const Covariance S = random_covariance(random, 0.1, 0.1);
  cell.known.set(cell.world, cell.held, isotropic(0.01, 0.01));
  cell.known.set(cell.world, cell.seen, S);
  const UncertainPose gaussian = uncertain_pose(cell.world, cell.query(), cell.known, kThen);
  cell.known.set_distribution(cell.world, cell.seen, PoseMixture{{{1, {Pose(), S}}}});
  const DistributedPose mixture = pose_distribution(cell.world, cell.query(), cell.known, kThen);
  ASSERT_TRUE(gaussian && mixture);
  const auto one = gaussian_of(mixture.pose);
  EXPECT_LT(difference(one->mean, gaussian.pose.mean), 1e-14);
  EXPECT_LT(apart(one->covariance, gaussian.pose.covariance), 1e-12);
}

TEST(DistributedPath, WhatIsNotDefinedIsRefused) {
  std::mt19937_64 random(6);
  Shelf cell;
  cell.known.set_distribution(cell.world, cell.seen, two_sides(random));
  cell.known.set(cell.world, cell.held, isotropic(0.01, 0.01));
  // One Gaussian is asked, and it is a mixture.
  EXPECT_THROW(uncertain_pose(cell.world, cell.query(), cell.known, kThen), Error);
  // Particles and a Gaussian, without a seed.
  cell.known.set_distribution(cell.world, cell.seen, draw(two_sides(random), 100, 1));
  EXPECT_THROW(pose_distribution(cell.world, cell.query(), cell.known, kThen), Error);
  EXPECT_TRUE(pose_distribution(cell.world, cell.query(), cell.known, kThen, {.seed = 1}));
  // With only exact ones beside them nothing is drawn.
  cell.known.set_exact(cell.held);
  EXPECT_TRUE(pose_distribution(cell.world, cell.query(), cell.known, kThen));
  // No distribution of a pose, or of nothing that is one.
  EXPECT_THROW(cell.known.set_distribution(cell.world, cell.seen, PoseMixture{}), Error);
  EXPECT_THROW(cell.known.set_distribution(cell.world, cell.seen, PoseParticles{{{0.5, {}}}}),
               Error);
  EXPECT_THROW(cell.known.set_distribution(cell.world, cell.seen, Pose{{0, 0, 0, 2}, {}}), Error);
}

TEST(DistributedPath, TheMostCertainIsChosenAmongAllKinds) {
  std::mt19937_64 random(7);
  Shelf cell;
  const RelationId holding = cell.world.find_relation("http://x/holding");
  // Whatever the models state, what is declared here counts.
  const auto add = [&](const char* name, double stated) {
    const MeasurementId made = cell.world.add_measurement(
        {.name = name, .relation = holding, .model = {.standard_deviation = stated}});
    cell.world.write(made, kThen, random_pose(random), {"me"});
    return made;
  };
  const MeasurementId mixed = add("http://x/mixed", 0.001), guessed = add("http://x/guessed", 0.5);
  cell.known.set(cell.world, cell.held, isotropic(0.05, 0.05));
  cell.known.set_distribution(
      cell.world, mixed,
      PoseMixture{{{0.5, {Pose(), isotropic(0.01, 0.01)}},
                   {0.5, {Pose{{}, {1, 0, 0}}, isotropic(0.01, 0.01)}}}});  // half a metre apart
  cell.known.set_distribution(cell.world, guessed,
                              draw(PoseMixture{{{1, {Pose(), isotropic(0.01, 0.01)}}}}, 500, 8));
  const PoseQuery query{
      .of = cell.grip, .with_respect_to = cell.part, .choice = Choice::kMostCertain};
  EXPECT_EQ(pose_distribution(cell.world, query, cell.known, kThen).pose.index(), 3u);
  cell.known.set_distribution(cell.world, guessed,
                              draw(PoseMixture{{{1, {Pose(), isotropic(0.2, 0.2)}}}}, 500, 8));
  EXPECT_EQ(pose_distribution(cell.world, query, cell.known, kThen).pose.index(), 1u);
  cell.known.set_distribution(cell.world, mixed, PoseMixture{{{1, {Pose(), isotropic(0.01, 0)}}}});
  EXPECT_EQ(pose_distribution(cell.world, query, cell.known, kThen).pose.index(), 2u);
  // The world itself is as it was.
  EXPECT_EQ(cell.world.model(mixed)->standard_deviation, 0.001);
}

// A detector writes its hypotheses beside the pose, both as one.
TEST(DistributedPath, ADistributionMayBeMeasured) {
  std::mt19937_64 random(9);
  Shelf cell;
  cell.known.set_exact(cell.held);
  const std::uint32_t room = numbers_of_components(2);
  const MeasurementId numbers =
      cell.world.add_measurement({.name = "http://x/hypotheses",
                                  .relation = cell.world.find_relation("http://x/seeing"),
                                  .quantity = Quantity::kOther,
                                  .values = room});
  cell.known.set_measured(cell.world, cell.seen, numbers);
  EXPECT_THROW(cell.known.set_measured(cell.world, cell.held, numbers), Error);
  EXPECT_THROW(cell.known.set_measured(cell.world, cell.seen, cell.held), Error);

  // Not written yet: the answer says so.
  DistributedPose answer = pose_distribution(cell.world, cell.query(), cell.known, kThen);
  ASSERT_EQ(answer.undeclared.size(), 1u);
  EXPECT_EQ(answer.undeclared[0], "http://x/seen");

  const PoseMixture sides = two_sides(random);
  const auto write = [&](Stamp at, const PoseMixture& hypotheses) {
    const Pose& X = cell.X_seen;
    const double pose[] = {X.q.x, X.q.y, X.q.z, X.q.w, X.p.x, X.p.y, X.p.z};
    const std::vector<double> coded = to_numbers(hypotheses, room);
    const World::Value both[] = {{cell.seen, pose}, {numbers, coded}};
    return cell.world.write_together(at, both, {"me"});
  };
  const Stamp next = kThen + std::chrono::seconds(1);
  ASSERT_EQ(write(next, sides), Status::kOk);
  answer = pose_distribution(cell.world, cell.query(), cell.known, next);
  ASSERT_TRUE(answer);
  EXPECT_EQ(std::get<PoseMixture>(answer.pose).components.size(), 2u);
  const World before = cell.world.clone();
  ASSERT_EQ(write(next + std::chrono::seconds(1), {{{1, sides.components[1].pose}}}), Status::kOk);
  answer = pose_distribution(cell.world, cell.query(), cell.known, next + std::chrono::seconds(1));
  EXPECT_EQ(std::get<PoseMixture>(answer.pose).components.size(), 1u);
  // A clone keeps its own.
  answer = pose_distribution(before, cell.query(), cell.known, next);
  EXPECT_EQ(std::get<PoseMixture>(answer.pose).components.size(), 2u);
  // A pose that came without its hypotheses is not given those of another.
  cell.world.write(cell.seen, next + std::chrono::seconds(2), cell.X_seen, {"me"});
  answer = pose_distribution(cell.world, cell.query(), cell.known, next + std::chrono::seconds(2));
  EXPECT_EQ(answer.undeclared.size(), 1u);
}

// At a time of the past: the pose between entries, the declared covariance about it, and a measured
// distribution at its own stamps only.
TEST(DistributedPath, OfThePastIsThePoseOfThen) {
  std::mt19937_64 random(10);
  Shelf cell;
  const std::uint32_t room = numbers_of_components(2);
  const MeasurementId numbers =
      cell.world.add_measurement({.name = "http://x/hypotheses",
                                  .relation = cell.world.find_relation("http://x/seeing"),
                                  .quantity = Quantity::kOther,
                                  .values = room});
  cell.known.set(cell.world, cell.held, isotropic(0.02, 0.03));
  cell.known.set(cell.world, cell.seen, isotropic(0.01, 0.01));
  for (int i = 1; i <= 5; ++i) {
    const Stamp at = kThen + std::chrono::seconds(i);
    const Pose X = random_pose(random);
    const double pose[] = {X.q.x, X.q.y, X.q.z, X.q.w, X.p.x, X.p.y, X.p.z};
    PoseMixture sides = two_sides(random);
    sides.components[0].weight = 1 - 0.1 * i, sides.components[1].weight = 0.1 * i;
    const std::vector<double> coded = to_numbers(sides, room);
    const World::Value both[] = {{cell.seen, pose}, {numbers, coded}};
    ASSERT_EQ(cell.world.write_together(at, both, {"me"}), Status::kOk);
    ASSERT_EQ(cell.world.write(cell.held, at, random_pose(random), {"me"}), Status::kOk);
  }
  PreparedPose query = cell.world.prepare_pose(cell.query());
  const Stamp between = kThen + std::chrono::milliseconds(2300);
  DistributedPose answer = pose_distribution_at(cell.world, cell.query(), cell.known, between);
  ASSERT_TRUE(answer);
  EXPECT_EQ(difference(std::get<GaussianPose>(answer.pose).mean, query.at(between).pose), 0);
  EXPECT_GT(difference(query.at(between).pose, query.latest(between).pose), 0.01);
  EXPECT_EQ(
      pose_distribution_at(cell.world, cell.query(), cell.known, kThen - std::chrono::seconds(1))
          .status,
      Status::kTooOld);

  cell.known.set_measured(cell.world, cell.seen, numbers);
  answer = pose_distribution_at(cell.world, cell.query(), cell.known, between);
  EXPECT_EQ(answer.undeclared, (std::vector<std::string>{"http://x/seen"}));
  for (int i = 1; i <= 5; ++i) {
    answer =
        pose_distribution_at(cell.world, cell.query(), cell.known, kThen + std::chrono::seconds(i));
    ASSERT_TRUE(answer);
    EXPECT_NEAR(std::get<PoseMixture>(answer.pose).components[1].weight, 0.1 * i, 1e-12);
  }
}

}  // namespace
}  // namespace sinew::world
