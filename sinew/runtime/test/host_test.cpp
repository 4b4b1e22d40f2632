#include "sinew/runtime/host.h"

#include <gmock/gmock.h>

#include "fixture.h"
#include "sinew/backend/jit.h"

namespace sinew::runtime::test {
namespace {

using testing::HasSubstr;

class HostTest : public RuntimeTest {};

template <typename Call>
std::string fault_of(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST_F(HostTest, ReadsComputesKeepsStateAndWrites) {
  const auto m = model();
  const auto h = host(*m);
  h->step();
  EXPECT_EQ(robot_->command_, 1.0);  // 3 - 2
  EXPECT_EQ(h->read("main", "kept.joint1"), std::vector{-2.0});
  h->step();
  EXPECT_EQ(robot_->command_, 5.0);  // 3 + 2
  EXPECT_NEAR(h->read("main", "pose.link1")[0], std::cos(0.5), 1e-15);
}

TEST_F(HostTest, ComputesTheSameWithMachineCode) {
  if (std::string why; !backend::jit_available(&why)) GTEST_SKIP() << why;
  const auto m = model();
  HostOptions options;
  options.real_time = false;
  Host h(options);
  h.bindings() = bindings_;
  h.add_task({"main", 1}, executable(*m, false));
  h.set("main", "given.joint1", std::array{3.0});
  h.configure();
  h.step(2);
  EXPECT_EQ(robot_->command_, 5.0);
}

TEST_F(HostTest, DoesNotConfigureWhileAnInputHasNoSource) {
  const auto m = model();
  Host h({});
  h.bindings() = bindings_;
  h.add_task({"main", 1}, executable(*m));
  EXPECT_THAT(fault_of([&] { h.configure(); }), HasSubstr("given.joint1"));
  EXPECT_EQ(h.state(), State::kIdle);
  EXPECT_THAT(fault_of([&] { h.set("main", "force.joint1", std::array{3.0}); }),
              HasSubstr("it has given.joint1"));
}

TEST_F(HostTest, FollowsItsLifeCycle) {
  const auto m = model();
  const auto h = host(*m);
  EXPECT_EQ(h->state(), State::kConfigured);
  EXPECT_THAT(fault_of([&] { h->configure(); }), HasSubstr("it is configured"));
  h->start();
  EXPECT_EQ(h->state(), State::kRunning);
  EXPECT_THAT(fault_of([&] { h->start(); }), HasSubstr("it is running"));
  h->stop();
  EXPECT_EQ(h->state(), State::kConfigured);
  EXPECT_EQ(robot_->command_, -7.0);  // the safe command is the last one
}

TEST_F(HostTest, AGuardKeepsItFromStarting) {
  const auto m = model();
  const auto h = host(*m);
  bool brakes_released = false;
  h->add_guard([&]() -> std::optional<std::string> {
    if (brakes_released) return std::nullopt;
    return "the brakes are on";
  });
  EXPECT_THAT(fault_of([&] { h->start(); }), HasSubstr("the brakes are on"));
  brakes_released = true;
  h->start();
  h->stop();
}

TEST_F(HostTest, RunsAsManyCyclesAsAskedForAndCountsThem) {
  const auto m = model();
  const auto h = host(*m, {.period_s = 1e-3, .cycles = 50, .late = LateCycles::kCatchUp});
  const Nanoseconds began = now();
  h->start();
  h->wait();
  EXPECT_GE(now() - began, 50 * 1'000'000);
  EXPECT_EQ(h->statistics().cycles, 50u);
  EXPECT_EQ(h->statistics().missed, 0u);
  EXPECT_EQ(h->statistics().lateness->count(), 50u);
  EXPECT_EQ(robot_->writes, 51u);  // and the safe command
}

TEST_F(HostTest, LeavesOutCyclesThatHavePassedAndSaysSo) {
  const auto m = model();
  const auto h = host(*m, {.period_s = 1e-6, .cycles = 200000, .late = LateCycles::kSkip});
  h->start();
  h->wait();
  const HostStatistics statistics = h->statistics();
  // No machine runs a cycle in a microsecond with its wake-up.
  EXPECT_GT(statistics.missed, 0u);
  EXPECT_GE(statistics.cycles + statistics.missed, 200000u);
  bool told = false;
  for (const Event& event : h->take_events()) told |= event.kind == Event::Kind::kOverrun;
  EXPECT_TRUE(told);
}

TEST_F(HostTest, AStalledRobotGetsItsSafeCommandInsteadOfOneFromStaleMeasurements) {
  const auto m = model();
  const auto h = host(*m, {.period_s = 1e-3, .age_limit_s = 0.02, .late = LateCycles::kCatchUp});
  robot_->taken = now();
  robot_->stalled = true;
  h->start();
  for (int i = 0; i < 200 && h->state() != State::kFaulted; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(h->state(), State::kFaulted);
  EXPECT_EQ(robot_->command_, -7.0);
  const std::uint64_t cycles = h->statistics().cycles;
  for (int i = 0; i < 200 && h->statistics().cycles == cycles; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_GT(h->statistics().cycles, cycles) << "the loop goes on with the safe command";
  h->stop();
  const auto events = h->take_events();
  ASSERT_GE(events.size(), 2u);
  EXPECT_EQ(events[0].kind, Event::Kind::kStale);
  EXPECT_GT(events[0].value, 0.02);
  EXPECT_EQ(events[1].kind, Event::Kind::kFaulted);
  EXPECT_EQ(h->state(), State::kFaulted);
  EXPECT_NE(fault_of([&] { h->start(); }), "");
  robot_->stalled = false;
  h->reset();
  h->step();
  EXPECT_EQ(robot_->command_, 1.0) << "states begin anew";
}

TEST_F(HostTest, ACheckThatStopsEndsTheCommandsBeforeTheyAreWritten) {
  const auto m = model();
  weave(*m, "check",
        "a so:check-range ; so:quantity ( ?force ) ; sa:lower -4.0 ; sa:upper 4.0 ; "
        "sa:action sa:stop");
  const auto h = host(*m);
  h->step();
  EXPECT_EQ(robot_->command_, 1.0);
  h->step();  // would command 5
  EXPECT_EQ(robot_->command_, -7.0);
  EXPECT_EQ(h->state(), State::kFaulted);
  const auto events = h->take_events();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].kind, Event::Kind::kOutOfRange);
  EXPECT_EQ(events[0].value, 5.0);
  EXPECT_STREQ(events[0].about.data(), "force.joint1");
}

TEST_F(HostTest, ACheckThatReportsOnlyTells) {
  const auto m = model();
  weave(*m, "check",
        "a so:check-range ; so:quantity ( ?force ) ; sa:lower -4.0 ; sa:upper 4.0 ; "
        "sa:action sa:report");
  const auto h = host(*m);
  h->step(2);
  EXPECT_EQ(robot_->command_, 5.0);
  EXPECT_EQ(h->state(), State::kConfigured);
  EXPECT_EQ(h->take_events().size(), 1u);
}

TEST_F(HostTest, RefusesClosuresThatAreNotFullyStated) {
  const auto refused = [&](const std::string& says) {
    const auto m = model();
    weave(*m, "closure", says);
    return fault_of([&] { executable(*m); });
  };
  EXPECT_THAT(refused("a so:check-range ; so:quantity ( ?force ) ; sa:lower 0 ; sa:action sa:stop"),
              HasSubstr("has no sa:upper"));
  EXPECT_THAT(refused("a so:check-range ; so:quantity ( ?force ) ; sa:lower 0 ; sa:upper 1"),
              HasSubstr("has no sa:action"));
  EXPECT_THAT(refused("a so:check-range ; so:quantity ( ?force ) ; sa:lower 2 ; sa:upper 1 ; "
                      "sa:action sa:stop"),
              HasSubstr("the lower limit comes first"));
  EXPECT_THAT(refused("a so:check-range ; so:quantity ( ?pose ) ; sa:lower ( 1 2 ) ; sa:upper 1 ; "
                      "sa:action sa:stop"),
              HasSubstr("2 numbers for 12"));
  EXPECT_THAT(refused("a so:log ; so:quantity ( ?force )"), HasSubstr("no recorder"));
}

// An outer loop at a third of the rate feeds the inner one.
TEST_F(HostTest, RunsTasksAtDifferentRates) {
  const auto outer = model(), inner = model(0.0);
  HostOptions options;
  options.real_time = false;
  Host h(options);
  h.bindings() = bindings_;
  h.add_task({"outer", 3}, executable(*outer));
  h.add_task({"inner", 1}, executable(*inner));
  h.connect({"outer", "force.joint1", "inner", "given.joint1"});
  h.set("outer", "given.joint1", std::array{10.0});
  h.configure();
  std::vector<double> seen;
  for (int i = 0; i < 7; ++i) {
    h.step();
    seen.push_back(h.read("inner", "force.joint1")[0]);
  }
  EXPECT_EQ(seen, (std::vector<double>{8, 8, 8, 12, 12, 12, 8}));
}

TEST_F(HostTest, RefusesAConnectionOfUnlikeBlocks) {
  const auto outer = model(), inner = model();
  Host h({});
  h.bindings() = bindings_;
  h.add_task({"outer", 1}, executable(*outer));
  h.add_task({"inner", 1}, executable(*inner));
  h.connect({"outer", "pose.link1", "inner", "given.joint1"});
  EXPECT_THAT(fault_of([&] { h.configure(); }), HasSubstr("do not mean the same"));
}

TEST_F(HostTest, TakesSetPointsWhileItRuns) {
  const auto m = model(0.0);
  const auto h = host(*m);
  h->start();
  h->set("main", "given.joint1", std::array{42.0});
  for (int i = 0; i < 400 && robot_->command_ != 42.0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(robot_->command_, 42.0);
  h->stop();
}

}  // namespace
}  // namespace sinew::runtime::test
