// Acceleration constraints, resolved to frames and bodies; and all drivers of a robot in groups,
// whose effects are propagated one by one. Without a policy there is one group with everything in
// it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/synthesis/external_wrenches.h"
#include "sinew/synthesis/query.h"
#include "sinew/synthesis/robot.h"

namespace sinew::synthesis {

inline constexpr std::size_t kNoDriver = static_cast<std::size_t>(-1);
// More constraints on one frame cannot be independent of each other.
inline constexpr std::size_t kMostDirections = 6;

// Where a driver acts.
struct DrivenFrame {
  Id frame, body_frame, body;
  bool is_body_frame() const { return frame == body_frame; }
};

// One acceleration that is imposed.
struct ConstraintDirection {
  Id element;                                       // stands for it in the algorithm
  std::string label;                                // "tool.linear-z"
  std::size_t constraint;                           // index
  std::optional<std::array<double, 6>> unit_force;  // without it, an input
};

struct AccelerationConstraint {
  Id element;         // its node, or one that stands for it
  std::string label;  // "tool"
  DrivenFrame at;
  bool seen_by_itself = false;  // its directions; else by the base
};

// Drivers whose effects are added up early.
struct DriverGroup {
  Id element;         // stands for it
  Id origin;          // the model's or query's node that it comes from
  std::string label;  // "gravity", "wrench-tool", "constraint-tool", ...
  bool gravity = false, velocity = false;
  std::vector<std::size_t> wrenches;     // of the external ones, by index
  std::vector<std::size_t> constraints;  // by index
  std::vector<Id> joints;                // those whose given forces belong to it

  bool has_joint(Id joint) const;
  bool has_constraint(std::size_t constraint) const;
};

struct MotionDrivers {
  std::vector<AccelerationConstraint> constraints;
  std::vector<ConstraintDirection> directions;
  std::vector<DriverGroup> groups;
  std::size_t limited = kNoDriver;  // the group that is scaled down
  std::vector<double> force_limits =
      {};  // of the robot's joints, in their order; none: not a number

  // Whether the constrained recursion is called for at all.
  bool any = false;
  bool apart = false, weighed = false;
};

// Refuses what is unknown, empty or contradictory, naming the driver and the remedy.
MotionDrivers resolve_motion_drivers(graph::Store& store, const graph::View& view,
                                     const Robot& robot, const Query& query,
                                     std::span<const ExternalWrench> wrenches, Report& report);

}  // namespace sinew::synthesis
