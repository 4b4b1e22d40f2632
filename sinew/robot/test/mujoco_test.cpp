#include "sinew/robot/mujoco.h"

#include <cmath>
#include <thread>

#include "gen3.h"

namespace sinew::robot::test {
namespace {

using runtime::Event;
using runtime::Host;
using runtime::State;

constexpr const char* kFrame = "link7-root";

Scene bent() {
  Scene scene;
  scene.start = {{"position.joint2", 0.5}, {"position.joint4", 1.0}, {"position.joint6", 0.4}};
  return scene;
}

std::shared_ptr<Mujoco> lockstep(const Gen3& gen3, Scene scene) {
  MujocoOptions options;
  options.scene = std::move(scene);
  options.lockstep_period_s = 0.001;
  return std::make_shared<Mujoco>(gen3.tree, gen3.store.terms(), options);
}

double position(const Host& host, int joint) {
  return host.read("main", "position.joint" + std::to_string(joint))[0];
}

TEST(Mujoco, StandsStillUnderItsOwnGravityCompensation) {
  Gen3 gen3;
  const auto robot = lockstep(gen3, bent());
  const auto host = gen3.host("gravity", "mujoco", robot);
  host->configure();
  host->step(1000);
  EXPECT_NEAR(robot->signal(Mujoco::Signal::kTime), 1.0, 1e-9);
  EXPECT_NEAR(position(*host, 2), 0.5, 1e-3);
  EXPECT_NEAR(position(*host, 4), 1.0, 1e-3);
  EXPECT_NEAR(position(*host, 6), 0.4, 1e-3);
}

TEST(Mujoco, SinksWhenItGraspsAnObjectThatTheProgramDoesNotKnow) {
  Gen3 gen3;
  Scene scene = bent();
  scene.object = Object{kFrame, 1.0, {0, 0, -0.1}, {0.002, 0.002, 0.002}};
  const auto robot = lockstep(gen3, scene);
  const auto host = gen3.host("gravity", "mujoco", robot);
  host->configure();
  host->step(200);
  const double before = position(*host, 2);
  EXPECT_NEAR(before, 0.5, 1e-3) << "it weighs nothing until it is grasped";
  robot->attach_object();
  host->step(300);
  EXPECT_EQ(robot->signal(Mujoco::Signal::kAttached), 1);
  EXPECT_GT(std::abs(position(*host, 2) - before), 0.02);
}

TEST(Mujoco, FollowsTheHandOfItsOperator) {
  Gen3 gen3;
  Scene scene = bent();
  scene.joint_damping = 0.5;
  scene.hand = Hand{kFrame,
                    5000,
                    200,
                    200,
                    {{"free", 0.2, {}, {}},
                     {"pushed down", 1.2, Vector{0, 0, -0.1}, {}},
                     {"held", 1.5, Vector{0, 0, 0}, {}}}};
  const auto robot = lockstep(gen3, scene);
  const auto host = gen3.host("gravity", "mujoco", robot);
  host->configure();
  host->step(100);
  EXPECT_EQ(robot->signal(Mujoco::Signal::kPhase), 1);
  EXPECT_EQ(robot->phase_name(1), "free");
  EXPECT_EQ(robot->signal(Mujoco::Signal::kHandZ), 0);
  host->step(500);
  EXPECT_EQ(robot->signal(Mujoco::Signal::kPhase), 2);
  EXPECT_LT(robot->signal(Mujoco::Signal::kHandZ), 0) << "it is pushed downwards";
  const double bent_by = position(*host, 2);
  host->step(700);
  EXPECT_GT(std::abs(position(*host, 2) - bent_by), 0.02);
  host->step(400);
  EXPECT_EQ(robot->signal(Mujoco::Signal::kPhase), 0) << "after the last";
}

TEST(Mujoco, RestsOnATable) {
  Gen3 gen3;
  Scene scene = bent();
  scene.joint_damping = 2;
  scene.tool = Tool{kFrame, 0.05};
  // Wide enough to be under the tool wherever the arm falls.
  scene.table = Table{{0, 0, 0.3}, {3, 3, 0.02}};
  const auto robot = lockstep(gen3, scene);
  const auto host = gen3.host("fpk", "mujoco", robot);  // commands nothing at all
  host->configure();
  EXPECT_EQ(robot->signal(Mujoco::Signal::kContact), 0);
  // Without commands the brakes stay on.
  host->step(100);
  EXPECT_EQ(robot->signal(Mujoco::Signal::kTime), 0);
  const double none = 0;
  std::vector<runtime::Transfer> commands;
  for (runtime::Channel i = 0; i < 7; ++i) commands.push_back({i, const_cast<double*>(&none), 1});
  for (int i = 0; i < 5000; ++i) {
    robot->write(commands);
    robot->end_cycle();
  }
  EXPECT_GT(robot->signal(Mujoco::Signal::kContact), 1) << "it lies on the table";
}

TEST(Mujoco, CutsCommandsAtTheMaximumForces) {
  Gen3 gen3;
  const auto robot = lockstep(gen3, {});
  double much = 1000;
  const runtime::Transfer command{0, &much, 1};
  robot->write({&command, 1});
  robot->end_cycle();
  EXPECT_GT(robot->signal(Mujoco::Signal::kCut), 0);
}

TEST(Mujoco, KeepsThePaceOfTheClockInAThreadOfItsOwn) {
  Gen3 gen3;
  MujocoOptions options;
  options.scene = bent();
  const auto robot = std::make_shared<Mujoco>(gen3.tree, gen3.store.terms(), options);
  const auto host =
      gen3.host("gravity", "mujoco", robot,
                {.age_limit_s = 5, .cycles = 300, .late = runtime::LateCycles::kCatchUp});
  host->configure();
  host->start();
  host->wait();
  EXPECT_EQ(host->state(), State::kConfigured);
  const double simulated =
      robot->signal(Mujoco::Signal::kTime) + robot->signal(Mujoco::Signal::kBehind);
  EXPECT_GT(simulated, 0.2);
  EXPECT_NEAR(position(*host, 4), 1.0, 1e-2);
}

TEST(Mujoco, TripsTheWatchdogWhenItStalls) {
  Gen3 gen3;
  MujocoOptions options;
  options.scene = bent();
  const auto robot = std::make_shared<Mujoco>(gen3.tree, gen3.store.terms(), options);
  const auto host = gen3.host("gravity", "mujoco", robot, {.age_limit_s = 0.3});
  host->configure();
  host->start();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(host->state(), State::kRunning);
  robot->stall();
  for (int i = 0; i < 400 && host->state() != State::kFaulted; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(host->state(), State::kFaulted);
  host->stop();
  const auto events = host->take_events();
  const auto stale = std::find_if(events.begin(), events.end(), [](const Event& event) {
    return event.kind == Event::Kind::kStale;
  });
  ASSERT_NE(stale, events.end());
  EXPECT_GT(stale->value, 0.3);
}

TEST(Mujoco, RefusesASceneThatDoesNotFit) {
  const Gen3 gen3;
  Scene scene;
  scene.start = {{"position.joint9", 1.0}};
  EXPECT_THROW(lockstep(gen3, scene), Error);
  scene.start = {{"joint1", 1.0}};
  EXPECT_THROW(lockstep(gen3, scene), Error);
  EXPECT_THROW(lockstep(gen3, {})->attach_object(), Error);
}

}  // namespace
}  // namespace sinew::robot::test
