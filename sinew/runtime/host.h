// A cyclic host: runs executables at fixed rates on an absolute clock, and keeps running.
//
// One base period; a task is an executable that runs in every n-th cycle. Tasks run one after the
// other in the order in which they were added, so a slow outer loop and a fast inner one share data
// without locks (`connect`).
//
// Life-cycle: idle -configure-> configured -start-> running -stop-> configured. A fault (a stale
// measurement, a check that stops) leads from running to faulted: from that cycle on every robot
// gets its declared safe command, until stop and reset. Guards say why a host may not start.
//
// Everything below `start` is for one supervising thread. The loop's thread allocates nothing and
// takes no lock: set points and new programs reach it through a ring, events and old programs leave
// it through others.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "sinew/runtime/cycle.h"
#include "sinew/runtime/executable.h"
#include "sinew/runtime/reactions.h"
#include "sinew/runtime/real_time.h"
#include "sinew/runtime/ring.h"
#include "sinew/runtime/statistics.h"
#include "sinew/runtime/swap.h"

namespace sinew::runtime {

enum class State : std::uint8_t { kIdle, kConfigured, kRunning, kFaulted };
std::string_view to_string(State state);

// What to do when a cycle began so late that the next one should have begun too.
enum class LateCycles : std::uint8_t {
  kSkip,     // leave out those that have passed, and count them as missed
  kCatchUp,  // run them all, one right after the other: the count of cycles has no gap
};

struct HostOptions {
  double period_s = 0.001;
  double age_limit_s = 0.1;  // of a measurement: older ones fault
  std::uint64_t cycles = 0;  // ends by itself after so many; 0: runs until stop
  bool real_time = true;     // ask for SCHED_FIFO and locked memory
  int priority = kDefaultPriority;
  LateCycles late = LateCycles::kSkip;
  std::size_t event_capacity = 64;  // of the queue of events; rounded up to a power of two
};

struct TaskOptions {
  std::string name;
  std::uint32_t every = 1;  // runs in every n-th cycle
  bool halted = false;      // until an event starts it (Reaction)
};

// From a block of one task to an input of another, by IRI or name.
struct Connection {
  std::string from_task, from, to_task, to;
};

// Why the host may not start; nothing: it may.
using Guard = std::function<std::optional<std::string>()>;

struct HostStatistics {
  std::uint64_t cycles = 0;             // that ran
  std::uint64_t missed = 0;             // cycles that were left out because an earlier one was late
  std::uint64_t events_lost = 0;        // not told: take_events was called too seldom
  std::uint64_t raised = 0;             // events that were put into the queue
  std::uint64_t raised_lost = 0;        // that found it full
  const Histogram* lateness = nullptr;  // from when a cycle should have begun to when it did
  const Histogram* execution = nullptr;  // from its begin to its end
};

class Host final : private EventSink {
 public:
  explicit Host(HostOptions options);
  ~Host() override;  // stops
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  // What executables for this host are to be prepared with.
  Bindings& bindings() { return bindings_; }

  // --- before configure ---
  void add_task(const TaskOptions& options, std::unique_ptr<Executable> executable);
  void connect(Connection connection);
  void react(Reaction reaction);
  void add_guard(Guard guard) { guards_.push_back(std::move(guard)); }

  // --- life-cycle; each throws Error when it may not happen now ---
  void configure();  // resolves connections and reactions; every input must have a source
  void start();      // guards, robots, recorder, loop
  void stop();       // ends the loop after its cycle; robots get their safe command
  void reset();      // from faulted to configured; states get their first values
  void wait();       // until the loop has ended by itself (HostOptions::cycles)
  bool has_ended() const {
    return ended_.load(std::memory_order_acquire);
  }  // so that wait is short
  State state() const { return state_.load(std::memory_order_acquire); }

  // The same cycle, by the calling thread, without a clock: for tests, and simulations that are
  // stepped. Only while configured or faulted; does nothing once an event has stopped it.
  void step(std::uint64_t cycles = 1);

  // --- while running, or before ---
  // Gives a set point its value, from the next cycle on. Throws Error: no such set point, another
  // size, or too many at once.
  void set(const std::string& task, const std::string& block, std::span<const double> values);
  // An event of which something is declared (Reaction), from the next cycle on. Throws Error: no
  // such event, or too many at once.
  void raise(const std::string& event);
  // The task goes over to another program at the next boundary of a cycle. Returns at once; throws
  // Error, and leaves the old one running, when the new one cannot follow it.
  SwapReport swap(const std::string& task, std::unique_ptr<Executable> next,
                  const SwapRules& rules = {});
  // Of the last swap that has happened; nothing: none has yet.
  std::optional<SwapRecord> last_swap();

