// Tasks whose controllers command accelerations of the tool: hybrid dynamics as their solver.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "loop.h"
#include "nodes.h"

namespace sinew::test {
namespace {

using testing::HasSubstr;

const double kStates[][4] = {{0.3, -0.7, 0.2, 0.5}, {-1.1, 0.4, -0.8, 0.3}, {0.4, 0.9, 1.0, -1.0}};

Values state(const double (&s)[4]) {
  return {{"position.shoulder", s[0]},
          {"position.elbow", s[1]},
          {"velocity.shoulder", s[2]},
          {"velocity.elbow", s[3]}};
}

std::string axis(const std::string& id, const std::string& subspace, const std::string& along,
                 const std::string& energy) {
  return R"({ "@id": "t:)" + id + R"(", "@type": ["AccelerationConstraint", "AxisAligned"],
    "subspace": ")" +
         subspace + R"(", "axis": ")" + along + R"(", "acceleration-energy": ")" + energy + "\" }";
}

// Constraints on the tool; `more` of the drivers.
std::string hybrid(
    const std::string& constraints, const std::string& more = "",
    const std::string& policy = R"("singular": "in-order", "singular-number": 1e-9,)") {
  return R"({ "@id": "t:solver", "@type": "SolverWithInputAndOutput", )" + policy + R"(
    "solver": "AccelerationConstrainedHybridDynamicsAlgorithm", "root": "arm:frame/base",
    "motion-drivers": { "@id": "t:drivers", "@type": "MotionDrivers", "acceleration-constraint": {
      "@id": "t:keep", "@type": "AccelerationConstraintSpecification", "attached-to":
      "arm:link/tool", "constraints": )" +
         constraints + " }" + more + " } }";
}

cli::QueryOptions options() {
  cli::QueryOptions query;
  query.gravity = "0,0,-9.81";
  return query;
}

// Joint accelerations under joint forces, by the articulated-body algorithm of its own query.
struct Accelerations {
  double shoulder, elbow;
};
Accelerations forward(const double (&s)[4], double shoulder, double elbow) {
  cli::QueryOptions query = options();
  query.solver = "aba";
  static Loop loop(constant("unused", "M", 1), query);
  Values in = state(s);
  in["force.shoulder"] = shoulder;
  in["force.elbow"] = elbow;
  Values out = loop.cycle(in);
  return {out["acceleration.shoulder"], out["acceleration.elbow"]};
}

// The tool's acceleration along z and its angular one about y, by hand, in the arm's plane.
double upward(const double (&s)[4], const Accelerations& a) {
  const double q1 = s[0], q2 = s[0] + s[1], w1 = s[2], w2 = s[2] + s[3];
  return -0.4 * std::sin(q1) * a.shoulder - 0.4 * std::cos(q1) * w1 * w1 -
         0.3 * std::sin(q2) * (a.shoulder + a.elbow) - 0.3 * std::cos(q2) * w2 * w2;
}

TEST(HybridTask, ImposesTheAccelerationsThatItsControllersCommand) {
  // Upward: an impedance in units of acceleration; about y: a set point in those of energy.
  Loop loop(setpoint("error", "M") + "," + setpoint("speed", "M-PER-SEC") + "," +
                constant("k", "PER-SEC2", 100) + "," + constant("d", "PER-SEC", 20) + "," +
                quantity("up", "M-PER-SEC2") + "," + setpoint("turn", "N-M-PER-SEC2") + R"(,
    { "@id": "t:c", "@type": ["Controller", "ImpedanceController"], "error-signal": "t:error",
      "measured-velocity": "t:speed", "stiffness": "t:k", "damping": "t:d",
      "control-signal": "t:up" },)" +
                hybrid("[" + axis("along-z", "linear-acceleration", "z", "t:up") + "," +
                       axis("about-y", "angular-acceleration", "y", "t:turn") + "]"),
            options());
  for (const auto& s : kStates) {
    Values in = state(s);
    in["setpoint.error"] = 0.02;
    in["setpoint.speed"] = 0.1;
    in["setpoint.turn"] = -3;
    Values out = loop.cycle(in, 1e-9);
    const double wanted = 100 * 0.02 - 20 * 0.1;
    EXPECT_NEAR(out["signal.up"], wanted, 1e-12);
    const Accelerations a = forward(s, out["control-force.shoulder"], out["control-force.elbow"]);
    EXPECT_NEAR(upward(s, a), wanted, 1e-8);
    EXPECT_NEAR(a.shoulder + a.elbow, -3, 1e-8);
  }
}

// What is not constrained carries its own weight, and moves as the task's own forces have it.
TEST(HybridTask, LeavesTheRestToItsForces) {
  const std::string joint = quantity("push", "N-M") + "," + constant("goal", "N-M", 4) + R"(,
    { "@id": "t:set", "@type": ["Constraint", "EqualityConstraint"], "quantity": "t:push",
      "reference-value": "t:goal" },
    { "@id": "t:assign", "@type": ["ConstraintEvaluator", "AssignmentEvaluator"],
      "constraint": "t:set" },
    { "@id": "t:torque", "@type": "JointForceCoordinate", "of-joint": "arm:joint/elbow" },
    { "@id": "t:v", "@type": ["View", "JointCoordinateView"], "superobject": "t:torque",
      "subobject": "t:push" },)";
  Loop loop(joint + setpoint("up", "M-PER-SEC2") + "," +
                hybrid(axis("along-z", "linear-acceleration", "z", "t:up"), R"(, "joint-force": {
                  "@id": "t:drive", "@type": "JointForceSpecification", "force": "t:torque",
                  "attached-to": "arm:joint/elbow" })"),
            options());
  cli::QueryOptions query = options();
  query.solver = "gravity";
  Loop gravity(constant("unused", "M", 1), query);
  for (const auto& s : kStates) {
    Values in = state(s);
    in["setpoint.up"] = 0.5;
    Values out = loop.cycle(in, 1e-9);
    const Accelerations a = forward(s, out["control-force.shoulder"], out["control-force.elbow"]);
    EXPECT_NEAR(upward(s, a), 0.5, 1e-8);
    Values weight = gravity.cycle({{"position.shoulder", s[0]}, {"position.elbow", s[1]}});
    const double shoulder = out["control-force.shoulder"] - weight["gravity-force.shoulder"];
    const double elbow = out["control-force.elbow"] - weight["gravity-force.elbow"] - 4;
    // The constraint force is along z of the tool: J_z' x, and nothing else.
    const double q1 = s[0], q2 = s[0] + s[1];
    const double j1 = -0.4 * std::sin(q1) - 0.3 * std::sin(q2), j2 = -0.3 * std::sin(q2);
    EXPECT_NEAR(shoulder * j2 - elbow * j1, 0, 1e-8);
  }
}

