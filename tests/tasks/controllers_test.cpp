// Controllers over time, each against a reference written here. The arm takes no part: its pose is
// asked along with them, so that there is something to solve.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "loop.h"
#include "nodes.h"

namespace sinew::test {
namespace {

cli::QueryOptions pose() {
  cli::QueryOptions query;
  query.solver = "fpk";
  return query;
}

TEST(Controllers, DampingFollowsItsFormula) {
  Loop loop(setpoint("speed", "M-PER-SEC") + "," + constant("top-speed", "M-PER-SEC", 0.1) + "," +
                constant("top-force", "N", 10) + "," + quantity("force", "N") + R"(,
    { "@id": "t:damper", "@type": ["Controller", "DampingController"],
      "measured-velocity": "t:speed", "maximum-velocity": "t:top-speed",
      "maximum-force": "t:top-force", "control-signal": "t:force" })",
            pose());
  for (double v = -0.3; v < 0.3; v += 0.01)
    EXPECT_NEAR(loop.cycle({{"setpoint.speed", v}})["signal.force"], 10 - 100 * v, 1e-12);
  EXPECT_EQ(loop.program().closures.back().operation, "damping");
}

// u = kp e + ki i + kd r with i' = i + e dt, r = (e - e_before) / dt.
TEST(Controllers, PidRespondsToAStepAsTheTextbookSays) {
  Loop loop(pid("", 50, 20, 3, ""), pose());
  double integral = 0, before = 0;
  for (int cycle = 0; cycle < 200; ++cycle) {
    const double error = cycle < 20 ? 0.0 : cycle < 120 ? 1.0 : std::sin(0.1 * cycle);
    integral += error * 0.01;
    const double rate = cycle == 0 ? 0 : (error - before) / 0.01;
    before = error;
    EXPECT_NEAR(loop.cycle({{"setpoint.error", error}})["signal.force"],
                50 * error + 20 * integral + 3 * rate, 1e-9)
        << cycle;
  }
}

TEST(Controllers, PidGivesNoKickInTheFirstCycle) {
  Loop loop(pid("", 50, 0, 3, ""), pose());
  EXPECT_NEAR(loop.cycle({{"setpoint.error", 1.0}})["signal.force"], 50, 1e-12);
}

TEST(Controllers, PidWithoutIntegralAndRateKeepsNoState) {
  Loop loop(pid("", 50, 0, 0, ""), pose());
  EXPECT_EQ(program::interface_of(loop.program()).state_size, 0u);
  EXPECT_NEAR(loop.cycle({{"setpoint.error", 0.5}})["signal.force"], 25, 1e-12);
}

TEST(Controllers, DecayingIntegralSettlesAndForgets) {
  Loop loop(pid(R"(, "DecayingIntegralTerm")", 0, 20, 0,
                R"(, "decay-rate": { "@id": "t:decay", "@type": "Quantity", "unit": "PER-SEC",
                   "value": 4 })"),
            pose());
  double integral = 0;
  for (int cycle = 0; cycle < 600; ++cycle) {
    const double error = cycle < 400 ? 1 : 0;
    integral = (integral + error * 0.01) / (1 + 4 * 0.01);
    const double force = loop.cycle({{"setpoint.error", error}})["signal.force"];
    EXPECT_NEAR(force, 20 * integral, 1e-10);
    if (cycle == 399) {
      EXPECT_NEAR(force, 20 * 1 / 4.0, 1e-5);  // ki e / lambda
    }
  }
}

// A large error saturates the control; when the error turns, the control leaves its limit at once,
// whereas an integral that had gone on would hold it there.
TEST(Controllers, AntiWindupLetsGoWhenTheErrorTurns) {
  Loop loop(pid("", 1, 20, 0,
                R"(, "output-limit": { "@id": "t:limit", "@type": "Quantity", "unit": "N",
                   "value": 5 })"),
            pose());
  double integral = 0, naive = 0;
  for (int cycle = 0; cycle < 400; ++cycle) {
    const double error = cycle < 300 ? 2 : -0.5;
    const double next = integral + error * 0.01, raw = error + 20 * next;
    const bool winds = std::abs(raw) > 5 && 20 * error * raw > 0;
    if (!winds) integral = next;
    naive += error * 0.01;
    const double force = loop.cycle({{"setpoint.error", error}})["signal.force"];
    EXPECT_NEAR(force, std::clamp(raw, -5.0, 5.0), 1e-10) << cycle;
    if (cycle == 302) {
      EXPECT_LT(force, 5);
      EXPECT_GT(error + 20 * naive, 5);
    }
  }
}

