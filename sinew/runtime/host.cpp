#include "sinew/runtime/host.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/base/error.h"

namespace sinew::runtime {
namespace {

[[noreturn]] void fail(std::string iri, std::string what, std::string remedy) {
  throw Error(Problem{{}, std::move(iri), std::move(what), std::move(remedy), {}, {}});
}

std::string seconds(double value) { return fmt::format("{} s", value); }

// Two periods are the same within rounding.
constexpr double kSamePeriod = 1e-9;

// What integrates over time must run as often as it was made for.
void require_period(const Executable& executable, const TaskOptions& options, double base_s) {
  const double period = base_s * options.every;
  const std::optional<double> wanted = executable.period_s();
  if (!wanted || std::abs(*wanted - period) <= kSamePeriod * period) return;
  fail("",
       "task '" + options.name + "' integrates over steps of " + seconds(*wanted) +
           ", but would run every " + seconds(period),
       "let it run every " + seconds(*wanted));
}

}  // namespace

std::string_view to_string(State state) {
  constexpr std::array<std::string_view, 4> names = {"idle", "configured", "running", "faulted"};
  return names[static_cast<std::size_t>(state)];
}

Host::Host(HostOptions options)
    : options_(options),
      raised_(std::clamp<std::size_t>(options.event_capacity, 1, kMaximumEventCapacity)) {
  if (options.event_capacity == 0 || options.event_capacity > kMaximumEventCapacity)
    fail("", "a queue for " + std::to_string(options.event_capacity) + " events",
         "1 to " + std::to_string(kMaximumEventCapacity));
  if (!(options_.period_s >= 1e-6 && options_.period_s <= 1e3))
    fail("", "a period of " + std::to_string(options_.period_s) + " s", "1 us to 1000 s");
}

Host::~Host() {
  stopping_.store(true, std::memory_order_release);
  if (thread_.joinable()) stop();
  Command command;
  while (commands_.pop(command)) delete command.change;
  reclaim();
}

// --- before configure ---

void Host::add_task(const TaskOptions& options, std::unique_ptr<Executable> executable) {
  require_state(State::kIdle, "a task can be added");
  for (const Task& task : tasks_)
    if (task.options.name == options.name)
      fail("", "a second task '" + options.name + "'", "each has a name of its own");
  if (options.every == 0)
    fail("", "task '" + options.name + "' runs in every 0th cycle", "1 or more");
  require_period(*executable, options, options_.period_s);
  Task& task = tasks_.emplace_back();
  task.options = options;
  task.halted = options.halted;
  task.latest = executable.get();
  task.given.resize(executable->storage().size(), false);
  task.executable = std::move(executable);
}

void Host::connect(Connection connection) {
  require_state(State::kIdle, "a connection can be made");
  connections_.push_back(std::move(connection));
}

std::size_t Host::task_index(const std::string& name) const {
  for (std::size_t i = 0; i < tasks_.size(); ++i)
    if (tasks_[i].options.name == name) return i;
  fail("", "no task is named '" + name + "'", "add it first");
}

std::vector<Host::Wire> Host::resolve_wires() const {
  std::vector<Wire> wires;
  for (const Connection& connection : connections_) {
    const auto end = [&](const std::string& task, const std::string& block) {
      const Executable& executable = *tasks_[task_index(task)].latest;
      const std::uint32_t found = executable.storage().find(block);
      if (found == kNoBlock)
        fail("", "task '" + task + "' has no data block '" + block + "'",
             "connect an output to an input");
      return found;
    };
    const std::uint32_t from = end(connection.from_task, connection.from);
    const std::uint32_t to = end(connection.to_task, connection.to);
    const std::size_t from_task = task_index(connection.from_task);
    const std::size_t to_task = task_index(connection.to_task);
    const Storage& source = tasks_[from_task].latest->storage();
    const Executable& sink = *tasks_[to_task].latest;
    if (!same_prototype(source.about(from), sink.storage().about(to)))
      fail(sink.storage().about(to).iri,
           connection.from + " and " + connection.to + " do not mean the same",
           "connect blocks of one quantity, unit, frame and size");
    const auto& points = sink.set_points();
    if (std::find(points.begin(), points.end(), to) == points.end())
      fail(sink.storage().about(to).iri, connection.to + " is filled already",
           "connect to an input that no 'read' fills");
    // The sink is owned by its task; a program that is on its way is not const there.
    wires.push_back({static_cast<std::uint32_t>(to_task),
                     static_cast<std::uint32_t>(source.numbers(from).size()),
                     source.numbers(from).data(),
                     const_cast<double*>(sink.storage().numbers(to).data())});
  }
  return wires;
}

void Host::require_sources() const {
  std::string missing;
  for (const Task& task : tasks_) {
    for (const std::uint32_t point : task.latest->set_points()) {
      const program::Variable& about = task.latest->storage().about(point);
      const bool connected =
          std::any_of(connections_.begin(), connections_.end(), [&](const Connection& connection) {
            return connection.to_task == task.options.name &&
                   (connection.to == about.iri || connection.to == about.name);
          });
      if (task.given[point] || connected) continue;
      missing += (missing.empty() ? "" : ", ") + about.name;
    }
  }
  if (!missing.empty())
    fail("", "nothing gives these inputs a value: " + missing,
         "set them, connect them, or read them from a robot");
}

void Host::require_state(State wanted, const char* what) const {
  if (state() == wanted) return;
  fail("",
       std::string(what) + " only while the host is " + std::string(to_string(wanted)) +
           "; it is " + std::string(to_string(state())),
       "");
}

// --- life-cycle ---

void Host::configure() {
  require_state(State::kIdle, "it can be configured");
  if (tasks_.empty()) fail("", "a host without tasks", "add one");
  wires_ = resolve_wires();
  require_sources();
  rows_ = resolve_reactions();
  for (Task& task : tasks_) task.watchers = watchers_of(*task.executable);
  for (const auto& [iri, robot] : bindings_.robots)
    if (std::find(robots_.begin(), robots_.end(), robot.get()) == robots_.end())
      robots_.push_back(robot.get());
  state_.store(State::kConfigured, std::memory_order_release);
}

void Host::start() {
  require_state(State::kConfigured, "it can start");
  for (const Guard& guard : guards_)
    if (const auto why = guard()) fail("", "it may not start: " + *why, "");
  for (const auto& [iri, robot] : bindings_.robots) robot->start();
  if (bindings_.recorder) bindings_.recorder->start();
  stopping_.store(false, std::memory_order_release);
  real_time_known_.store(false, std::memory_order_release);
  ended_.store(false, std::memory_order_release);
  stop_asked_ = false;
  state_.store(State::kRunning, std::memory_order_release);
  thread_ = std::thread([this] { loop(); });
  real_time_known_.wait(false, std::memory_order_acquire);
}

void Host::stop() {
  if (!thread_.joinable()) return;
  stopping_.store(true, std::memory_order_release);
  wait();
}

void Host::wait() {
  if (!thread_.joinable()) return;
  thread_.join();
  // The log first: it is whole whatever keeps a robot from ending.
  if (bindings_.recorder) bindings_.recorder->stop();
  for (const auto& [iri, robot] : bindings_.robots) robot->stop();
  state_.store(faulted_.load() ? State::kFaulted : State::kConfigured, std::memory_order_release);
  reclaim();
}

void Host::reset() {
  require_state(State::kFaulted, "it can be reset");
  if (thread_.joinable()) fail("", "it still commands what is safe", "stop it first");
  for (Task& task : tasks_) {
    task.executable->reset_states();
    task.halted = task.options.halted;
  }
  faulted_ = false;
  stop_asked_ = false;
  ended_.store(false, std::memory_order_release);
  state_.store(State::kConfigured, std::memory_order_release);
}

void Host::step(std::uint64_t cycles) {
  if (thread_.joinable() || state() == State::kIdle)
    fail("", "it can be stepped only while it is configured and does not run", "");
  for (std::uint64_t i = 0; i < cycles && !stop_asked_; ++i) {
    cycle(next_tick_++);
    if (stop_asked_) ended_.store(true, std::memory_order_release);
  }
  if (faulted_.load()) state_.store(State::kFaulted, std::memory_order_release);
}

// --- while running ---

void Host::set(const std::string& name, const std::string& block, std::span<const double> values) {
  Task& task = tasks_[task_index(name)];
  const Storage& storage = task.latest->storage();
  const std::uint32_t found = storage.find(block);
  const auto& points = task.latest->set_points();
  if (found == kNoBlock || std::find(points.begin(), points.end(), found) == points.end()) {
    std::string known;
    for (const std::uint32_t point : points) known += " " + storage.about(point).name;
    fail("", "task '" + name + "' has no set point '" + block + "'",
         known.empty() ? "it has none" : "it has" + known);
  }
  if (values.size() != storage.about(found).size)
    fail(storage.about(found).iri,
         block + " holds " + std::to_string(storage.about(found).size) + " numbers, not " +
             std::to_string(values.size()),
         "give each of them a value");
  // The block is this host's own; what is on its way to the loop is const only for the looker-on.
  auto* target = const_cast<double*>(storage.numbers(found).data());
  if (!thread_.joinable() && task.latest == task.executable.get()) {
    std::copy(values.begin(), values.end(), target);
  } else {
    if (values.size() > kMaximumSetPoint)
      fail(storage.about(found).iri, block + " is too large to be set while the host runs",
           "at most " + std::to_string(kMaximumSetPoint) + " numbers");
    Command command;
    command.target = target;
    command.size = static_cast<std::uint32_t>(values.size());
    std::copy(values.begin(), values.end(), command.values.begin());
    if (!commands_.push(std::move(command)))
      fail("", "the loop has not carried out the commands before this one", "wait for a cycle");
  }
  task.given[found] = true;
}

// Not std::swap: it may throw.
SwapReport Host::swap(const std::string& name,  // NOLINT(bugprone-exception-escape)
                      std::unique_ptr<Executable> next, const SwapRules& rules) {
  if (state() == State::kIdle || state() == State::kFaulted)
    fail("", "a program can be swapped only while the host is configured or running", "");
  reclaim();
  const std::size_t index = task_index(name);
  Task& task = tasks_[index];
  require_period(*next, task.options, options_.period_s);
  StatePlan plan = plan_states(*task.latest, task.given, *next, rules);
  const Executable* before = task.latest;
  std::vector<bool> given_before = std::move(task.given);
  const auto undo = [&] {
    task.latest = before;
    task.given = std::move(given_before);
  };
  task.latest = next.get();
  task.given = plan.given;
  auto change = std::make_unique<Change>();
  try {
    change->wires = resolve_wires();
    change->watchers = watchers_of(*next);
    require_sources();
  } catch (...) {
    undo();
    throw;
  }
  change->task = static_cast<std::uint32_t>(index);
  change->executable = std::move(next);
  change->copies = std::move(plan.copies);
  change->requested = now();
  Command command;
  command.change = change.get();
  if (!commands_.push(std::move(command))) {
    undo();
    fail("", "the loop has not carried out the commands before this one", "wait for a cycle");
  }
  change.release();  // NOLINT: the loop hands it back through retired_
  return plan.report;
}

std::optional<SwapRecord> Host::last_swap() {
  SwapRecord record;
  while (swapped_.pop(record)) last_swap_ = record;
  return last_swap_;
}

std::vector<double> Host::read(const std::string& name, const std::string& block) const {
  if (thread_.joinable()) fail("", "its blocks can be read only while the host does not run", "");
  const Executable& executable = *tasks_[task_index(name)].executable;
  const std::uint32_t found = executable.storage().find(block);
  if (found == kNoBlock) fail("", "task '" + name + "' has no data block '" + block + "'", "");
  const auto numbers = executable.storage().numbers(found);
  return {numbers.begin(), numbers.end()};
}

std::vector<Event> Host::take_events() {
  std::vector<Event> events;
  Event event;
  while (events_.pop(event)) events.push_back(event);
  return events;
}

HostStatistics Host::statistics() const {
  return {cycles_.load(std::memory_order_relaxed),
          missed_.load(std::memory_order_relaxed),
          events_lost_.load(std::memory_order_relaxed),
          raised_count_.load(std::memory_order_relaxed),
          raised_lost_.load(std::memory_order_relaxed),
          &lateness_,
          &execution_};
}

void Host::reclaim() {
  Change* change = nullptr;
  while (retired_.pop(change)) delete change;
}

}  // namespace sinew::runtime
