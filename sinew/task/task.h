// A task as plain values: numbers that are measured, compared, watched and commanded, and what
// leads from one to another. Each of these is a node of the model; the vocabulary is that of
// metamodels/task/ and metamodels/sinew/task.json. Units are coherent SI.
//
// Numbers are known by the node of their quantity. At most one element of a task gives a number its
// value: a view of something spatial or of a joint, an evaluator, a controller; or it is a constant
// or a set point.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "sinew/data/dimension.h"
#include "sinew/graph/terms.h"

namespace sinew::task {

using graph::Id;

// A number.
struct Quantity {
  Id id;
  data::Dimension dimension;
  std::string unit;             // coherent, by its QUDT name: "M-PER-SEC"
  std::optional<double> value;  // of a constant
  bool setpoint = false;        // comes from outside in each cycle
};

enum class SpatialKind : std::uint8_t { kPose, kVelocityTwist, kAccelerationTwist, kWrench };

// Coordinates of a pose, twist or wrench.
struct Spatial {
  Id id;  // of the coordinates
  SpatialKind kind = SpatialKind::kPose;
  Id of;         // pose: a frame; twist: a link; wrench: the link that it acts on
  Id wrt;        // pose: a frame; twist: a link
  Id reference;  // of twists and wrenches: a point
  Id seen_by;    // a frame
  std::optional<std::array<double, 12>> value;  // of a constant pose, row-major [R p]
  bool setpoint = false;
};

// Three numbers of each kind of spatial coordinates are along or about the axes that they are seen
// by.
enum class Subspace : std::uint8_t { kPosition, kAngular, kLinear };

// One number of spatial coordinates: a measured one, or (of a wrench) a part of a commanded one.
struct View {
  Id id;
  Id spatial;
  Id number;
  Subspace subspace = Subspace::kPosition;
  std::size_t axis = 0;  // 0, 1, 2: x, y, z
};

enum class JointKind : std::uint8_t { kPosition, kVelocity, kAcceleration, kForce };

// The number of a joint.
struct JointView {
  Id id;
  Id coordinates;
  Id joint;
  Id number;
  JointKind kind = JointKind::kPosition;
};

enum class ConstraintKind : std::uint8_t { kEqual, kGreaterThan, kLessThan, kBetween };

struct Constraint {
  Id id;
  ConstraintKind kind = ConstraintKind::kEqual;
  Id quantity;
  Id reference;     // kEqual: the reference value; kGreaterThan, kLessThan: the threshold
  Id lower, upper;  // kBetween
};

// Computes what is missing until a constraint holds; an assignment instead makes an equality hold
// by giving the quantity its reference value.
struct Evaluator {
  Id id;
  Id constraint;
  Id error;  // null for an assignment
};

enum class Edge : std::uint8_t { kRising, kFalling, kAny };

// Watches an error: the condition is that it is zero, within the tolerance.
struct Monitor {
  Id id;
  Id error;
  Id flag;   // of a level-triggered one
  Id event;  // of an edge-triggered one
  Edge edge = Edge::kRising;
  Id tolerance;          // null: nothing but zero will do
  Id release_tolerance;  // null: no hysteresis
};

enum class ControllerKind : std::uint8_t { kDamping, kPid, kSpringDamper, kPoseImpedance };

struct SpatialGain {
  Id id;
  Id seen_by = {};
  std::array<double, 6> value = {};  // angular, linear
};

struct Controller {
  Id id;
  ControllerKind kind = ControllerKind::kDamping;
  Id control;                             // a number; kPoseImpedance: a wrench
  Id error;                               // kPid, kSpringDamper
  Id velocity;                            // kDamping, kSpringDamper: the measured one
  Id maximum_velocity, maximum_force;     // kDamping
  Id proportional, integral, derivative;  // kPid: the gains
  Id decay_rate;                          // kPid with a decaying integral, otherwise null
  Id limit;                               // kPid: of the control signal's magnitude; null: none
  Id stiffness, damping;                  // kSpringDamper
  Id desired_velocity;                    // kSpringDamper; null: at rest
  Id inertia;                             // kSpringDamper; null: none
  Id desired_acceleration, measured_acceleration;  // of an inertia; null: zero
  Id measured_pose, desired_pose, measured_twist;  // kPoseImpedance
  Id desired_twist;                                // kPoseImpedance; null: at rest
  SpatialGain spatial_stiffness, spatial_damping;  // kPoseImpedance
};

// It is active from when all of `when` hold until one of `until` does, while all of `while_` hold
// that are watched by a monitor.
struct GuardedMotion {
  Id id;
  std::vector<Id> when, while_, until;  // constraints
};

// What belongs together: it runs at one rate, and its motion enables its controllers.
struct Handler {
  Id id;
  std::optional<GuardedMotion> motion;
  std::vector<Id> evaluators, monitors, controllers;
  std::optional<double> period_s;
};

enum class Algorithm : std::uint8_t {
  kRecursiveNewtonEuler,
  kArticulatedBody,
  kHybrid,             // acceleration-constrained hybrid dynamics
  kForceDistribution,  // the transpose of the Jacobian: no masses
};

// The acceleration of a link's frame along one axis of the root's, or about it, that hybrid
// dynamics imposes.
struct AxisConstraint {
  Id id;
  Subspace subspace = Subspace::kLinear;
  std::size_t axis = 0;  // 0, 1, 2: x, y, z
  // The number that it is: an acceleration energy (unit constraint force times acceleration), or
  // the acceleration itself.
  Id energy;
};

struct AccelerationConstraint {
  Id id;
  Id attached_to;                    // a link
  std::vector<AxisConstraint> axes;  // about x, y, z, then along x, y, z
};

// What happens where acceleration constraints depend on each other (docs/hybrid-dynamics.md).
struct Singular {
  enum class Policy : std::uint8_t { kInOrder, kDamped, kTruncated };
  Policy policy = Policy::kInOrder;
  double number = 0;  // a tolerance, or the damping
};

// A driver of a motion: a wrench on a link, or a number of a joint.
struct Driver {
  Id id;
  Id quantity;  // a wrench's coordinates, or a joint's
  Id attached_to;
};

struct Solver {
  Id id;
  Algorithm algorithm = Algorithm::kRecursiveNewtonEuler;
  std::vector<Driver> cartesian_forces, joint_forces, joint_accelerations;
  std::vector<AccelerationConstraint> constraints;  // the most important first
  std::optional<Singular> singular;
  std::vector<Id> outputs;                       // coordinates of joints, poses or twists
  Id root;                                       // a frame; null where none is stated
  std::optional<std::array<double, 3>> gravity;  // the vector, seen from the root
};

// Whom an algorithm reads from and writes to.
struct RobotInterface {
  Id id;
  Id interface;     // "https://w3id.org/sinew/robot#mujoco"
  double safe = 0;  // what is commanded to every joint on a fault [N m or N]
};

struct Task {
  std::unordered_map<Id, Quantity> quantities;
  std::unordered_map<Id, Spatial> spatials;
  std::vector<View> views;
  std::vector<JointView> joint_views;
  std::unordered_map<Id, Constraint> constraints;
  std::vector<Evaluator> evaluators;
  std::vector<Monitor> monitors;
  std::vector<Controller> controllers;
  std::vector<Handler> handlers;
  std::optional<Solver> solver;
  std::optional<RobotInterface> robot_interface;

  bool empty() const {
    return controllers.empty() && monitors.empty() && !solver && !robot_interface;
  }

  // The handler that an evaluator, monitor or controller belongs to; nullptr: none.
  const Handler* handler_of(Id element) const;
};

}  // namespace sinew::task
