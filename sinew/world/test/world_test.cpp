// The world model by example: structure, values, ways, time, attachment.
#include "sinew/world/world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "random_poses.h"
#include "refusal.h"
#include "sinew/graph/store.h"
#include "sinew/world/edit.h"
#include "times_and_places.h"

namespace sinew::world {
namespace {

constexpr WriteContext kCamera{"http://cell/camera"};
constexpr WriteContext kConfiguration{"http://cell/configuration"};

// A table, a camera over it, and a part that the camera sees.
struct Scene {
  World world;
  FrameId table = world.add_frame("http://cell/table");
  FrameId camera = world.add_frame("http://cell/camera-frame");
  FrameId part = world.add_frame("http://cell/part");
  MeasurementId mounted = world.add_static("http://cell/mounting", camera, table,
                                           translation(0, 0, 2), kConfiguration.provenance);
  RelationId seen_pose =
      world.add_relation({.name = "http://cell/seen-pose", .of = part, .with_respect_to = camera});
  MeasurementId seen = world.add_measurement(
      {.name = "http://cell/seen",
       .relation = seen_pose,
       .model = {.life_cycle = TimeDependent{.validity = std::chrono::milliseconds(100)},
                 .provenance = std::string(kCamera.provenance),
                 .period = std::chrono::milliseconds(40)}});
};

TEST(World, AnswersThroughMeasuredAndConstantRelations) {
  Scene s;
  EXPECT_EQ(s.world.pose(s.part, s.table, at_s(1)).status, Status::kNoData);
  ASSERT_EQ(s.world.write(s.seen, at_s(1), translation(0.5, 0, -1.5), kCamera), Status::kOk);
  const PoseAnswer answer = s.world.pose(s.part, s.table, at_s(1));
  ASSERT_EQ(answer.status, Status::kOk);
  EXPECT_LT(difference(answer.pose, translation(0.5, 0, 0.5)), 1e-15);
  const PoseAnswer back = s.world.pose(s.table, s.part, at_s(1));
  EXPECT_LT(difference(back.pose, translation(-0.5, 0, -0.5)), 1e-15);
}

TEST(World, ComposesConstantsOnceWhenAQueryIsPrepared) {
  Scene s;
  s.world.write(s.seen, at_s(1), Pose{}, kCamera);
  PreparedPose query = s.world.prepare_pose({.of = s.part, .with_respect_to = s.table});
  EXPECT_EQ(query.measured_steps(), 1u);
  const auto steps = query.symbolic();
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0].operation, "compose");
  EXPECT_EQ(steps[0].relation, "http://cell/mounting");
  EXPECT_TRUE(steps[0].constant);
  EXPECT_EQ(steps[1].measurement, "http://cell/seen");
  EXPECT_FALSE(steps[1].constant);
}

TEST(Freshness, ComesWithEveryAnswer) {
  Scene s;
  s.world.write(s.seen, at_s(1), Pose{}, kCamera);
  PreparedPose inform = s.world.prepare_pose({.of = s.part, .with_respect_to = s.table});
  const PoseAnswer fresh = inform.latest(at_s(1.05));
  EXPECT_EQ(fresh.freshness.currency, std::chrono::milliseconds(50));
  EXPECT_EQ(fresh.freshness.timeliness, std::chrono::milliseconds(50));
  EXPECT_EQ(fresh.freshness.obsolescence, 1u);  // one update of 40 ms was due
  EXPECT_EQ(fresh.freshness.rate, 1.0);
  EXPECT_EQ(fresh.freshness.expires, at_s(1.1));
  const PoseAnswer old = inform.latest(at_s(1.2));
  EXPECT_EQ(old.status, Status::kOk);  // informs, and leaves the decision to who asks
  EXPECT_EQ(old.freshness.rate, 0.0);
  PreparedPose filter =
      s.world.prepare_pose({.of = s.part, .with_respect_to = s.table, .policy = Policy::kFilter});
  EXPECT_EQ(filter.latest(at_s(1.05)).status, Status::kOk);
  EXPECT_EQ(filter.latest(at_s(1.2)).status, Status::kExpired);
}

