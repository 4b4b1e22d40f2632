// What a cycle of the loop tells those who take part in it, and what they tell the loop.
#pragma once

#include <array>
#include <cstdint>

#include "sinew/runtime/clock.h"

namespace sinew::runtime {

// Something worth telling, noted in the loop without allocating: what it is about is copied, and
// cut where it is too long, since the program that names it may be gone when somebody reads it.
struct Event {
  enum class Kind : std::uint8_t {
    kStale,       // a measurement is older than its limit: value is its age [s]
    kOutOfRange,  // value left the range of a check
    kFlag,        // a flag is up
    kSwapped,     // another program runs from this cycle on: value is the time it took [s]
    kOverrun,     // cycles were missed: value is how many
    kFaulted,     // the host went to the fault state
    kRaised,      // a monitor's event
    kEventLost,   // an event found the queue full
    kStopped,     // an event ended the loop
    kStarted,     // a task that was halted runs
    kHalted,      // a task runs no more
  };
  Kind kind = Kind::kFaulted;
  std::uint64_t tick = 0;
  Nanoseconds time = 0;
  double value = 0;
  std::array<char, 80> about = {};  // the block, the closure's label, the task; zero-terminated

  void set_about(const char* text) noexcept {
    std::size_t i = 0;
    for (; i + 1 < about.size() && text[i] != 0; ++i) about[i] = text[i];
    about[i] = 0;
  }
};

class EventSink {
 public:
  virtual ~EventSink() = default;
  virtual void note(const Event& event) noexcept = 0;
};

struct Cycle {
  std::uint64_t tick = 0;
  Nanoseconds start = 0;      // when this cycle began
  Nanoseconds age_limit = 0;  // of measurements
  EventSink* events = nullptr;
};

// Whether the cycle may go on to its commands.
enum class Verdict : std::uint8_t { kContinue, kFault };

}  // namespace sinew::runtime
