// What a query answers: a value where there is one, why not where there is none, and how fresh its
// ingredients are. Plain values: real-time threads make and read them.
#pragma once

#include <cstdint>
#include <string_view>

#include "sinew/world/clock.h"
#include "sinew/world/ids.h"
#include "sinew/world/pose.h"

namespace sinew::world {

enum class Status : std::uint8_t {
  kOk,
  kNoData,         // a measurement on the way was never written
  kTooOld,         // asked for a time before the oldest entry
  kTooNew,         // after the newest one, and no model says what comes then
  kBeyondHorizon,  // after the newest one by more than its model's horizon
  kNoModel,        // the model needs entries that are not there yet
  kExpired,        // with Policy::kFilter: an ingredient no longer holds
  kTimeOut,        // with Policy::kWait: nothing fresh arrived in time
  kBusy,           // writers never paused during kReadAttempts attempts
  kRemoved,        // a frame or relation of the query is no more
  kNotConnected,   // there is no way between the frames
  kNoMotion,       // a twist or acceleration is asked, and a relation on the way has none measured
  kOutOfOrder,     // write: the stamp is not later than the last one; see `correct`
  kNotANumber,     // write: a number is not finite, or a quaternion not of length one
  kTooLate,        // write: older than all that the ring holds
  kReadOnly,       // write: a derived data block
  kFull,           // write: the history holds kMaximumHistory entries
  kStatic,         // write: a static measurement has its value already
  kNoRoom,         // real-time write: the history's collector is behind (write_log.h)
  kForbidden,      // whoever asks or writes may not, since the rights have changed (access.h)
};
std::string_view to_string(Status status);

// Quality of an answer, as measures of data-integration systems (Peralta 2006, "Data quality
// evaluation in data integration systems"), over all measurements that it was made from. Static
// ones count as fresh and have no age.
struct Freshness {
  Duration currency{};             // age of the oldest ingredient
  Duration timeliness{};           // time since the last update of any ingredient
  std::uint64_t obsolescence = 0;  // updates that should have come since, by the declared periods
  double rate = 1;                 // share of the ingredients that still hold
  Stamp expires = Stamp::max();    // when the first of them stops to
  bool predicted = false;          // a model was used
};

enum class Policy : std::uint8_t {
  kInform,  // answer always, with the freshness
  kFilter,  // no answer that has expired
  kWait,    // wait for a fresh one, for a while (not for real-time threads)
};

// When something is asked for a time that is not covered: whose, and what is.
struct Bounds {
  MeasurementId measurement;
  Stamp oldest = Stamp::max(), newest = Stamp::min();
};

struct PoseAnswer {
  Status status = Status::kNoData;
  Pose pose;
  Freshness freshness;
  Bounds bounds;                   // of the first measurement that had no answer
  bool structure_changed = false;  // the plan is older than the world's structure: refresh
  explicit operator bool() const { return status == Status::kOk; }
};

// Motion of a frame B with respect to A: seen from B, about its origin. Accelerations are
// classical.
struct MotionAnswer {
  Status status = Status::kNoData;
  Pose pose;
  Twist twist;
  Acceleration acceleration;
  Freshness freshness;
  Bounds bounds;
  bool structure_changed = false;
  explicit operator bool() const { return status == Status::kOk; }
};

}  // namespace sinew::world
