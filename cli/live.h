// sinew run --robot: an algorithm in a loop, with a robot around it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "options.h"

namespace sinew::cli {

struct LiveOptions {
  std::string robot;  // "print", "mujoco", "udp"; empty: not live
  std::optional<double> rate;
  double seconds = 0;  // 0: until interrupted
  std::vector<std::string> record, set, start;
  std::string swap, swap_task;
  std::optional<double> swap_at;
  std::string scene, safe, local = "127.0.0.1:0", remote;
  double age_limit = 0.1;
  bool lockstep = false, catch_up = false;
};

void add_live_options(CLI::App& app, LiveOptions& options);

// What is wrong with the options that were given, because this robot (or none: rows of a file) has
// no use for one of them; empty if nothing is.
std::string misplaced_option(const CLI::App& app, const std::string& robot);

// Runs until it is over, interrupted (interruption.h) or faulted; statistics go to standard error.
// Returns the exit code: 1 after a fault, 128 + the signal where one cut short what --for asks.
// Throws Error.
int run_live(const ModelOptions& files, const QueryOptions& query, const LiveOptions& options,
             bool interpret);

}  // namespace sinew::cli
