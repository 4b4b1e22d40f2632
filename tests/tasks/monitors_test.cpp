// Monitors and guarded motions over time.
#include <gtest/gtest.h>

#include "loop.h"
#include "nodes.h"

namespace sinew::test {
namespace {

cli::QueryOptions pose() {
  cli::QueryOptions query;
  query.solver = "fpk";
  return query;
}

const std::string kTolerance =
    R"("tolerance": { "@id": "t:tolerance", "@type": "Quantity", "unit": "MilliM", "value": 100 })";

TEST(Monitors, LevelIsUpWithinTheTolerance) {
  Loop loop(watched("q", R"("@type": ["Monitor", "LevelTriggeredMonitor"], "flag": "t:near", )" +
                             kTolerance),
            pose());
  for (const double q : {-0.3, -0.11, -0.09, 0.0, 0.09, 0.11})
    EXPECT_EQ(loop.cycle({{"setpoint.q", q}})["flag.near"], std::abs(q) <= 0.1) << q;
}

TEST(Monitors, HysteresisKeepsTheFlagBetweenTheTolerances) {
  Loop loop(watched("q", R"("@type": ["Monitor", "LevelTriggeredMonitor"], "flag": "t:near", )" +
                             kTolerance + R"(, "release-tolerance": { "@id": "t:release",
                "@type": "Quantity", "unit": "M", "value": 0.2 })"),
            pose());
  const std::pair<double, double> cycles[] = {{0.15, 0}, {0.05, 1}, {0.15, 1}, {-0.19, 1},
                                              {0.21, 0}, {0.15, 0}, {-0.1, 1}, {0.3, 0}};
  for (const auto& [q, flag] : cycles)
    EXPECT_EQ(loop.cycle({{"setpoint.q", q}})["flag.near"], flag) << q;
}

struct EdgeCase {
  const char* edge;
  std::vector<double> events;
};

class Edges : public testing::TestWithParam<EdgeCase> {};

// The condition is false, true, true, false, false, true: what holds from the start rises at first.
TEST_P(Edges, SendTheirEventInOneCycleAlone) {
  Loop loop(watched("q", R"("@type": ["Monitor", "EdgeTriggeredMonitor"], "event": "t:event",
      "event-queue": "t:queue", "edge": ")" +
                             std::string(GetParam().edge) + "\", " + kTolerance),
            pose());
  const double q[] = {0.5, 0, 0, 0.5, 0.5, 0};
  for (std::size_t cycle = 0; cycle < 6; ++cycle)
    EXPECT_EQ(loop.cycle({{"setpoint.q", q[cycle]}})["event.event"], GetParam().events[cycle])
        << cycle;
}

INSTANTIATE_TEST_SUITE_P(All, Edges,
                         testing::Values(EdgeCase{"rising", {0, 1, 0, 0, 0, 1}},
                                         EdgeCase{"falling", {0, 0, 0, 1, 0, 0}},
                                         EdgeCase{"any", {0, 1, 0, 1, 0, 1}}),
                         [](const auto& info) { return info.param.edge; });

// A controller that works from the moment when `start` holds until `stop` does.
TEST(GuardedMotion, EnablesItsControllersAndStartsTheirIntegralsAnew) {
  const auto level = [](const std::string& id) {
    return watched(id, R"("@type": ["Monitor", "LevelTriggeredMonitor"], "flag": "t:)" + id +
                           R"(-holds", "tolerance": { "@id": "t:)" + id +
                           R"(-tolerance", "@type": "Quantity", "unit": "M", "value": 0.5 })");
  };
  Loop loop(level("start") + "," + level("safe") + "," + level("stop") + R"(,
    { "@id": "t:motion", "@type": "GuardedMotion", "when": "t:start-constraint",
      "while": "t:safe-constraint", "until": "t:stop-constraint" },)" +
                pid("", 0, 100, 0, "", R"(, "motion": "t:motion", "evaluators":
      ["t:start-evaluator", "t:safe-evaluator", "t:stop-evaluator"], "monitors":
      ["t:start-monitor", "t:safe-monitor", "t:stop-monitor"])"),
            pose());
  struct Cycle {
    int start, safe, stop;
    double force;  // of an integral that has seen so many errors of 1
  };
  const Cycle cycles[] = {
      {0, 1, 0, 0},                // waits
      {1, 1, 0, 1},                // begins: the integral starts from zero
      {0, 1, 0, 2},                // goes on, whether `start` holds or not
      {0, 1, 0, 3}, {0, 0, 0, 0},  // `safe` is lost: it waits again
      {0, 1, 0, 0},                // for `start`
      {1, 1, 0, 1},                // and begins anew
      {1, 1, 0, 2}, {1, 1, 1, 0},  // done
      {1, 1, 0, 0},                // for good
  };
  int number = 0;
  for (const Cycle& one : cycles) {
    const auto value = [](int holds) { return holds ? 0.0 : 1.0; };
    Values out = loop.cycle({{"setpoint.start", value(one.start)},
                             {"setpoint.safe", value(one.safe)},
                             {"setpoint.stop", value(one.stop)},
                             {"setpoint.error", 1}});
    EXPECT_NEAR(out["signal.force"], one.force, 1e-12) << "cycle " << number;
    ++number;
  }
}

}  // namespace
}  // namespace sinew::test