TEST(Controllers, SpringDamperIsAnImpedanceOfOneAxis) {
  Loop loop(setpoint("error", "M") + "," + setpoint("speed", "M-PER-SEC") + "," +
                constant("k", "N-PER-M", 300) + "," + constant("d", "N-SEC-PER-M", 20) + "," +
                quantity("force", "N") + R"(,
    { "@id": "t:c", "@type": ["Controller", "ImpedanceController"], "error-signal": "t:error",
      "measured-velocity": "t:speed", "stiffness": "t:k", "damping": "t:d",
      "control-signal": "t:force" })",
            pose());
  EXPECT_NEAR(loop.cycle({{"setpoint.error", 0.1}, {"setpoint.speed", 0.5}})["signal.force"],
              300 * 0.1 - 20 * 0.5, 1e-12);
}

// f = k e + d (v_d - v) + m (a_d - a), with what is stated of it.
TEST(Controllers, ImpedanceFollowsAMotionAndShapesAnInertia) {
  const std::string parts = setpoint("error", "M") + "," + setpoint("speed", "M-PER-SEC") + "," +
                            setpoint("wanted-speed", "M-PER-SEC") + "," +
                            setpoint("acceleration", "M-PER-SEC2") + "," +
                            setpoint("wanted-acceleration", "M-PER-SEC2") + "," +
                            constant("k", "N-PER-M", 300) + "," + constant("d", "N-SEC-PER-M", 20) +
                            "," + constant("m", "KiloGM", 4) + "," + quantity("force", "N");
  const auto force = [&](const std::string& more, const Values& in) {
    std::string nodes = parts + R"(,
    { "@id": "t:c", "@type": ["Controller", "ImpedanceController"], "error-signal": "t:error",
      "measured-velocity": "t:speed", "stiffness": "t:k", "damping": "t:d",
      "control-signal": "t:force")" +
                        more + " }";
    return Loop(nodes, pose()).cycle(in)["signal.force"];
  };
  const std::string moving = R"(, "desired-velocity": "t:wanted-speed")";
  const std::string heavy = moving + R"(, "inertia": "t:m")";
  Values in = {{"setpoint.error", 0.1}, {"setpoint.speed", 0.5}, {"setpoint.wanted-speed", 0.8}};
  EXPECT_NEAR(force(moving, in), 300 * 0.1 + 20 * (0.8 - 0.5), 1e-12);
  in["setpoint.wanted-acceleration"] = 2.5;
  EXPECT_NEAR(force(heavy + R"(, "desired-acceleration": "t:wanted-acceleration")", in),
              300 * 0.1 + 20 * (0.8 - 0.5) + 4 * 2.5, 1e-12);
  in["setpoint.acceleration"] = -1.5;
  EXPECT_NEAR(force(heavy + R"(, "desired-acceleration": "t:wanted-acceleration",
                              "measured-acceleration": "t:acceleration")",
                    in),
              300 * 0.1 + 20 * (0.8 - 0.5) + 4 * (2.5 + 1.5), 1e-12);
  in.erase("setpoint.wanted-acceleration");
  EXPECT_NEAR(force(heavy + R"(, "measured-acceleration": "t:acceleration")", in),
              300 * 0.1 + 20 * (0.8 - 0.5) + 4 * 1.5, 1e-12);
}