// Two levels, three directions for two joints: what ranks first is met.
TEST(HybridTask, MeetsConstraintsInTheOrderOfTheHierarchy) {
  for (const bool turn_first : {true, false}) {
    const std::string level =
        R"({ "@id": "t:LEVEL", "@type": "PrioritizationLevel", "motion-drivers": "t:KEEP" })";
    const auto named = [&](const std::string& id, const std::string& keep) {
      std::string text = level;
      text.replace(text.find("LEVEL"), 5, id);
      return text.replace(text.find("KEEP"), 4, keep);
    };
    const std::string first = named("first", turn_first ? "keep-turn" : "keep-move");
    const std::string second = named("second", turn_first ? "keep-move" : "keep-turn");
    Loop loop(setpoint("up", "M-PER-SEC2") + "," + setpoint("side", "M-PER-SEC2") + "," +
                  setpoint("turn", "RAD-PER-SEC2") + R"(,
      { "@id": "t:solver", "@type": "SolverWithInputAndOutput", "singular": "in-order",
        "singular-number": 1e-6, "solver": "AccelerationConstrainedHybridDynamicsAlgorithm",
        "root": "arm:frame/base", "motion-drivers": { "@id": "t:drivers", "@type": "MotionDrivers",
        "acceleration-constraint": [ { "@id": "t:keep-move",
          "@type": "AccelerationConstraintSpecification", "attached-to": "arm:link/tool",
          "constraints": [)" +
                  axis("along-z", "linear-acceleration", "z", "t:up") + "," +
                  axis("along-x", "linear-acceleration", "x", "t:side") +
                  R"(] }, { "@id": "t:keep-turn", "@type": "AccelerationConstraintSpecification",
          "attached-to": "arm:link/tool", "constraints": )" +
                  axis("about-y", "angular-acceleration", "y", "t:turn") +
                  R"( } ], "prioritization-hierarchy": [ )" + first + ", " + second + " ] } }",
              options());
    for (const auto& s : kStates) {
      Values in = state(s);
      in["setpoint.turn"] = 5;
      in["setpoint.up"] = in["setpoint.side"] = 1;
      Values out = loop.cycle(in, 1e-6);
      const Accelerations a = forward(s, out["control-force.shoulder"], out["control-force.elbow"]);
      if (turn_first)
        EXPECT_NEAR(a.shoulder + a.elbow, 5, 1e-6);
      else
        EXPECT_NEAR(upward(s, a), 1, 1e-6);
      EXPECT_GT(std::abs(turn_first ? upward(s, a) - 1 : a.shoulder + a.elbow - 5), 1e-3)
          << "all three cannot be met";
    }
  }
}

std::string refused(const std::string& nodes) {
  try {
    Loop loop(nodes, options());
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(HybridTask, RefusesWhatIsNotFullyStated) {
  const std::string up = setpoint("up", "M-PER-SEC2") + ",";
  const std::string along_z = axis("along-z", "linear-acceleration", "z", "t:up");
  EXPECT_THAT(refused(up + hybrid(along_z, "", "")),
              HasSubstr("task/solver: it is not said what happens where the constraints depend"));
  EXPECT_THAT(refused(up + hybrid(along_z, "", R"("singular": "in-order",)")),
              HasSubstr("the tolerance, or the damping is missing"));
  EXPECT_THAT(refused(up + hybrid("[" + along_z + "," +
                                  axis("again", "linear-acceleration", "z", "t:up") + "]")),
              HasSubstr("constrains the same axis"));
  EXPECT_THAT(refused(setpoint("up", "RAD-PER-SEC2") + "," + hybrid(along_z)),
              HasSubstr("which may be in N-M-PER-SEC2 or in M-PER-SEC2"));
  EXPECT_THAT(refused(quantity("up", "M-PER-SEC2") + "," + hybrid(along_z)),
              HasSubstr("nothing gives it a value"));
  std::string other = hybrid(along_z);
  other.replace(other.find("AccelerationConstrainedHybridDynamicsAlgorithm"), 46,
                "RecursiveNewtonEulerAlgorithm");
  EXPECT_THAT(refused(up + other), HasSubstr("its solver imposes no acceleration"));
  std::string base = hybrid(along_z);
  base.replace(base.find("arm:link/tool"), 13, "arm:link/base");
  EXPECT_THAT(refused(up + base), HasSubstr("is fixed to the base: nothing moves it"));
}

}  // namespace
}  // namespace sinew::test
