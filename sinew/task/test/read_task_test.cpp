#include "sinew/task/read_task.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "small_task.h"

namespace sinew::task {
namespace {

using testing::HasSubstr;

const std::string kDamper = R"(
  { "@id": "t:speed", "@type": ["Quantity", "Setpoint"], "unit": "M-PER-SEC" },
  { "@id": "t:top-speed", "@type": "Quantity", "unit": "CentiM-PER-SEC", "value": 10 },
  { "@id": "t:top-force", "@type": "Quantity", "unit": "N", "value": 10 },
  { "@id": "t:force", "@type": "Quantity", "unit": "N" },
  { "@id": "t:damper", "@type": ["Controller", "DampingController"],
    "measured-velocity": "t:speed", "maximum-velocity": "t:top-speed",
    "maximum-force": "t:top-force", "control-signal": "t:force" })";

// A controller of a position, with its gains as given.
std::string pid(const std::string& gains, const std::string& handler = R"(,
  { "@id": "t:handler", "@type": "ConstraintHandler", "controllers": "t:pid",
    "period": { "@id": "t:period", "@type": "Quantity", "unit": "MilliSEC", "value": 2 } })") {
  return R"(
  { "@id": "t:error", "@type": ["Quantity", "Setpoint"], "unit": "M" },
  { "@id": "t:force", "@type": "Quantity", "unit": "N" },
  { "@id": "t:kp", "@type": "Quantity", "unit": "N-PER-M", "value": 50 },
  { "@id": "t:ki", "@type": "Quantity", "unit": "N-PER-M-SEC", "value": 5 },
  { "@id": "t:kd", "@type": "Quantity", "unit": "N-SEC-PER-M", "value": 1 },
  { "@id": "t:pid", "@type": ["Controller", "ProportionalIntegralDerivative"],
    "error-signal": "t:error", "control-signal": "t:force", )" +
         gains + "}" + handler;
}
const std::string kGains = R"("proportional-gain": { "@id": "t:kp" },
    "integral-gain": { "@id": "t:ki" }, "derivative-gain": { "@id": "t:kd" })";

TEST(ReadTask, TakesADampingControllerInSiUnits) {
  Loaded loaded;
  load(kDamper, loaded);
  ASSERT_EQ(loaded.problems(), "");
  ASSERT_EQ(loaded.task.controllers.size(), 1u);
  const Controller& damper = loaded.task.controllers.front();
  EXPECT_EQ(damper.kind, ControllerKind::kDamping);
  EXPECT_EQ(damper.control, loaded.id("force"));
  const Quantity& top = loaded.task.quantities.at(damper.maximum_velocity);
  EXPECT_EQ(top.unit, "M-PER-SEC");
  EXPECT_DOUBLE_EQ(*top.value, 0.1);
  EXPECT_TRUE(loaded.task.quantities.at(damper.velocity).setpoint);
}

TEST(ReadTask, TakesThePublishedNameOfADampersForce) {
  Loaded loaded;
  std::string text = kDamper;
  text.replace(text.find("control-signal"), 14, "commanded-force");
  load(text, loaded);
  EXPECT_EQ(loaded.problems(), "");
  EXPECT_EQ(loaded.task.controllers.at(0).control, loaded.id("force"));
}

TEST(ReadTask, TakesAPidControllerAndItsPeriod) {
  Loaded loaded;
  load(pid(kGains), loaded);
  ASSERT_EQ(loaded.problems(), "");
  EXPECT_EQ(loaded.task.controllers.at(0).kind, ControllerKind::kPid);
  EXPECT_DOUBLE_EQ(*loaded.task.handler_of(loaded.id("pid"))->period_s, 0.002);
}

struct Fault {
  const char* name;
  std::string nodes;
  std::vector<std::string> says;  // in the message: the node, what is wrong, what would be right
};

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

class Faults : public testing::TestWithParam<Fault> {};

TEST_P(Faults, NameTheNodeThePlaceAndTheRemedy) {
  Loaded loaded;
  load(GetParam().nodes, loaded);
  EXPECT_TRUE(loaded.report.has_errors());
  for (const std::string& words : GetParam().says) EXPECT_THAT(loaded.problems(), HasSubstr(words));
  EXPECT_THAT(loaded.problems(), HasSubstr("task.jsonld:"));
}

