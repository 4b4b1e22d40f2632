// Events of a host: what is declared for them, and how the loop reacts at the boundaries of cycles.
#include <algorithm>

#include "sinew/base/error.h"
#include "sinew/runtime/host.h"

namespace sinew::runtime {
namespace {

[[noreturn]] void fail(std::string iri, std::string what, std::string remedy) {
  throw Error(Problem{{}, std::move(iri), std::move(what), std::move(remedy), {}, {}});
}

}  // namespace

// --- by the supervising thread ---

void Host::react(Reaction reaction) {
  require_state(State::kIdle, "a reaction can be declared");
  reactions_.push_back(std::move(reaction));
}

std::vector<EventRow> Host::resolve_reactions() const {
  std::vector<EventRow> rows;
  for (const Reaction& reaction : reactions_) {
    // A task calls it by its block's name or by the model's IRI; what comes from outside has only
    // the name that the reaction says.
    std::string event, known;
    for (const Task& task : tasks_) {
      for (const std::uint32_t block : task.latest->events()) {
        const program::Variable& about = task.latest->storage().about(block);
        if (about.represents == reaction.event || about.name == reaction.event)
          event = about.represents;
        known += (known.empty() ? "" : ", ") + about.name;
      }
    }
    if (event.empty() && reaction.from_outside) event = reaction.event;
    if (event.empty())
      fail(reaction.event, "something is declared for this event, but no task raises it",
           known.empty() ? "let an edge-triggered monitor of a task raise it"
                         : "the tasks raise " + known);
    const bool of_task =
        reaction.kind == ReactionKind::kStartTask || reaction.kind == ReactionKind::kHaltTask;
    const auto task = of_task ? static_cast<std::uint32_t>(task_index(reaction.task)) : 0U;
    auto row = std::find_if(rows.begin(), rows.end(),
                            [&](const EventRow& each) { return each.event == event; });
    if (row == rows.end()) row = rows.insert(rows.end(), {event, {}});
    row->effects.push_back({reaction.kind, task});
  }
  return rows;
}

std::vector<Watcher> Host::watchers_of(const Executable& executable) const {
  std::vector<Watcher> watchers;
  const Storage& storage = executable.storage();
  for (const std::uint32_t block : executable.events())
    watchers.push_back({storage.numbers(block).data(), storage.about(block).name.c_str(),
                        find_event(storage.about(block).represents)});
  return watchers;
}

std::uint32_t Host::find_event(const std::string& iri_or_name) const {
  for (std::uint32_t i = 0; i < rows_.size(); ++i)
    if (rows_[i].event == iri_or_name) return i;
  for (const Task& task : tasks_)
    for (const std::uint32_t block : task.latest->events()) {
      const program::Variable& about = task.latest->storage().about(block);
      if (about.name != iri_or_name) continue;
      for (std::uint32_t i = 0; i < rows_.size(); ++i)
        if (rows_[i].event == about.represents) return i;
    }
  return kNoRow;
}

void Host::raise(const std::string& event) {
  if (state() == State::kIdle) fail(event, "the host is not configured", "configure it first");
  std::uint32_t row = find_event(event);
  if (row == kNoRow) fail(event, "nothing is declared for this event", "declare a reaction to it");
  if (!raised_outside_.push(std::move(row)))
    fail(event, "the loop has not seen the events before this one", "wait for a cycle");
}

bool Host::is_halted(const std::string& task) const {
  if (thread_.joinable())
    fail("", "whether a task is halted can be seen only while the host does not run", "");
  return tasks_[task_index(task)].halted;
}

// --- by the loop's thread ---

void Host::raise_events(const Task& task, const Cycle& cycle) noexcept {
  for (const Watcher& watcher : task.watchers) {
    if (*watcher.flag == 0) continue;
    tell(Event::Kind::kRaised, cycle, watcher.name);
    if (watcher.row == kNoRow) continue;
    if (raised_.push(std::uint32_t(watcher.row))) {
      raised_count_.fetch_add(1, std::memory_order_relaxed);
      continue;
    }
    raised_lost_.fetch_add(1, std::memory_order_relaxed);
    tell(Event::Kind::kEventLost, cycle, watcher.name);
    for (const EventRow::Effect& effect : rows_[watcher.row].effects) {
      stop_raised_ |= effect.kind == ReactionKind::kStop;
      fault_raised_ |= effect.kind == ReactionKind::kFault;
    }
  }
}

void Host::react_to_events(const Cycle& cycle) noexcept {
  std::uint32_t row = 0;
  for (std::size_t i = 0; i < raised_.capacity() && raised_.pop(row); ++i)
    carry_out(rows_[row], cycle);
  for (std::size_t i = 0; i < raised_outside_.capacity() && raised_outside_.pop(row); ++i) {
    raised_count_.fetch_add(1, std::memory_order_relaxed);
    tell(Event::Kind::kRaised, cycle, rows_[row].event.c_str());
    carry_out(rows_[row], cycle);
  }
  if (fault_raised_) fault(cycle, "an event that was lost");
  if (stop_raised_) {
    stop_asked_ = true;
    tell(Event::Kind::kStopped, cycle, "an event that was lost");
  }
  fault_raised_ = stop_raised_ = false;
}

void Host::carry_out(const EventRow& row, const Cycle& cycle) noexcept {
  for (const EventRow::Effect& effect : row.effects) {
    Task& task = tasks_[effect.task];
    switch (effect.kind) {
      case ReactionKind::kStop:
        stop_asked_ = true;
        tell(Event::Kind::kStopped, cycle, row.event.c_str());
        break;
      case ReactionKind::kFault:
        if (!faulted_.load(std::memory_order_relaxed)) fault(cycle, row.event.c_str());
        break;
      case ReactionKind::kStartTask:
        if (!task.halted) break;
        task.halted = false;
        task.executable->reset_states();
        tell(Event::Kind::kStarted, cycle, task.options.name.c_str());
        break;
      case ReactionKind::kHaltTask:
        if (task.halted) break;
        task.halted = true;
        tell(Event::Kind::kHalted, cycle, task.options.name.c_str());
        break;
    }
  }
}

bool Host::is_commanded_by_another(const Task& task) const noexcept {
  for (const Task& other : tasks_) {
    if (other.halted) continue;
    for (const RobotInterface* robot : other.executable->commanded())
      for (const RobotInterface* own : task.executable->commanded())
        if (robot == own) return true;
  }
  return false;
}

}  // namespace sinew::runtime
