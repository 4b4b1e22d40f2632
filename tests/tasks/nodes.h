// Parts of tasks in JSON-LD, for the tests of this folder.
#pragma once

#include <string>

namespace sinew::test {

inline std::string quantity(const std::string& id, const std::string& unit) {
  return R"({ "@id": "t:)" + id + R"(", "@type": "Quantity", "unit": ")" + unit + "\" }";
}
inline std::string setpoint(const std::string& id, const std::string& unit) {
  return R"({ "@id": "t:)" + id + R"(", "@type": ["Quantity", "Setpoint"], "unit": ")" + unit +
         "\" }";
}
inline std::string constant(const std::string& id, const std::string& unit, double value) {
  return R"({ "@id": "t:)" + id + R"(", "@type": "Quantity", "unit": ")" + unit +
         R"(", "value": )" + std::to_string(value) + " }";
}

// An equality of a set point with a constant, its error, and a monitor of the error.
inline std::string watched(const std::string& id, const std::string& monitor) {
  return setpoint(id, "M") + "," + constant(id + "-goal", "M", 0) + "," +
         quantity(id + "-error", "M") + R"(,
  { "@id": "t:)" +
         id + R"(-constraint", "@type": ["Constraint", "EqualityConstraint"],
    "quantity": "t:)" +
         id + R"(", "reference-value": "t:)" + id + R"(-goal" },
  { "@id": "t:)" +
         id + R"(-evaluator", "@type": ["ConstraintEvaluator", "ErrorEvaluator"],
    "constraint": "t:)" +
         id + R"(-constraint", "error": "t:)" + id + R"(-error" },
  { "@id": "t:)" +
         id + R"(-monitor", "error": "t:)" + id + R"(-error", )" + monitor + " }";
}

// A controller that turns an error [M] to a force [N], in a handler with this period.
inline std::string pid(const std::string& types, double kp, double ki, double kd,
                       const std::string& more, const std::string& handler = "") {
  return setpoint("error", "M") + "," + quantity("force", "N") + "," +
         constant("kp", "N-PER-M", kp) + "," + constant("ki", "N-PER-M-SEC", ki) + "," +
         constant("kd", "N-SEC-PER-M", kd) + "," + constant("period", "MilliSEC", 10) + R"(,
  { "@id": "t:pid", "@type": ["Controller", "ProportionalIntegralDerivative")" +
         types + R"(],
    "error-signal": "t:error", "control-signal": "t:force",
    "proportional-gain": { "@id": "t:kp" }, "integral-gain": { "@id": "t:ki" },
    "derivative-gain": { "@id": "t:kd" })" +
         more + R"( },
  { "@id": "t:handler", "@type": "ConstraintHandler", "controllers": "t:pid",
    "period": "t:period")" +
         handler + " }";
}

// The twist of the tool, seen from the base; its numbers along or about an axis.
inline const std::string kToolTwist = R"(
  { "@id": "t:twist", "@type": "VelocityTwist", "of": "arm:link/tool",
    "with-respect-to": "arm:link/base", "reference-point": "arm:origin/tool" },
  { "@id": "t:twist-coordinates", "@type": ["VelocityReference", "VelocityTwistCoordinate"],
    "of-velocity": "t:twist", "as-seen-by": "arm:frame/base" })";
// The wrench on the tool.
inline std::string tool_wrench(const std::string& seen_by) {
  return R"(
  { "@id": "t:wrench", "@type": "Wrench", "acts-on": "arm:link/tool",
    "reference-point": "arm:origin/tool" },
  { "@id": "t:wrench-coordinates", "@type": ["WrenchReference", "WrenchCoordinate"],
    "of-wrench": "t:wrench", "as-seen-by": ")" +
         seen_by + "\" }";
}
inline std::string view(const std::string& kind, const std::string& of, const std::string& number,
                        const std::string& subspace, const std::string& axis) {
  return R"({ "@id": "t:view-)" + number + R"(", "@type": ["View", ")" + kind +
         R"("], "superobject": ")" + of + R"(", "subobject": "t:)" + number +
         R"(", "subspace": ")" + subspace + R"(", "axis": ")" + axis + "\" }";
}
inline std::string solver(const std::string& algorithm, const std::string& drivers) {
  return R"({ "@id": "t:solver", "@type": "SolverWithInputAndOutput", "solver": ")" + algorithm +
         R"(", "root": "arm:frame/base", "motion-drivers": { "@id": "t:drivers",
    "@type": "MotionDrivers")" +
         drivers + " } }";
}
inline const std::string kPush = R"(, "cartesian-force": { "@id": "t:push",
    "@type": "CartesianForceSpecification", "force": "t:wrench-coordinates",
    "attached-to": "arm:link/tool" })";

}  // namespace sinew::test
