// Who wrote, changed or tried to: the last acts that rights (rights.h) let pass or refused, oldest
// first, in a ring of fixed size. What no longer fits is counted, never lost in silence.
//
// Passed means passed by the rights: numbers that are not finite, say, are refused afterwards, by a
// Status to whoever wrote. Of a real-time handle the claim is recorded, not each write; of a query
// that it was prepared, not each answer.
//
// Any thread may call anything at any time; nothing here is for real-time threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/world/clock.h"
#include "sinew/world/ids.h"

namespace sinew::world {

// What a component may do, as far as rights go.
enum class Act : std::uint8_t {
  kMeasure,    // write a value of a measurement, or claim it for real time
  kRelate,     // change a symbolic relation: add or remove it, attach or detach a frame
  kModel,      // add or remove an object, or change which model it is an instance of
  kRead,       // read a measurement, or prepare a query that does
  kPerform,    // perform an action (action_effects.h)
  kPredict,    // ask what an action would lead to; changes nothing
  kReadGraph,  // read a named graph, or the unnamed one
};
std::string_view to_string(Act act);

struct AuditEntry {
  std::uint64_t number = 0;  // counts all that was ever recorded, from 0
  Stamp when = {};           // by the audit's clock
  Act act = Act::kMeasure;
  bool accepted = false;
  std::string who = {};            // provenance
  std::string what = {};           // IRI; empty for a measurement that is younger than the rights
  MeasurementId measurement = {};  // of Act::kMeasure and Act::kRead
  std::string reason = {};         // of a refusal
};

inline constexpr std::size_t kMaximumAuditEntries = 1u << 20;
inline constexpr std::size_t kUsualAuditEntries = 4096;

class Audit {
 public:
  // Throws Error unless 1 <= capacity <= kMaximumAuditEntries. The clock must not call the world.
  explicit Audit(std::size_t capacity = kUsualAuditEntries,
                 std::function<Stamp()> clock = system_now);

  void record(AuditEntry entry);  // gives it its number and time

  std::vector<AuditEntry> entries() const;  // those that are still there, oldest first
  std::size_t capacity() const { return capacity_; }
  struct Counts {
    std::uint64_t accepted = 0, refused = 0;
    std::uint64_t dropped = 0;  // recorded, and overwritten since
  };
  Counts counts() const;

 private:
  const std::size_t capacity_;
  const std::function<Stamp()> clock_;
  mutable std::mutex mutex_;
  std::vector<AuditEntry> ring_;  // entry `number` is at number % capacity_
  std::uint64_t recorded_ = 0;
  Counts counts_;
};

}  // namespace sinew::world
