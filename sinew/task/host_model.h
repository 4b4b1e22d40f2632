// Several tasks in one loop, as a model says it (metamodels/sinew/host.json): which models make
// each task, how often it runs, what one hands to another, and what their events lead to. Plain
// values; the runtime's host is made from them by whoever prepares the tasks.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/graph/places.h"
#include "sinew/graph/store.h"

namespace sinew::task {

using graph::Id;

struct HostTask {
  Id id;
  std::vector<Id> models;          // named graphs that belong to this task
  std::optional<double> period_s;  // nothing: that of its controllers
  bool halted = false;             // until an event starts it
};

// Numbers that are the same have the same IRI and need no connection; this is for those that are
// called otherwise.
struct HostConnection {
  Id id, from, to;
};

struct HostReaction {
  enum class Action : std::uint8_t { kStop, kFault, kStart, kHalt };
  Id id, event;
  Action action = Action::kStop;
  Id task;  // of kStart, kHalt
  bool from_outside = false;
};

struct HostModel {
  Id id;
  std::vector<HostTask> tasks;  // in the order in which they run
  std::vector<HostConnection> connections;
  std::vector<HostReaction> reactions;
  std::optional<std::size_t> event_capacity;
};

// The host of all files that were loaded; nothing where they hold none. Faults go to the report.
std::optional<HostModel> read_host(graph::Store& store, const graph::Places& places,
                                   Report& report);

}  // namespace sinew::task