TEST(Freshness, WaitingEndsWithAFreshAnswerOrInTime) {
  Scene s;
  s.world.write(s.seen, at_s(1), Pose{}, kCamera);
  Stamp now = at_s(2);
  const PoseQuery query{.of = s.part, .with_respect_to = s.table, .policy = Policy::kWait};
  EXPECT_EQ(s.world
                .wait_for_pose(query, std::chrono::milliseconds(5),
                               [&] { return now += std::chrono::milliseconds(1); })
                .status,
            Status::kTimeOut);
  int asked = 0;
  const PoseAnswer answer = s.world.wait_for_pose(query, std::chrono::seconds(5), [&] {
    if (++asked == 3) s.world.write(s.seen, now, translation(1, 0, 0), kCamera);
    return now;
  });
  EXPECT_EQ(answer.status, Status::kOk);
  EXPECT_LT(difference(answer.pose, translation(1, 0, 2)), 1e-15);
}

TEST(Time, IsInterpolatedAndNeverExtrapolatedWithoutAModel) {
  Scene s;
  s.world.write(s.seen, at_s(1), translation(0, 0, 0), kCamera);
  s.world.write(s.seen, at_s(2), translation(1, 0, 0), kCamera);
  PreparedPose query = s.world.prepare_pose({.of = s.part, .with_respect_to = s.camera});
  EXPECT_NEAR(query.at(at_s(1.25)).pose.p.x, 0.25, 1e-15);
  EXPECT_EQ(query.at(at_s(1)).pose.p.x, 0.0);
  EXPECT_EQ(query.at(at_s(2)).pose.p.x, 1.0);
  const PoseAnswer late = query.at(at_s(2.5));
  EXPECT_EQ(late.status, Status::kTooNew);
  EXPECT_EQ(late.bounds.measurement, s.seen);
  EXPECT_EQ(late.bounds.oldest, at_s(1));
  EXPECT_EQ(late.bounds.newest, at_s(2));
  const PoseAnswer early = query.at(at_s(0.5));
  EXPECT_EQ(early.status, Status::kTooOld);
  EXPECT_EQ(early.bounds.oldest, at_s(1));
}

TEST(Time, KeepsAsManyEntriesAsDeclaredAndDropsTheOldest) {
  World world;
  const FrameId a = world.add_frame("http://x/a"), b = world.add_frame("http://x/b");
  const RelationId r = world.add_relation({.name = "http://x/r", .of = b, .with_respect_to = a});
  const MeasurementId m =
      world.add_measurement({.name = "http://x/m", .relation = r, .capacity = 15});
  for (int i = 0; i < 100; ++i) world.write(m, at_s(i), translation(i, 0, 0), {});
  const auto sample = world.latest(m, at_s(100));
  EXPECT_EQ(sample.bounds.newest, at_s(99));
  EXPECT_EQ(sample.bounds.oldest, at_s(85));
  for (int i = 85; i < 99; ++i) {
    EXPECT_NEAR(world.at(m, at_s(i + 0.5)).values[4], i + 0.5, 1e-12) << i;
  }
  EXPECT_EQ(world.at(m, at_s(84)).status, Status::kTooOld);
}

TEST(Time, PastStampsAreCorrected) {
  World world;
  const FrameId a = world.add_frame("http://x/a"), b = world.add_frame("http://x/b");
  const RelationId r = world.add_relation({.name = "http://x/r", .of = b, .with_respect_to = a});
  const MeasurementId m =
      world.add_measurement({.name = "http://x/m", .relation = r, .capacity = 7});
  for (const double t : {1.0, 2.0, 4.0}) world.write(m, at_s(t), translation(t, 0, 0), {});
  // One that came late is put in its place.
  EXPECT_EQ(world.write(m, at_s(3), translation(10, 0, 0), {}), Status::kOk);
  EXPECT_NEAR(world.at(m, at_s(3)).values[4], 10, 0);
  EXPECT_NEAR(world.at(m, at_s(2.5)).values[4], 6, 1e-15);
  EXPECT_NEAR(world.latest(m, at_s(5)).values[4], 4, 0);
  // One that was wrong is replaced, the last one too.
  world.write(m, at_s(2), translation(-2, 0, 0), {});
  EXPECT_NEAR(world.at(m, at_s(2)).values[4], -2, 0);
  world.write(m, at_s(4), translation(-4, 0, 0), {});
  EXPECT_NEAR(world.latest(m, at_s(5)).values[4], -4, 0);
  // Before all that is kept: there is room for it, until the ring is full.
  EXPECT_EQ(world.write(m, at_s(0.5), translation(0, 0, 0), {}), Status::kOk);
  for (int i = 5; i < 20; ++i) world.write(m, at_s(i), translation(i, 0, 0), {});
  EXPECT_EQ(world.write(m, at_s(0.25), translation(0, 0, 0), {}), Status::kTooLate);
}

