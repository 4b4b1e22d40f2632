// Freshness policies to their ends, and prediction: every model against its formula, and the same
// whether the world predicts or the requester does.
#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "allocations.h"
#include "random_poses.h"
#include "sinew/world/edit.h"
#include "sinew/world/reading.h"
#include "sinew/world/world.h"
#include "times_and_places.h"

namespace sinew::world {
namespace {

struct Seen {
  explicit Seen(MeasurementModel model = {
                    .life_cycle = TimeDependent{.validity = std::chrono::seconds(1)}}) {
    seen = world.add_measurement({.name = "http://x/m", .relation = r, .model = std::move(model)});
  }
  PoseQuery query(Policy policy) const { return {.of = b, .with_respect_to = a, .policy = policy}; }
  World world;
  FrameId a = world.add_frame("http://x/a"), b = world.add_frame("http://x/b");
  RelationId r = world.add_relation({.name = "http://x/r", .of = b, .with_respect_to = a});
  MeasurementId seen;
};

// The same expired value, and the three things that can be done about it.
TEST(Freshness, EachPolicyDoesItsPartAndNoMore) {
  Seen s;
  s.world.write(s.seen, at_s(0), Pose{{}, {5, 0, 0}}, {});
  const PoseAnswer informed = s.world.prepare_pose(s.query(Policy::kInform)).latest(at_s(9));
  EXPECT_EQ(informed.status, Status::kOk);
  EXPECT_EQ(informed.pose.p.x, 5);
  EXPECT_EQ(informed.freshness.rate, 0);
  EXPECT_EQ(informed.freshness.currency, std::chrono::seconds(9));
  EXPECT_EQ(informed.freshness.expires, at_s(1));
  EXPECT_EQ(s.world.prepare_pose(s.query(Policy::kFilter)).latest(at_s(9)).status,
            Status::kExpired);
  // On the edge it still holds.
  EXPECT_EQ(s.world.prepare_pose(s.query(Policy::kFilter)).latest(at_s(1)).status, Status::kOk);
  EXPECT_EQ(s.world.prepare_pose(s.query(Policy::kFilter)).latest(at_s(1) + Duration(1)).status,
            Status::kExpired);
}

TEST(Freshness, AnExpiryDateEndsItWhateverTheValidity) {
  Seen s({.life_cycle = TimeDependent{.validity = std::chrono::seconds(10), .expiry = at_s(3)}});
  s.world.write(s.seen, at_s(0), Pose{}, {});
  PreparedPose filter = s.world.prepare_pose(s.query(Policy::kFilter));
  EXPECT_EQ(filter.latest(at_s(3)).status, Status::kOk);
  EXPECT_EQ(filter.latest(at_s(3.1)).status, Status::kExpired);
  EXPECT_EQ(filter.latest(at_s(3)).freshness.expires, at_s(3));
}

// The share of ingredients that hold, and the age of the oldest and of the newest.
TEST(Freshness, OfSeveralIngredients) {
  World world;
  FrameId last = world.add_frame("http://x/0");
  const FrameId first = last;
  std::vector<MeasurementId> seen;
  for (int i = 1; i <= 4; ++i) {
    const std::string number = std::to_string(i);
    const FrameId next = world.add_frame("http://x/" + number);
    const RelationId r =
        world.add_relation({.name = "http://x/r" + number, .of = next, .with_respect_to = last});
    seen.push_back(world.add_measurement(
        {.name = "http://x/m" + number,
         .relation = r,
         .model = {.life_cycle = TimeDependent{.validity = std::chrono::seconds(i)},
                   .period = std::chrono::milliseconds(500)}}));
    last = next;
  }
  for (int i = 0; i < 4; ++i)
    world.write(seen[static_cast<std::size_t>(i)], at_s(0.1 * i), Pose{}, {});
  const Freshness found = world.pose(last, first, at_s(2.25)).freshness;
  EXPECT_EQ(found.rate, 0.5);  // valid until 1, 2.1, 3.2, 4.3
  EXPECT_EQ(found.currency, duration_of_seconds(2.25));
  EXPECT_EQ(found.timeliness, duration_of_seconds(1.95));
  EXPECT_EQ(found.obsolescence, 4u + 4u + 4u + 3u);
  EXPECT_EQ(found.expires, at_s(1));
}

TEST(Freshness, WaitingEndsAtItsDeadlineAndNotLater) {
  Seen s;
  s.world.write(s.seen, at_s(0), Pose{}, {});
  int asked = 0;
  Stamp now = at_s(5);
  const PoseAnswer answer =
      s.world.wait_for_pose(s.query(Policy::kWait), std::chrono::seconds(1), [&] {
        ++asked;
        return now += std::chrono::milliseconds(100);
      });
  EXPECT_EQ(answer.status, Status::kTimeOut);
  EXPECT_EQ(now, at_s(5) + std::chrono::milliseconds(1100));  // the first look that is not before
  EXPECT_EQ(asked, 11);
  // Nothing measured, and no way at all: the same.
  const FrameId lost = s.world.add_frame("http://x/lost");
  EXPECT_EQ(s.world
                .wait_for_pose({.of = lost, .with_respect_to = s.a}, std::chrono::milliseconds(1),
                               [&] { return now += std::chrono::milliseconds(1); })
                .status,
            Status::kTimeOut);
}

TEST(Freshness, WaitingSeesWhatAnotherThreadWrites) {
  Seen s;
  std::thread writer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    s.world.write(s.seen, system_now(), Pose{{}, {7, 0, 0}}, {});
  });
  const PoseAnswer answer =
      s.world.wait_for_pose(s.query(Policy::kWait), std::chrono::seconds(20), system_now);
  writer.join();
  EXPECT_EQ(answer.status, Status::kOk);
  EXPECT_EQ(answer.pose.p.x, 7);
}

