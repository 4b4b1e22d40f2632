// Triggers: a listener is told when a measurement or the structure has changed, when a condition
// has come to hold, or every so often.
//
//   Triggers triggers(world);
//   auto queue = std::make_shared<EventQueue>();
//   triggers.add({.when = OnChange{seen}, .priority = 5, .callback = grasp}, queue);
//   Watch watch(triggers, std::chrono::milliseconds(1));  // a thread that looks
//   while (running) queue->run_one_within(std::chrono::milliseconds(100));  // the listener's
//   thread
//
// Writers are never held up: nobody is told while writing. Instead one thread *looks* (`look`, or a
// Watch), compares with what it saw at the last look, and hands over what happened: to a queue,
// which the listener's thread runs, or to an executor of the listener's. Several writes between two
// looks are one event that says how many they were. So things are noticed at the next look, and the
// work is that of the looks, whatever the writers do.
//
// Threads: all of it may be called from any thread; looks take turns. A condition or callback may
// add and remove triggers, and may ask and write the world, but must not look, and must not throw.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <variant>
#include <vector>

#include "sinew/world/event_queue.h"
#include "sinew/world/world.h"

namespace sinew::world {

struct OnChange {  // an entry was written or corrected
  MeasurementId measurement;
};
struct OnStructure {};  // frames, relations, objects or measurements came, went or were moved
struct OnCondition {    // it holds, and did not at the last look
  std::function<bool(const World& world, Stamp now)> holds;
};
struct Cyclic {  // for the first time at the first look
  Duration period;
};
using Occasion = std::variant<OnChange, OnStructure, OnCondition, Cyclic>;

struct TriggerId {
  std::uint64_t number = 0;  // from 1
  friend constexpr auto operator<=>(TriggerId, TriggerId) = default;
};

struct Event {
  TriggerId trigger = {};
  Stamp now = {};           // of the look
  std::uint64_t count = 1;  // entries written or corrected, structural edits, or periods, since the
                            // last event
};

struct TriggerSpec {
  Occasion when;
  int priority = 0;  // the higher, the sooner
  std::function<void(const Event&)> callback = {};
};

// Runs the work, now or later, in a thread of its choice. Called by the thread that looks.
using Executor = std::function<void(std::function<void()> work)>;

inline constexpr std::size_t kMaximumTriggers = 1u << 16;

class Triggers {
 public:
  // The world must outlive them, where it is. What waits in a queue when they are destroyed is not
  // called.
  explicit Triggers(const World& world) : world_(world) {}
  Triggers(const Triggers&) = delete;

  // What happens from now on. Throws Error when a measurement is none, a period is not positive, a
  // function is missing, or there are kMaximumTriggers.
  TriggerId add(TriggerSpec spec, std::shared_ptr<EventQueue> listener);
  TriggerId add(TriggerSpec spec, Executor listener);
  // What waits in a queue is not run any more; a callback that has begun may still be at work.
  // False when there is none.
  bool remove(TriggerId id);

  // Compares, and hands over what happened, the more urgent first; returns how many events. Stamps
  // must not go back.
  std::size_t look(Stamp now);

 private:
  struct Trigger;
  struct Happened;
  TriggerId add_to(TriggerSpec spec, std::variant<std::shared_ptr<EventQueue>, Executor> listener);

  const World& world_;
  std::mutex looking_;  // one look at a time; taken before `mutex_`
  std::mutex mutex_;
  std::vector<std::shared_ptr<Trigger>> triggers_;
  std::uint64_t made_ = 0;
};

// A thread that looks every `period`, until this is destroyed.
class Watch {
 public:
  Watch(Triggers& triggers, Duration period, std::function<Stamp()> clock = system_now);
  ~Watch();
  Watch(const Watch&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable ending_;
  bool end_ = false;
  std::thread thread_;
};

}  // namespace sinew::world
