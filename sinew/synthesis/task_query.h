// The query that a task's solver specification stands for: which algorithm, what it asks and gives.
#pragma once

#include <memory>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"
#include "sinew/synthesis/query.h"
#include "sinew/task/task.h"

namespace sinew::synthesis {

// The task must have a solver; faults go to the report.
//   RecursiveNewtonEulerAlgorithm  joint-force from position and velocity; accelerations that no
//                                  driver states are zero
//   ArticulatedBodyAlgorithm       joint-acceleration from position and velocity; forces are the
//                                  task's, zero where it has none
//   AccelerationConstrainedHybridDynamicsAlgorithm
//                                  control-force from position and velocity; accelerations that the
//                                  task constrains are imposed, forces are the task's
//   ForceDistributionSolver        control-force from position (and what the task measures)
Query query_of_task(const graph::View& view, const graph::Places& places,
                    std::shared_ptr<const task::Task> task, Report& report);

// "linear-z": the direction of a query's acceleration constraint.
std::string_view direction_word(const task::AxisConstraint& axis);

}  // namespace sinew::synthesis