// With kWait a real-time thread gets what there is at once: expired, not waited for.
TEST(Freshness, ARealTimeThreadNeverWaits) {
  Seen s;
  s.world.write(s.seen, at_s(0), Pose{}, {});
  PreparedPose prepared = s.world.prepare_pose(s.query(Policy::kWait));
  PreparedMotion motion = s.world.prepare_motion(s.query(Policy::kWait));
  const std::size_t before = allocations();
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 10000; ++i) {
    ASSERT_EQ(prepared.latest_realtime(at_s(5)).status, Status::kExpired);
    ASSERT_EQ(prepared.at_realtime(at_s(5)).status, Status::kTooNew);
    ASSERT_EQ(motion.latest_realtime(at_s(5)).status, Status::kNoMotion);
  }
  EXPECT_EQ(allocations(), before);
  // Thirty thousand answers: one wait of 200 us each would be six seconds.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3));
}

// ---- prediction ----

Twist random_twist(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const auto n = [&] { return normal(random); };
  return {{n(), n(), n()}, {n(), n(), n()}};
}

std::vector<PredictionModel> pose_models(std::mt19937_64& random) {
  return {ConstantVelocity{.twist = random_twist(random)}, ConstantVelocity{},
          ConstantAcceleration{.twist = random_twist(random), .twist_rate = random_twist(random)},
          Conveyor{{0.5, -0.25, 0}},
          UserModel{"sinking", [](const double* last, double t, double* predicted) {
                      std::copy(last, last + 7, predicted);
                      predicted[6] -= 0.5 * 9.81 * t * t;
                    }}};
}

// Whoever takes the model predicts to the last bit what the world answers.
TEST(Prediction, IsTheSameForWhoTakesTheModel) {
  std::mt19937_64 random(1);
  for (PredictionModel& model : pose_models(random)) {
    Seen s({.life_cycle = Prediction{model, std::chrono::seconds(3)}});
    const Pose before = random_pose(random), last = random_pose(random);
    s.world.write(s.seen, at_s(1), before, {});
    s.world.write(s.seen, at_s(1.5), last, {});
    double last_numbers[7], before_numbers[7];
    store_pose(last, last_numbers);
    store_pose(before, before_numbers);
    const auto taken = s.world.model(s.seen);
    const auto& own = std::get<Prediction>(taken->life_cycle);
    PreparedPose query = s.world.prepare_pose(s.query(Policy::kInform));
    for (const double t : {0.0, 0.001, 0.7, 3.0}) {
      double predicted[7];
      ASSERT_TRUE(predict(own.model, true, 7, last_numbers, before_numbers, 0.5,
                          seconds_of(at_s(1.5 + t) - at_s(1.5)), predicted));
      const PoseAnswer answer = query.latest(at_s(1.5 + t));
      ASSERT_EQ(answer.status, Status::kOk);
      EXPECT_EQ(answer.freshness.predicted, t > 0);
      if (t == 0) {
        EXPECT_EQ(difference(answer.pose, last), 0);
        continue;
      }
      EXPECT_EQ(s.world.latest(s.seen, at_s(1.5 + t)).values,
                std::vector<double>(predicted, predicted + 7));
      EXPECT_LT(difference(answer.pose, load_pose(predicted)), 1e-14);
      EXPECT_EQ(difference(query.at(at_s(1.5 + t)).pose, answer.pose), 0);
    }
    EXPECT_EQ(query.latest(at_s(4.6)).status, Status::kBeyondHorizon);
    // In real time without allocation.
    const std::size_t allocated = allocations();
    ASSERT_EQ(query.latest_realtime(at_s(2)).status, Status::kOk);
    EXPECT_EQ(allocations(), allocated);
  }
}

