// The part of the host that runs in its loop's thread: no allocation, no lock, bounded work.
#include <algorithm>

#include "sinew/runtime/host.h"

namespace sinew::runtime {

void Host::note(const Event& event) noexcept {
  if (!events_.push(Event(event))) events_lost_.fetch_add(1, std::memory_order_relaxed);
}

void Host::loop() {
  if (options_.real_time) {
    real_time_ = become_real_time(options_.priority);
  } else {
    real_time_ = {false, false, "not asked for"};
  }
  real_time_known_.store(true, std::memory_order_release);
  real_time_known_.notify_one();

  const Nanoseconds period = from_seconds(options_.period_s);
  Nanoseconds next = now() + period;
  std::uint64_t ran = 0;
  while (!stopping_.load(std::memory_order_acquire) && !stop_asked_ &&
         (options_.cycles == 0 || ran < options_.cycles)) {
    sleep_until(next);
    const Nanoseconds began = now();
    lateness_.add(began - next);
    if (began - next >= period && options_.late == LateCycles::kSkip) {
      const auto behind = static_cast<std::uint64_t>((began - next) / period);
      missed_.fetch_add(behind, std::memory_order_relaxed);
      Event event{Event::Kind::kOverrun, next_tick_, began, static_cast<double>(behind), {}};
      note(event);
      next_tick_ += behind;
      next += static_cast<Nanoseconds>(behind) * period;
      ran += behind;
    }
    cycle(next_tick_++);
    execution_.add(now() - began);
    next += period;
    ++ran;
  }
  for (const Task& task : tasks_) task.executable->write_safe();
  ended_.store(true, std::memory_order_release);
}

void Host::cycle(std::uint64_t tick) noexcept {
  carry_out_commands(tick);
  const Cycle cycle{tick, now(), from_seconds(options_.age_limit_s), this};
  react_to_events(cycle);
  for (std::uint32_t i = 0; i < tasks_.size(); ++i) {
    Task& task = tasks_[i];
    if (faulted_.load(std::memory_order_relaxed) || stop_asked_) {
      task.executable->write_safe();
      continue;
    }
    if (tick % task.options.every != 0) continue;
    if (task.halted) {
      if (!is_commanded_by_another(task)) task.executable->write_safe();
      continue;
    }
    for (const Wire& wire : wires_)
      if (wire.to_task == i) std::copy_n(wire.from, wire.size, wire.to);
    if (task.executable->run(cycle) == Verdict::kFault)
      fault(cycle, task.options.name.c_str());
    else
      raise_events(task, cycle);
  }
  for (RobotInterface* robot : robots_) robot->end_cycle();
  if (bindings_.recorder && !faulted_.load(std::memory_order_relaxed))
    bindings_.recorder->commit(tick, cycle.start);
  cycles_.fetch_add(1, std::memory_order_relaxed);
}

void Host::tell(Event::Kind kind, const Cycle& cycle, const char* about) noexcept {
  Event event{kind, cycle.tick, cycle.start, 0, {}};
  event.set_about(about);
  note(event);
}

void Host::fault(const Cycle& cycle, const char* about) noexcept {
  faulted_.store(true, std::memory_order_relaxed);
  tell(Event::Kind::kFaulted, cycle, about);
  // Also those tasks that have run in this cycle.
  for (const Task& each : tasks_) each.executable->write_safe();
  State running = State::kRunning;
  state_.compare_exchange_strong(running, State::kFaulted, std::memory_order_release);
}

void Host::carry_out_commands(std::uint64_t tick) noexcept {
  Command command;
  for (std::size_t i = 0; i < kCommands && commands_.pop(command); ++i) {
    if (command.change != nullptr)
      apply(*command.change, tick);
    else
      std::copy_n(command.values.begin(), command.size, command.target);
  }
}

// The exchange itself: copies states, exchanges pointers, hands the old program back.
void Host::apply(Change& change, std::uint64_t tick) noexcept {
  const Nanoseconds began = now(), cpu = thread_time();
  for (const StateCopy& copy : change.copies) {
    if (copy.convert)
      copy.convert(copy.from, copy.to);
    else
      std::copy(copy.from.begin(), copy.from.end(), copy.to.begin());
  }
  Task& task = tasks_[change.task];
  std::swap(task.executable, change.executable);
  std::swap(wires_, change.wires);
  std::swap(task.watchers, change.watchers);
  const Nanoseconds ended = now();
  swapped_.push({tick, change.requested, ended, ended - began, thread_time() - cpu});
  Event event{Event::Kind::kSwapped, tick, ended, to_seconds(ended - began), {}};
  event.set_about(task.options.name.c_str());
  note(event);
  // There is room: no more changes are under way than the ring of commands holds.
  retired_.push(&change);
}

}  // namespace sinew::runtime
