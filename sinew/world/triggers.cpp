#include "sinew/world/triggers.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "sinew/world/impl.h"
#include "sinew/world/refuse.h"

namespace sinew::world {
namespace {

// What was seen of a measurement at a look.
struct Seen {
  const Cell* cell = nullptr;
  std::uint64_t entries = 0, corrections = 0;
  bool settled = false;
};

constexpr std::uint64_t correction_count(std::uint64_t head) {
  return (head & Head::kCorrections) >> Head::kCorrectionShift;
}
// Corrections are counted in a few bits, so their difference is taken in those.
constexpr std::uint64_t kCorrectionMask = Head::kCorrections >> Head::kCorrectionShift;

Seen see(const World& world, MeasurementId measurement) {
  const State state = world.state();
  const MeasurementRecord* const record = state.measurements.find(measurement.index);
  Seen seen;
  if (!record || !record->alive) return seen;
  const Epoch as_of = world.impl().as_of(record->cell->owner());
  for (int attempt = 0; attempt < kReadAttempts && !seen.settled; ++attempt) {
    const Cell::View view = record->cell->view(as_of);
    seen = {record->cell.get(), view.count, correction_count(view.head), view.settled};
  }
  return seen;
}

std::uint64_t updates_between(const Seen& before, const Seen& after) {
  // A clone that writes for the first time goes on in a cell of its own.
  if (before.cell != after.cell) return std::max<std::uint64_t>(1, after.entries - before.entries);
  return after.entries - before.entries +
         ((after.corrections - before.corrections) & kCorrectionMask);
}

}  // namespace

struct Triggers::Trigger {
  TriggerId id;
  TriggerSpec spec;
  std::variant<std::shared_ptr<EventQueue>, Executor> listener;
  std::atomic<bool> alive = true;
  // What was true at the last look; only the thread that looks touches it.
  Seen seen = {};
  std::uint64_t structure = 0;
  bool held = false;
  bool begun = false;
  Stamp due = {};

  // How many things happened that it waits for.
  std::uint64_t look(const World& world, Stamp now) {
    if (const auto* change = std::get_if<OnChange>(&spec.when)) {
      const Seen after = see(world, change->measurement);
      if (!after.settled) return 0;  // removed, or busy: at the next look
      const std::uint64_t updates = updates_between(seen, after);
      seen = after;
      return updates;
    }
    if (std::holds_alternative<OnStructure>(spec.when)) {
      const std::uint64_t before = std::exchange(structure, world.structure_version());
      return structure - before;
    }
    if (const auto* condition = std::get_if<OnCondition>(&spec.when)) {
      const bool before = std::exchange(held, condition->holds(world, now));
      return held && !before ? 1 : 0;
    }
    const Duration period = std::get<Cyclic>(spec.when).period;
    if (!begun) {
      begun = true;
      due = now + period;
      return 1;
    }
    if (now < due) return 0;
    const auto periods = 1 + (now - due) / period;  // on the grid, however late the look
    due += periods * period;
    return static_cast<std::uint64_t>(periods);
  }
};

struct Triggers::Happened {
  std::shared_ptr<Trigger> trigger;
  Event event;
};

TriggerId Triggers::add(TriggerSpec spec, std::shared_ptr<EventQueue> listener) {
  if (!listener) refuse({}, "a trigger without a queue", "the queue that the listener runs");
  return add_to(std::move(spec), std::move(listener));
}

TriggerId Triggers::add(TriggerSpec spec, Executor listener) {
  if (!listener) refuse({}, "a trigger without an executor", "a function that runs the work");
  return add_to(std::move(spec), std::move(listener));
}

TriggerId Triggers::add_to(TriggerSpec spec,
                           std::variant<std::shared_ptr<EventQueue>, Executor> listener) {
  if (!spec.callback) refuse({}, "a trigger without a callback", "a function to call");
  auto trigger = std::make_shared<Trigger>();
  if (const auto* change = std::get_if<OnChange>(&spec.when)) {
    world_.name(change->measurement);  // throws where there is none
    trigger->seen = see(world_, change->measurement);
  } else if (const auto* condition = std::get_if<OnCondition>(&spec.when)) {
    if (!condition->holds) refuse({}, "a trigger on a condition that is none", "a function");
  } else if (const auto* cyclic = std::get_if<Cyclic>(&spec.when)) {
    if (cyclic->period <= Duration::zero()) {
      refuse({},
             "a cyclic trigger with a period of " + std::to_string(cyclic->period.count()) + " ns",
             "more than nothing");
    }
  }
  trigger->structure = world_.structure_version();
  trigger->spec = std::move(spec);
  trigger->listener = std::move(listener);
  const std::lock_guard lock(mutex_);
  if (triggers_.size() == kMaximumTriggers) {
    refuse({}, "more than " + std::to_string(kMaximumTriggers) + " triggers", "remove some");
  }
  trigger->id = {++made_};
  triggers_.push_back(trigger);
  return trigger->id;
}

bool Triggers::remove(TriggerId id) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(triggers_.begin(), triggers_.end(),
                                  [id](const auto& trigger) { return trigger->id == id; });
  if (found == triggers_.end()) return false;
  (*found)->alive = false;
  triggers_.erase(found);
  return true;
}

std::size_t Triggers::look(Stamp now) {
  const std::lock_guard turn(looking_);
  std::vector<std::shared_ptr<Trigger>> all;
  {
    const std::lock_guard lock(mutex_);
    all = triggers_;
  }
  std::vector<Happened> happened;
  for (const auto& trigger : all) {
    if (const std::uint64_t count = trigger->look(world_, now)) {
      happened.push_back({trigger, {trigger->id, now, count}});
    }
  }
  std::stable_sort(happened.begin(), happened.end(), [](const Happened& a, const Happened& b) {
    return a.trigger->spec.priority > b.trigger->spec.priority;
  });
  for (const Happened& one : happened) {
    // Weak: the trigger holds the queue that this may wait in.
    const auto work = [waiting = std::weak_ptr(one.trigger), event = one.event] {
      const auto trigger = waiting.lock();
      if (trigger && trigger->alive) trigger->spec.callback(event);
    };
    if (const auto* queue = std::get_if<std::shared_ptr<EventQueue>>(&one.trigger->listener)) {
      (*queue)->push(one.trigger->spec.priority, work);
    } else {
      std::get<Executor>(one.trigger->listener)(work);
    }
  }
  return happened.size();
}

Watch::Watch(Triggers& triggers, Duration period, std::function<Stamp()> clock) {
  if (period <= Duration::zero()) refuse({}, "a watch that never rests", "a positive period");
  thread_ = std::thread([this, &triggers, period, clock = std::move(clock)] {
    auto next = std::chrono::steady_clock::now();
    std::unique_lock lock(mutex_);
    while (!end_) {
      lock.unlock();
      triggers.look(clock());
      lock.lock();
      // A look that took longer than the period is not made up for.
      next = std::max(next + period, std::chrono::steady_clock::now());
      ending_.wait_until(lock, next, [this] { return end_; });
    }
  });
}

Watch::~Watch() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  ending_.notify_one();
  thread_.join();
}

}  // namespace sinew::world