TEST(Prediction, TellsWhatComesAfterTheLastEntryUpToItsHorizon) {
  World world;
  const FrameId belt = world.add_frame("http://x/belt"), box = world.add_frame("http://x/box");
  const RelationId r =
      world.add_relation({.name = "http://x/r", .of = box, .with_respect_to = belt});
  const auto measurement = [&](const char* name, PredictionModel model) {
    return world.add_measurement(
        {.name = name,
         .relation = r,
         .model = {.life_cycle = Prediction{std::move(model), std::chrono::seconds(2)},
                   .provenance = name}});
  };
  const MeasurementId conveyor = measurement("http://x/conveyor", Conveyor{{0.5, 0, 0}});
  const MeasurementId turning =
      measurement("http://x/turning", ConstantVelocity{.twist = Twist{{0, 0, 1}, {1, 0, 0}}});
  const MeasurementId estimated = measurement("http://x/estimated", ConstantVelocity{});
  const MeasurementId falling = measurement(
      "http://x/falling",
      ConstantAcceleration{.twist = Twist{{}, {1, 0, 0}}, .twist_rate = Twist{{}, {0, 0, -9.81}}});
  const MeasurementId user = measurement(
      "http://x/user", UserModel{"quadratic", [](const double* last, double t, double* predicted) {
                                   std::copy(last, last + 7, predicted);
                                   predicted[4] += t * t;
                                 }});
  const auto ask = [&](const char* who, double t) {
    return world
        .prepare_pose({.of = box,
                       .with_respect_to = belt,
                       .choice = Choice::kByProvenance,
                       .provenances = {who}})
        .latest(at_s(t));
  };
  const Quaternion quarter{0, 0, std::sqrt(0.5), std::sqrt(0.5)};
  world.write(conveyor, at_s(1), Pose{quarter, {1, 0, 0}}, {});
  const PoseAnswer moved = ask("http://x/conveyor", 2);
  ASSERT_EQ(moved.status, Status::kOk);
  EXPECT_TRUE(moved.freshness.predicted);
  EXPECT_LT(difference(moved.pose, {quarter, {1.5, 0, 0}}), 1e-15);
  EXPECT_EQ(ask("http://x/conveyor", 3.5).status, Status::kBeyondHorizon);

  // A circle of radius 1 in one turn of 2 pi seconds.
  world.write(turning, at_s(0), Pose{}, {});
  EXPECT_LT(difference(ask("http://x/turning", M_PI / 2).pose, {quarter, {1, 1, 0}}), 1e-9);

  world.write(estimated, at_s(0), translation(0, 0, 0), {});
  EXPECT_EQ(ask("http://x/estimated", 1).status, Status::kNoModel);  // one entry has no velocity
  world.write(estimated, at_s(1), translation(1, 2, 0), {});
  EXPECT_LT(difference(ask("http://x/estimated", 2).pose, translation(2, 4, 0)), 1e-12);

  world.write(falling, at_s(0), Pose{}, {});
  EXPECT_LT(difference(ask("http://x/falling", 1).pose, translation(1, 0, -0.5 * 9.81)), 1e-12);

  world.write(user, at_s(0), translation(1, 0, 0), {});
  EXPECT_NEAR(ask("http://x/user", 1.5).pose.p.x, 1 + 2.25, 1e-15);

  // The requester takes the model and predicts by himself.
  const auto model = world.model(conveyor);
  double last[7] = {0, 0, 0, 1, 0, 0, 0};
  double predicted[7];
  EXPECT_TRUE(predict(std::get<Prediction>(model->life_cycle).model, true, 7, last, nullptr, 0, 4,
                      predicted));
  EXPECT_EQ(predicted[4], 2.0);
}

