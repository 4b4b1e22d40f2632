// What `sinew run --robot` runs: one algorithm, or the tasks of a host model (task/host_model.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "live.h"
#include "pipeline.h"
#include "sinew/program/host_plan.h"
#include "sinew/runtime/host.h"

namespace sinew::cli {

struct PlannedTask {
  runtime::TaskOptions options;
  program::HostPlan plan;
};

struct Application {
  double period_s = 0;  // of the host
  std::vector<PlannedTask> tasks;
  std::vector<runtime::Connection> connections;
  std::vector<runtime::Reaction> reactions;
  std::optional<std::size_t> event_capacity;
};

// The name of the task where there is only one.
inline constexpr const char* kOnlyTask = "main";

// Where the models hold a host, each of its tasks is made from all models but those of the other
// tasks. What has the same IRI in two tasks, computed by one and a set point of the other, is
// connected. Throws Error: rates that are no whole multiples, two sources of a set point, a model
// that no file holds.
Application application_of(Models& models, const ModelOptions& files, const QueryOptions& query,
                           const LiveOptions& options);

// The algorithm of these models with the robot around it, as a host runs it.
program::HostPlan plan_of(Models& models, const ModelOptions& files, const QueryOptions& query,
                          const LiveOptions& options, bool needs_robot = true);

// Blocks that no measurement fills.
std::vector<std::uint32_t> set_points(const program::HostPlan& plan);

}  // namespace sinew::cli
