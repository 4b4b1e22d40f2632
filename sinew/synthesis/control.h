// A task (task/task.h) on a robot: where its frames are on the robot, and what it needs of it. From
// this the steps of steps_control.cpp make data blocks and closures.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/store.h"
#include "sinew/synthesis/motion_drivers.h"
#include "sinew/synthesis/plan.h"
#include "sinew/synthesis/robot.h"
#include "sinew/synthesis/step.h"
#include "sinew/task/task.h"

namespace sinew::synthesis {

// How many times slower than the fastest one a handler may be.
inline constexpr double kMaximumCyclesOfAHandler = 1e6;

struct Context;

// Where spatial coordinates of a task are on the robot.
struct SpatialPlace {
  Id frame;  // of the pose; of twists and wrenches: the frame whose origin is the reference point
  Id body;   // whose it is
  // Their directions are constant seen from the root's frame, or seen from `frame`: the axes of the
  // frame that they are seen by, as columns.
  bool seen_from_root = true;
  std::array<std::array<double, 3>, 3> axes = {};
  // Of a pose that is with respect to another frame than the root's: that frame, and the pose of
  // the root's frame with respect to it. Null: the root's.
  Id wrt;
  std::array<double, 12> root_in_wrt = {};
};

// What the outcome of the task acts on.
enum class Drives : std::uint8_t {
  kNothing,       // the task watches
  kMotion,        // wrenches and forces add to what the motion needs (inverse dynamics)
  kDistribution,  // joint forces by the transpose of the Jacobian
};

struct Control {
  std::shared_ptr<const task::Task> task;
  std::unordered_map<Id, SpatialPlace> places;   // by coordinates
  std::unordered_map<Id, std::uint32_t> cycles;  // of each handler, in the fastest one's
  std::optional<double> period_s;                // of the fastest one
  Drives drives = Drives::kNothing;
  bool accelerations = false;  // joint accelerations are the task's, zero where no driver has one
  bool forces = false;         // joint forces (of forward dynamics) are the task's
  bool constraints = false;    // so are the accelerations that hybrid dynamics imposes

  // Frames whose quantities are needed: (a row of asked.cpp, frame).
  std::vector<std::pair<std::string, Id>> frames;
  std::vector<std::string> needs;  // slots

  bool has_wrenches() const { return task->solver && !task->solver->cartesian_forces.empty(); }
  bool has_joint_forces() const { return task->solver && !task->solver->joint_forces.empty(); }
};

// Finds frames, bodies and joints; what is not on the robot goes to the report, by its IRI.
Control place_task(const graph::View& view, const Robot& robot,
                   std::shared_ptr<const task::Task> task, Report& report);

// What the query asks, as far as it matters to the task: which joint forces.
struct AskedForces {
  bool full = false, bias = false, rest = false, control = false;
};

// What the task acts on, by what is asked and given; an error where its wrenches could act on
// nothing.
void decide(Control& control, const AskedForces& asked, std::span<const std::string> given,
            Report& report, const graph::View& view);

// The number of the task that a constrained direction is; null where it comes from outside.
Id energy_of(const Control* control, const MotionDrivers& drivers,
             const ConstraintDirection& direction);

// All steps, and those of the task in their places.
std::vector<Step> steps_with(const Control& control, std::span<const Step> steps);

// What the task calls for beside what is asked.
std::vector<Wish> wishes_of(const Control& control, const AskedForces& asked);

}  // namespace sinew::synthesis