TEST(Ways, LoopsAreAllowedAndTheWayIsChosen) {
  World world;
  std::vector<FrameId> f;
  for (const char* name : {"a", "b", "c", "d"}) {
    f.push_back(world.add_frame(std::string("http://x/") + name));
  }
  // a - b - c - d and a - d directly, which disagree by 1 cm.
  const auto link = [&](const char* name, FrameId of, FrameId to, Pose X, double deviation) {
    const RelationId r = world.add_relation({.name = name, .of = of, .with_respect_to = to});
    const MeasurementId m = world.add_measurement({.name = std::string(name) + "/m",
                                                   .relation = r,
                                                   .model = {.standard_deviation = deviation}});
    world.write(m, at_s(0), X, {});
    return r;
  };
  link("http://x/ab", f[1], f[0], translation(1, 0, 0), 0.001);
  link("http://x/bc", f[2], f[1], translation(1, 0, 0), 0.001);
  link("http://x/cd", f[3], f[2], translation(1, 0, 0), 0.001);
  const RelationId direct = link("http://x/ad", f[3], f[0], translation(3.01, 0, 0), 0.02);
  const auto ask = [&](PoseQuery query) {
    query.of = f[3];
    query.with_respect_to = f[0];
    return world.prepare_pose(query).latest(at_s(0)).pose.p.x;
  };
  EXPECT_NEAR(ask({}), 3.01, 1e-15);
  EXPECT_NEAR(ask({.way = Way::kMostCertain}), 3.0, 1e-15);
  EXPECT_NEAR(ask({.via = {f[1]}}), 3.0, 1e-15);
  EXPECT_NEAR(ask({.avoid = {direct}}), 3.0, 1e-15);
}

TEST(Ways, OneOfSeveralMeasurementsIsChosenByPolicy) {
  World world;
  const FrameId a = world.add_frame("http://x/a"), b = world.add_frame("http://x/b");
  const RelationId r = world.add_relation({.name = "http://x/r", .of = b, .with_respect_to = a});
  const auto add = [&](const char* name, double deviation) {
    return world.add_measurement({.name = std::string("http://x/") + name,
                                  .relation = r,
                                  .model = {.provenance = name, .standard_deviation = deviation}});
  };
  const MeasurementId camera = add("camera", 0.01), laser = add("laser", 0.001);
  add("never-written", 0.0001);
  world.write(camera, at_s(2), translation(2, 0, 0), {});
  world.write(laser, at_s(1), translation(1, 0, 0), {});
  const auto ask = [&](PoseQuery query) {
    query.of = b;
    query.with_respect_to = a;
    return world.prepare_pose(query).latest(at_s(2)).pose.p.x;
  };
  EXPECT_EQ(ask({.choice = Choice::kFreshest}), 2);
  EXPECT_EQ(ask({.choice = Choice::kMostCertain}), 1);
  EXPECT_EQ(ask({.choice = Choice::kByProvenance, .provenances = {"camera", "laser"}}), 2);
  EXPECT_EQ(ask({.choice = Choice::kByProvenance, .provenances = {"laser"}}), 1);
  EXPECT_EQ(world
                .prepare_pose({.of = b,
                               .with_respect_to = a,
                               .choice = Choice::kByProvenance,
                               .provenances = {"nobody"}})
                .status(),
            Status::kNotConnected);
  world.write(laser, at_s(3), translation(3, 0, 0), {});
  EXPECT_EQ(ask({.choice = Choice::kFreshest}), 3);
}

