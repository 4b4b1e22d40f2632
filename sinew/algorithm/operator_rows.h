// The rows of the operator catalogue as they are written (operators.h has what becomes of them).
#pragma once

#include <span>
#include <string_view>

namespace sinew::algorithm {

#define SINEW_OWN "https://w3id.org/sinew/operators#"
#define SINEW_PUBLISHED "https://comp-rob2b.github.io/metamodels/"
#define SINEW_GEOMETRY SINEW_PUBLISHED "geometry/spatial-operators#"
#define SINEW_DYNAMICS SINEW_PUBLISHED "newtonian-rigid-body-dynamics/operators#"

// ports: "NAME:QUANTITY ... -> NAME:QUANTITY ..."; `NAME*` takes a list.
// rules: "PORT.SYMBOL = PORT.SYMBOL; ..." with the symbols of, wrt, seen, ref; `at` is seen and ref
// together, so "from.at = pose.wrt" says that `from` is seen from, and about the origin of, the
// pose's `wrt`. A port's property has the namespace of the operator's IRI.
// units: "PORT = PORT PORT; ...", for ports whose quantity leaves the unit open: both sides are
// products with the same dimension. A word in capitals is a unit, 1 has none.
struct OperatorRow {
  std::string_view name, iri, ports, rules, formula;
  std::string_view units = {};
};

// operators_motion.cpp: poses, velocity and acceleration twists
std::span<const OperatorRow> motion_operator_rows();
// operators_dynamics.cpp: wrenches, inertias
std::span<const OperatorRow> dynamics_operator_rows();
// operators_whole.cpp: the floating base, Jacobians, momentum, energy, matrices
std::span<const OperatorRow> whole_operator_rows();
// operators_control.cpp: controllers, monitors, views, guarded motions
std::span<const OperatorRow> control_operator_rows();
// operators_relative.cpp: motion between two frames, coordinates of rotation
std::span<const OperatorRow> relative_operator_rows();
// operators_joints.cpp: joints of several degrees of freedom, coupled joints, factors
std::span<const OperatorRow> joint_operator_rows();
// operators_hybrid.cpp: acceleration constraints and drivers
std::span<const OperatorRow> hybrid_operator_rows();

}  // namespace sinew::algorithm
