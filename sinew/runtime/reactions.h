// What events lead to.
//
// A task's monitors raise events (data blocks `event.NAME` that are 1 for one cycle). After the
// task has run they go into a queue of the loop; at the next boundary of a cycle, before any task
// runs, the queue is emptied and each event does what was declared for it. A supervising thread
// raises events too (Host::raise).
//
// The queue has a fixed size and never waits: an event that finds it full is lost, counted and
// told. One that stops or faults is not lost: that it has happened is noted beside the queue.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sinew::runtime {

enum class ReactionKind : std::uint8_t {
  kStop,       // the loop ends; robots get their safe command
  kFault,      // as a check that stops: the host is faulted until it is reset
  kStartTask,  // a halted task runs from this cycle on; its states get their first values
  kHaltTask,   // a task runs no more; what it has computed last stays
};

struct Reaction {
  std::string event;  // by the IRI of the model's event, or by its block's name ("event.contact")
  ReactionKind kind = ReactionKind::kStop;
  std::string task = {};  // of kStartTask, kHaltTask
  // No task of this host raises it; it comes by Host::raise.
  bool from_outside = false;
};

// One event that something is declared for.
struct EventRow {
  std::string event;
  struct Effect {
    ReactionKind kind;
    std::uint32_t task;  // index
  };
  std::vector<Effect> effects;
};

// A data block that raises an event while it is not 0.
struct Watcher {
  const double* flag = nullptr;
  const char* name = nullptr;  // of the block
  std::uint32_t row = 0;       // of the event, or kNoRow: it is only told
};
inline constexpr std::uint32_t kNoRow = 0xffffffffU;

}  // namespace sinew::runtime