TEST(Structure, ChangesAreNoticedByPreparedQueries) {
  Scene s;
  s.world.write(s.seen, at_s(1), Pose{}, kCamera);
  PreparedPose query = s.world.prepare_pose({.of = s.part, .with_respect_to = s.table});
  EXPECT_EQ(query.latest(at_s(1)).status, Status::kOk);
  s.world.add_frame("http://cell/another");
  EXPECT_FALSE(query.is_current());
  const PoseAnswer old_plan = query.latest_realtime(at_s(1));
  EXPECT_EQ(old_plan.status, Status::kOk);
  EXPECT_TRUE(old_plan.structure_changed);
  EXPECT_FALSE(query.latest(at_s(1)).structure_changed);
  s.world.remove(s.part);
  EXPECT_EQ(query.latest_realtime(at_s(1)).status, Status::kOk);  // as long as nobody refreshes
  EXPECT_EQ(query.latest(at_s(1)).status, Status::kRemoved);
  EXPECT_FALSE(s.world.find_relation("http://cell/seen-pose"));
  EXPECT_FALSE(s.world.find_measurement("http://cell/seen"));
  EXPECT_TRUE(s.world.find_frame("http://cell/table"));
}

TEST(Structure, AnEditIsWholeOrNothing) {
  Scene s;
  const std::uint64_t version = s.world.structure_version();
  {
    Edit edit = s.world.edit();
    edit.add_frame("http://cell/half");
  }
  EXPECT_FALSE(s.world.find_frame("http://cell/half"));
  EXPECT_EQ(s.world.structure_version(), version);
  Edit edit = s.world.edit();
  const FrameId tray = edit.add_frame("http://cell/tray");
  edit.add_static("http://cell/tray-pose", tray, s.table, translation(1, 1, 0), "http://x");
  edit.commit();
  EXPECT_EQ(s.world.structure_version(), version + 1);
  EXPECT_EQ(s.world.pose(tray, s.table, at_s(0)).pose.p.x, 1);
}

TEST(Structure, FaultsAreNamed) {
  Scene s;
  EXPECT_NE(refusal([&] {
              s.world.add_frame("http://cell/table");
            }).find("http://cell/table: there is a frame of this name"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              s.world.add_relation(
                  {.name = "http://cell/self", .of = s.table, .with_respect_to = s.table});
            }).find("with itself"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              s.world.add_measurement({.name = "http://cell/q",
                                       .relation = s.seen_pose,
                                       .quantity = Quantity::kJointPosition});
            }).find("cannot measure"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              s.world.write(s.seen, at_s(0), std::vector<double>{1}, kCamera);
            }).find("1 numbers for a pose"),
            std::string::npos);
  EXPECT_EQ(s.world.write(s.seen, at_s(0), Pose{{1, 1, 0, 0}, {}}, kCamera), Status::kNotANumber);
  EXPECT_EQ(s.world.write(s.mounted, at_s(0), Pose{}, kConfiguration), Status::kStatic);
}

TEST(Guard, RefusesWritesByProvenance) {
  Scene s;
  s.world.set_write_guard([](MeasurementId, std::string_view, const MeasurementModel& model,
                             std::string_view who) -> std::optional<std::string> {
    if (model.provenance == who) return std::nullopt;
    return "written by " + std::string(who) + ", declared to come from " + model.provenance;
  });
  EXPECT_EQ(s.world.write(s.seen, at_s(0), Pose{}, kCamera), Status::kOk);
  EXPECT_NE(refusal([&] {
              s.world.write(s.seen, at_s(1), Pose{}, kConfiguration);
            }).find("http://cell/seen: written by http://cell/configuration"),
            std::string::npos);
  EXPECT_NE(refusal([&] { s.world.claim(s.seen, kConfiguration); }).find("declared to come from"),
            std::string::npos);
}