  // Whether the task is halted, while the host does not run.
  bool is_halted(const std::string& task) const;
  // A block's numbers, while the host does not run.
  std::vector<double> read(const std::string& task, const std::string& block) const;

  std::vector<Event> take_events();
  HostStatistics statistics() const;
  const RealTimeReport& real_time() const { return real_time_; }  // once started

 private:
  static constexpr std::size_t kCommands = 64, kEvents = 1024;
  static constexpr std::size_t kMaximumEventCapacity = 65536;
  static constexpr std::size_t kMaximumSetPoint = 64;  // numbers

  struct Task {
    TaskOptions options;
    std::unique_ptr<Executable> executable;  // the loop's
    const Executable* latest = nullptr;      // that runs once all commands have been carried out
    std::vector<bool> given;                 // by block of `latest`: a set point with a value
    std::vector<Watcher> watchers;           // the loop's
    bool halted = false;                     // the loop's
  };
  struct Wire {  // a resolved connection
    std::uint32_t to_task = 0, size = 0;
    const double* from = nullptr;
    double* to = nullptr;
  };
  struct Change {  // a swap on its way to the loop, and with the old program on its way back
    std::uint32_t task = 0;
    std::unique_ptr<Executable> executable;
    std::vector<StateCopy> copies;
    std::vector<Wire> wires;
    std::vector<Watcher> watchers;
    Nanoseconds requested = 0;
  };
  struct Command {
    double* target = nullptr;
    std::uint32_t size = 0;
    std::array<double, kMaximumSetPoint> values;
    Change* change = nullptr;  // owned by whoever holds the command
  };

  std::size_t task_index(const std::string& name) const;
  std::vector<Wire> resolve_wires() const;
  std::vector<EventRow> resolve_reactions() const;
  std::vector<Watcher> watchers_of(const Executable& executable) const;
  std::uint32_t find_event(const std::string& iri_or_name) const;  // kNoRow: nothing is declared
  void require_sources() const;
  void require_state(State wanted, const char* what) const;
  void reclaim();

  // The loop's thread.
  void loop();
  void cycle(std::uint64_t tick) noexcept;
  void carry_out_commands(std::uint64_t tick) noexcept;
  void apply(Change& change, std::uint64_t tick) noexcept;
  void fault(const Cycle& cycle, const char* about) noexcept;
  void raise_events(const Task& task, const Cycle& cycle) noexcept;
  void react_to_events(const Cycle& cycle) noexcept;
  void carry_out(const EventRow& row, const Cycle& cycle) noexcept;
  void tell(Event::Kind kind, const Cycle& cycle, const char* about) noexcept;
  bool is_commanded_by_another(const Task& task) const noexcept;
  void note(const Event& event) noexcept override;

  HostOptions options_;
  Bindings bindings_;
  std::vector<Task> tasks_;
  std::vector<Connection> connections_;
  std::vector<Wire> wires_;  // the loop's
  std::vector<Guard> guards_;
  std::vector<Reaction> reactions_;
  std::vector<EventRow> rows_;           // do not change once configured
  std::vector<RobotInterface*> robots_;  // that are bound, each once
  std::atomic<State> state_ = State::kIdle;
  std::atomic<bool> stopping_ = false, faulted_ = false, ended_ = false;
  std::uint64_t next_tick_ = 0;
  std::thread thread_;
  RealTimeReport real_time_;
  std::atomic<bool> real_time_known_ = false;

  Ring<Command> commands_{kCommands};
  Ring<Change*> retired_{kCommands};
  Ring<Event> events_{kEvents};
  Ring<std::uint32_t> raised_;                       // rows: from the loop, to its next boundary
  Ring<std::uint32_t> raised_outside_{kCommands};    // rows: from the supervising thread
  bool stop_raised_ = false, fault_raised_ = false;  // the loop's: events that did not fit
  bool stop_asked_ = false;                          // the loop's
  std::atomic<std::uint64_t> raised_count_ = 0, raised_lost_ = 0;
  std::atomic<std::uint64_t> cycles_ = 0, missed_ = 0, events_lost_ = 0;
  Histogram lateness_, execution_;
  Ring<SwapRecord> swapped_{kCommands};
  std::optional<SwapRecord> last_swap_;
};

}  // namespace sinew::runtime