// Position -> velocity at every fifth cycle, velocity -> force at each: the outer one's result is
// held, its integral advances by its own period.
TEST(Controllers, CascadeRunsItsOuterLoopSlower) {
  const std::string outer =
      setpoint("position-error", "M") + "," + quantity("speed-goal", "M-PER-SEC") + "," +
      constant("okp", "PER-SEC", 4) + "," + constant("oki", "PER-SEC2", 2) + "," +
      constant("okd", "UNITLESS", 0) + "," + constant("slow", "MilliSEC", 50) + R"(,
  { "@id": "t:outer", "@type": ["Controller", "ProportionalIntegralDerivative"],
    "error-signal": "t:position-error", "control-signal": "t:speed-goal",
    "proportional-gain": { "@id": "t:okp" }, "integral-gain": { "@id": "t:oki" },
    "derivative-gain": { "@id": "t:okd" } },
  { "@id": "t:outer-handler", "@type": "ConstraintHandler", "controllers": "t:outer",
    "period": "t:slow" },)";
  const std::string inner = setpoint("speed", "M-PER-SEC") + "," +
                            quantity("speed-error", "M-PER-SEC") + "," + quantity("force", "N") +
                            "," + constant("ikp", "N-SEC-PER-M", 30) + "," +
                            constant("iki", "N-PER-M", 10) + "," + constant("ikd", "KiloGM", 0) +
                            "," + constant("fast", "MilliSEC", 10) + R"(,
  { "@id": "t:speed-constraint", "@type": ["Constraint", "EqualityConstraint"],
    "quantity": "t:speed", "reference-value": "t:speed-goal" },
  { "@id": "t:speed-evaluator", "@type": ["ConstraintEvaluator", "ErrorEvaluator"],
    "constraint": "t:speed-constraint", "error": "t:speed-error" },
  { "@id": "t:inner", "@type": ["Controller", "ProportionalIntegralDerivative"],
    "error-signal": "t:speed-error", "control-signal": "t:force",
    "proportional-gain": { "@id": "t:ikp" }, "integral-gain": { "@id": "t:iki" },
    "derivative-gain": { "@id": "t:ikd" } },
  { "@id": "t:inner-handler", "@type": "ConstraintHandler", "evaluators": "t:speed-evaluator",
    "controllers": "t:inner", "period": "t:fast" })";
  Loop loop(outer + inner, pose());
  double outer_integral = 0, inner_integral = 0, goal = 0;
  for (int cycle = 0; cycle < 60; ++cycle) {
    const double error = 0.5 - 0.01 * cycle, speed = 0.02 * cycle;
    if (cycle % 5 == 0) {
      outer_integral += error * 0.05;
      goal = 4 * error + 2 * outer_integral;
    }
    const double speed_error = goal - speed;
    inner_integral += speed_error * 0.01;
    Values out = loop.cycle({{"setpoint.position-error", error}, {"setpoint.speed", speed}});
    EXPECT_NEAR(out["signal.speed-goal"], goal, 1e-11) << cycle;
    EXPECT_NEAR(out["signal.force"], 30 * speed_error + 10 * inner_integral, 1e-10) << cycle;
  }
}

TEST(Controllers, APeriodThatIsNoWholeMultipleIsRefused) {
  const std::string nodes = pid("", 1, 1, 0, "") + "," + constant("odd", "MilliSEC", 25) + R"(,
  { "@id": "t:other", "@type": "ConstraintHandler", "period": "t:odd" })";
  try {
    Loop loop(nodes, pose());
    FAIL() << "accepted";
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("task/other"), std::string::npos) << what;
    EXPECT_NE(what.find("2.5 times"), std::string::npos) << what;
  }
}

TEST(Controllers, AHandlerThatIsFarTooSlowIsRefused) {
  const std::string nodes = pid("", 1, 1, 0, "") + "," + constant("age", "SEC", 20000) + R"(,
  { "@id": "t:other", "@type": "ConstraintHandler", "period": "t:age" })";
  try {
    Loop loop(nodes, pose());
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("at most 1000000"), std::string::npos) << error.what();
  }
}

TEST(Controllers, ANumberThatDependsOnItselfIsRefused) {
  const std::string nodes = constant("goal", "N", 1) + "," + quantity("error", "N") + "," +
                            quantity("force", "N") + "," + constant("kp", "UNITLESS", 1) + "," +
                            constant("ki", "PER-SEC", 0) + "," + constant("kd", "SEC", 0) + "," +
                            constant("period", "SEC", 0.001) + R"(,
  { "@id": "t:c", "@type": ["Constraint", "EqualityConstraint"], "quantity": "t:force",
    "reference-value": "t:goal" },
  { "@id": "t:e", "@type": ["ConstraintEvaluator", "ErrorEvaluator"], "constraint": "t:c",
    "error": "t:error" },
  { "@id": "t:pid", "@type": ["Controller", "ProportionalIntegralDerivative"],
    "error-signal": "t:error", "control-signal": "t:force",
    "proportional-gain": { "@id": "t:kp" }, "integral-gain": { "@id": "t:ki" },
    "derivative-gain": { "@id": "t:kd" } },
  { "@id": "t:h", "@type": "ConstraintHandler", "controllers": "t:pid", "period": "t:period" })";
  try {
    Loop loop(nodes, pose());
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("depends on itself"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace sinew::test