// The hose adaptor is grasped, carried, and put down.
TEST(Attach, KeepsThePoseAndChangesTheParent) {
  std::mt19937_64 random(5);
  for (int run = 0; run < 50; ++run) {
    Scene s;
    const FrameId gripper = s.world.add_frame("http://cell/gripper");
    const RelationId arm = s.world.add_relation(
        {.name = "http://cell/arm", .of = gripper, .with_respect_to = s.table});
    const MeasurementId controller =
        s.world.add_measurement({.name = "http://cell/controller", .relation = arm});
    s.world.write(s.seen, at_s(1), random_pose(random), kCamera);
    s.world.write(controller, at_s(1), random_pose(random), {});
    const Pose before = s.world.pose(s.part, s.table, at_s(1)).pose;

    s.world.attach(s.part, gripper, at_s(1), "http://cell/gripper-driver");
    EXPECT_LT(difference(s.world.pose(s.part, s.table, at_s(1)).pose, before), 1e-12);
    // Moving the arm moves the part; what the camera still sees of it does not count.
    const Pose held = s.world.pose(s.part, gripper, at_s(1)).pose;
    const Pose moved = random_pose(random);
    s.world.write(controller, at_s(2), moved, {});
    s.world.write(s.seen, at_s(2), random_pose(random), kCamera);
    const Pose carried = s.world.pose(s.part, s.table, at_s(2)).pose;
    EXPECT_LT(difference(carried, compose(moved, held)), 1e-12);

    s.world.detach(s.part, s.camera, at_s(3), "http://cell/gripper-driver");
    EXPECT_LT(difference(s.world.pose(s.part, s.table, at_s(3)).pose, carried), 1e-12);
    s.world.write(controller, at_s(4), random_pose(random), {});
    EXPECT_LT(difference(s.world.pose(s.part, s.table, at_s(4)).pose, carried), 1e-12);
    // The camera takes over with its next picture.
    const Pose seen = random_pose(random);
    s.world.write(s.seen, at_s(5), seen, kCamera);
    EXPECT_LT(difference(s.world.pose(s.part, s.table, at_s(5)).pose,
                         compose(translation(0, 0, 2), seen)),
              1e-12);
  }
}

TEST(Attach, DetachesToAFrameThatItHadNoRelationTo) {
  Scene s;
  const FrameId shelf = s.world.add_frame("http://cell/shelf");
  s.world.add_static("http://cell/shelf-pose", shelf, s.table, translation(2, 0, 0), "x");
  s.world.write(s.seen, at_s(1), Pose{}, kCamera);
  s.world.attach(s.part, s.table, at_s(1), "x");
  EXPECT_NE(refusal([&] { s.world.attach(s.table, s.part, at_s(1), "x"); }).find("carries"),
            std::string::npos);
  const RelationId left = s.world.detach(s.part, shelf, at_s(2), "x");
  EXPECT_EQ(s.world.name(left), "http://cell/part/left-at/shelf");
  EXPECT_NEAR(s.world.pose(s.part, shelf, at_s(2)).pose.p.x, -2, 1e-15);
  EXPECT_NE(refusal([&] { s.world.detach(s.part, s.table, at_s(2), "x"); }).find("not attached"),
            std::string::npos);
}

TEST(Graph, DescribesTheStructureAndFollowsIt) {
  Scene s;
  graph::Store& store = s.world.graph();
  const auto id = [&](const std::string& iri) { return store.terms().find_iri(iri); };
  const std::string w = "https://w3id.org/sinew/world#";
  const graph::View view = store.view();
  EXPECT_TRUE(
      view.contains(id("http://cell/seen-pose"), id(w + "measured-by"), id("http://cell/seen")));
  EXPECT_TRUE(
      view.contains(id("http://cell/seen"), id(w + "provenance"), id("http://cell/camera")));
  EXPECT_TRUE(
      view.contains(id("http://cell/seen-pose"),
                    id("https://comp-rob2b.github.io/metamodels/geometry/spatial-relations#of"),
                    id("http://cell/part")));
  s.world.add_object("http://cell/adaptor", s.part, "http://cell/hose-adaptor-model");
  EXPECT_TRUE(store.view().contains(id("http://cell/adaptor"), id(w + "instance-of"),
                                    id("http://cell/hose-adaptor-model")));
  s.world.remove(s.seen_pose);
  EXPECT_FALSE(store.view().contains(id("http://cell/seen-pose"), id(w + "measured-by"),
                                     id("http://cell/seen")));
  EXPECT_EQ(store.view().object(id("http://cell/seen"), id(w + "quantity")), graph::Id{});
}

}  // namespace
}  // namespace sinew::world