INSTANTIATE_TEST_SUITE_P(
    All, Faults,
    testing::Values(
        Fault{"a_missing_gain",
              pid(replaced(kGains, R"("integral-gain": { "@id": "t:ki" },)", "")),
              {"task/pid", "the integral gain is missing", "integral-gain> exactly once"}},
        Fault{"a_gain_that_is_a_number_alone",
              pid(replaced(kGains, R"({ "@id": "t:kp" })", "50.0")),
              {"task/pid", "the proportional gain is a number alone, without a unit",
               "make it a quantity"}},
        Fault{"a_gain_of_another_dimension",
              replaced(pid(kGains), R"("unit": "N-PER-M", )", R"("unit": "N-SEC-PER-M", )"),
              {"task/kp",
               "the proportional gain of <https://example.org/task/pid> is in "
               "N-SEC-PER-M",
               "such as N-PER-M"}},
        Fault{"no_period",
              pid(kGains, ""),
              {"task/pid", "integrates over time", "a ConstraintHandler with a \"period\""}},
        Fault{"no_unit",
              replaced(kDamper, R"("unit": "N", "value": 10)", R"("value": 10)"),
              {"task/top-force", "the maximum force states no unit"}},
        Fault{"an_unknown_unit",
              replaced(kDamper, R"("unit": "N", "value")", R"("unit": "NEWTONS", "value")"),
              {"task/top-force", "NEWTONS"}},
        Fault{"a_limit_of_another_dimension",
              replaced(kDamper, "CentiM-PER-SEC", "CentiM"),
              {"task/top-speed", "is in M", "such as M-PER-SEC"}},
        Fault{"a_velocity_of_zero",
              replaced(kDamper, R"("value": 10 })", R"("value": 0 })"),
              {"task/damper", "the maximum velocity is zero"}},
        Fault{"a_velocity_by_which_no_force_can_be_divided",
              replaced(kDamper, R"("value": 10 })", R"("value": 1e-300 })"),
              {"task/top-speed", "its value is 1e-302 M-PER-SEC, neither zero nor from"}},
        Fault{
            "a_force_that_overflows",
            replaced(kDamper, R"("unit": "N", "value": 10)", R"("unit": "KiloN", "value": 1e307)"),
            {"task/top-force", "its value is inf N, neither zero nor from 1e-30 to 1e+30",
             "check the number and its unit"}},
        Fault{"a_spatial_gain_that_overflows",
              R"({ "@id": "t:k", "@type": "SpatialGain", "angular": [1.0, 2.0, 3.0],
                   "linear": [1.0, 1e300, 1.0], "unit": ["N-M-PER-RAD", "N-PER-M"] },
                 { "@id": "t:impedance", "@type": ["Controller", "ImpedanceController",
                   "PoseImpedanceController"], "stiffness": "t:k" })",
              {"task/k", "the stiffness has a number that is neither zero nor from 1e-30"}},
        Fault{"two_origins",
              replaced(kDamper, R"("@type": "Quantity", "unit": "N" })",
                       R"("@type": ["Quantity", "Setpoint"], "unit": "N" })"),
              {"task/force", "it gets its value from", "a quantity has one origin"}},
        Fault{
            "a_number_without_origin",
            replaced(kDamper, R"(["Quantity", "Setpoint"])", R"("Quantity")"),
            {"task/speed", "damper> needs it, but nothing gives it a value", "make it a Setpoint"}},
        Fault{"two_handlers",
              pid(kGains) + R"(, { "@id": "t:other", "@type": "ConstraintHandler",
                   "controllers": "t:pid" })",
              {"task/pid", "it belongs to", "one handler for each element"}},
        Fault{"two_kinds",
              replaced(kDamper, R"("DampingController"])",
                       R"("DampingController", "ImpedanceController"])"),
              {"task/damper", "one controller of several kinds"}},
        Fault{"constraints_of_a_solver_that_imposes_none",
              R"({ "@id": "t:a", "@type": ["Quantity", "Setpoint"], "unit": "M-PER-SEC2" },
                 { "@id": "t:up", "@type": ["AccelerationConstraint", "AxisAligned"],
                   "subspace": "linear-acceleration", "axis": "z", "acceleration-energy": "t:a" },
                 { "@id": "t:constraint", "@type": "AccelerationConstraintSpecification",
                   "attached-to": "t:hand", "constraints": "t:up" },
                 { "@id": "t:solver", "@type": "SolverWithInputAndOutput",
                   "solver": "RecursiveNewtonEulerAlgorithm", "root": "t:base",
                   "motion-drivers": { "@id": "t:drivers", "@type": "MotionDrivers",
                     "acceleration-constraint": "t:constraint" } })",
              {"task/constraint", "its solver imposes no acceleration",
               "AccelerationConstrainedHybridDynamicsAlgorithm"}},
        Fault{"no_kind",
              R"({ "@id": "t:force", "@type": "Quantity", "unit": "N" },
                 { "@id": "t:c", "@type": "Controller", "control-signal": "t:force" })",
              {"task/c", "what kind of controller", "DampingController"}},
        Fault{"an_inertia",
              R"({ "@id": "t:m", "@type": "Quantity", "unit": "KiloGM", "value": 1 },
                 { "@id": "t:c", "@type": ["Controller", "ImpedanceController"],
                   "inertia": "t:m" })",
              {"task/c", "an inertia that no acceleration meets", "desired-acceleration"}},
        Fault{"no_axis",
              R"({ "@id": "t:pose", "@type": ["PoseReference", "PoseCoordinate"],
                   "of-pose": "t:p", "as-seen-by": "t:base" },
                 { "@id": "t:p", "@type": "Pose", "of": "t:hand", "with-respect-to": "t:base" },
                 { "@id": "t:height", "@type": "Quantity", "unit": "M" },
                 { "@id": "t:view", "@type": ["View", "PoseCoordinateView"],
                   "superobject": "t:pose", "subobject": "t:height", "subspace": "position" })",
              {"task/view", "the view's axis (x, y or z) is missing"}},
        Fault{"an_equality_without_tolerance",
              R"({ "@id": "t:q", "@type": ["Quantity", "Setpoint"], "unit": "M" },
                 { "@id": "t:r", "@type": "Quantity", "unit": "M", "value": 1 },
                 { "@id": "t:e", "@type": "Quantity", "unit": "M" },
                 { "@id": "t:equal", "@type": ["Constraint", "EqualityConstraint"],
                   "quantity": "t:q", "reference-value": "t:r" },
                 { "@id": "t:evaluator", "@type": ["ConstraintEvaluator", "ErrorEvaluator"],
                   "constraint": "t:equal", "error": "t:e" },
                 { "@id": "t:monitor", "@type": ["Monitor", "LevelTriggeredMonitor"],
                   "error": "t:e", "flag": "t:flag" })",
              {"task/monitor", "without a tolerance", "state the \"tolerance\""}},
        Fault{"an_edge_that_is_not_stated",
              R"({ "@id": "t:e", "@type": ["Quantity", "Setpoint"], "unit": "M" },
                 { "@id": "t:monitor", "@type": ["Monitor", "EdgeTriggeredMonitor"],
                   "error": "t:e", "event": "t:event", "event-queue": "t:queue" })",
              {"task/monitor", "which edge triggers the event is missing"}},
        Fault{"a_motion_that_nobody_watches",
              R"({ "@id": "t:q", "@type": ["Quantity", "Setpoint"], "unit": "N" },
                 { "@id": "t:r", "@type": "Quantity", "unit": "N", "value": 1 },
                 { "@id": "t:contact", "@type": ["Constraint", "UnilateralConstraint",
                   "GreaterThanConstraint"], "quantity": "t:q", "threshold": "t:r" },
                 { "@id": "t:motion", "@type": "GuardedMotion", "until": "t:contact" },
                 { "@id": "t:handler", "@type": "ConstraintHandler", "motion": "t:motion" })",
              {"task/contact", "no monitor watches its error", "add an ErrorEvaluator"}}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace sinew::task