// An acceleration whose axis turns, against ten thousand small steps of the same motion.
TEST(Prediction, ConstantAccelerationIsTheIntegralOfItsTwist) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 20; ++i) {
    const ConstantAcceleration model{.twist = random_twist(random),
                                     .twist_rate = random_twist(random)};
    const Pose begin = random_pose(random);
    double last[7], predicted[7];
    store_pose(begin, last);
    constexpr double kSeconds = 0.5;
    ASSERT_TRUE(predict(model, true, 7, last, nullptr, 0, kSeconds, predicted));
    Pose X = begin;
    constexpr int kSteps = 10000;
    for (int k = 0; k < kSteps; ++k) {
      const double t = (k + 0.5) * kSeconds / kSteps;
      const Twist V{model.twist.angular + t * model.twist_rate.angular,
                    model.twist.linear + t * model.twist_rate.linear};
      X = compose(X, exponential(V, kSeconds / kSteps));
    }
    EXPECT_LT(difference(load_pose(predicted), X), 2e-3);
  }
}

TEST(Prediction, OfNumbersGoesByTheirOwnRates) {
  World world;
  const FrameId a = world.add_frame("http://x/a"), b = world.add_frame("http://x/b");
  const RelationId hinge = world.add_relation(
      {.name = "http://x/hinge", .of = b, .with_respect_to = a, .kind = RelationKind::kRevolute});
  const auto joint = [&](const char* name, PredictionModel model) {
    return world.add_measurement({.name = name,
                                  .relation = hinge,
                                  .quantity = Quantity::kJointPosition,
                                  .model = {.life_cycle = Prediction{std::move(model)}}});
  };
  const MeasurementId rated = joint("http://x/rated", ConstantVelocity{.rates = {0.5}});
  const MeasurementId estimated = joint("http://x/estimated", ConstantVelocity{});
  const MeasurementId braking =
      joint("http://x/braking", ConstantAcceleration{.rates = {1}, .accelerations = {-0.5}});
  const MeasurementId belt = joint("http://x/belt", Conveyor{{1, 0, 0}});
  const MeasurementId own =
      joint("http://x/own", UserModel{"sine", [](const double* last, double t, double* predicted) {
                                        predicted[0] = last[0] + std::sin(t);
                                      }});
  const MeasurementId wrong = joint("http://x/wrong", ConstantVelocity{.rates = {1, 2}});
  const double zero[] = {0.25}, one[] = {1.25};
  for (const MeasurementId each : {rated, estimated, braking, belt, own, wrong}) {
    world.write(each, at_s(1), zero, {});
    EXPECT_EQ(world.latest(each, at_s(2)).status,
              each == estimated || each == belt || each == wrong ? Status::kNoModel : Status::kOk);
    world.write(each, at_s(2), one, {});
  }
  EXPECT_NEAR(world.latest(rated, at_s(4)).values[0], 1.25 + 2 * 0.5, 1e-15);
  EXPECT_NEAR(world.latest(estimated, at_s(4)).values[0], 1.25 + 2 * 1.0, 1e-15);
  EXPECT_NEAR(world.latest(braking, at_s(4)).values[0], 1.25 + 2 - 0.25 * 4, 1e-15);
  EXPECT_NEAR(world.latest(own, at_s(4)).values[0], 1.25 + std::sin(2.0), 1e-15);
  EXPECT_EQ(world.latest(belt, at_s(4)).status, Status::kNoModel);
}

}  // namespace
}  // namespace sinew::world
