// Queries that are planned once and asked often: the relative pose, twist and acceleration of two
// frames along a way through the graph of relations. Constant parts of the way are composed when it
// is planned; what remains is one cell for each measurement.
//
// `latest` reads, from each measurement, its last entry (predicted to `now` where it has a model);
// `at` the state of each at one time, between entries or by a model. All measurements of one answer
// are read at one instant: what a batch wrote is in the answer whole or not at all.
//
// What a ring no longer covers is taken from the measurement's history, where one is kept
// (history.h), in real time too: a search among immutable entries.
//
// Every answer has a freshness; it is judged at `now`, or at the time that was asked for.
//
// A plan holds while the world's structure does. `latest` and `at` plan anew after a change;
// `latest_realtime` and `at_realtime` never do (no allocation, no lock, bounded): they go on with
// the old plan and say so in the answer, until somebody calls `refresh`. One prepared query is used
// by one thread at a time; copies are independent.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sinew/world/answer.h"
#include "sinew/world/ids.h"
#include "sinew/world/published_history.h"
#include "sinew/world/state.h"

namespace sinew::world {

struct WorldImpl;
struct Plan;

// That whoever asks may (access.h). Taken back when rights change; answering only looks at it.
struct Permit {
  std::atomic<bool> holds = true;
};
// Looks at what a plan reads before it is used, and throws Error where somebody may not (reader.h).
using PlanGuard = std::function<std::shared_ptr<const Permit>(const Plan& plan)>;

// Which of several measurements of one relation is used.
enum class Choice : std::uint8_t {
  kFreshest,      // with the latest stamp when it is read; for `at`, the first that covers the time
  kMostCertain,   // with the smallest stated standard deviation, among those that were ever written
  kByProvenance,  // in the order of `provenances`; others not at all
};

// Which of several ways between two frames is taken.
enum class Way : std::uint8_t {
  kShortest,  // over the fewest relations that are measured while it runs, then the fewest at all
  kMostCertain,  // with the smallest sum of variances; a relation without a stated one counts as
                 // kUnstatedDeviation
};
inline constexpr double kUnstatedDeviation = 1.0;

struct PoseQuery {
  FrameId of = {}, with_respect_to = {};
  Choice choice = Choice::kFreshest;
  std::vector<std::string> provenances = {};  // of Choice::kByProvenance
  Way way = Way::kShortest;
  std::vector<FrameId> via = {};       // to pass, in this order
  std::vector<RelationId> avoid = {};  // not to be used
  Policy policy = Policy::kInform;
};

// Cells that one query may read.
inline constexpr std::size_t kMaximumPlanCells = 512;

// One step of the way, in words that do not depend on Sinew: for whoever computes it himself.
struct SymbolicStep {
  std::string operation;    // "compose" or "compose-inverse" with what follows
  std::string relation;     // IRI
  std::string measurement;  // IRI of the one that is used first
  std::string quantity;     // "pose", "joint-position": then through the joint's placement
  bool constant = false;    // may be composed once
  bool inverse = false;     // "compose-inverse": walked from `of` to `with-respect-to`
  RelationId relation_id;
  MeasurementId measurement_id;
  Pose value;  // of a constant: the relation's pose
};

// What both of the following keep; refresh() makes the plan and what belongs to it.
struct PreparedPlan {
  std::shared_ptr<WorldImpl> world;
  PoseQuery query;
  bool with_motion = false;                // velocities and accelerations too
  std::shared_ptr<const PlanGuard> guard;  // of every plan, when it is made; none: null
  std::shared_ptr<const Plan> plan = nullptr;
  std::shared_ptr<const Permit> permit = nullptr;  // of that plan; null: nobody is asked
  OwnReaderPlace place = {};                       // where the plan reads histories

  bool is_current() const;  // no structural change since it was planned
  void refresh();
};

class PreparedPose {
 public:
  PoseAnswer latest(Stamp now);
  PoseAnswer at(Stamp time);
  // At the latest time for which every relation on the way has an entry; without models.
  PoseAnswer latest_common();

  PoseAnswer latest_realtime(Stamp now) const;
  PoseAnswer at_realtime(Stamp time) const;
  PoseAnswer latest_common_realtime() const;

  bool is_current() const { return prepared_.is_current(); }
  void refresh() { prepared_.refresh(); }
  Status status() const;  // of the plan: kOk, kNotConnected, kRemoved
  std::size_t measured_steps() const;

  std::vector<SymbolicStep> symbolic() const;

  const Plan& plan() const { return *prepared_.plan; }

 private:
  friend class World;
  friend class Reader;
  PreparedPose(std::shared_ptr<WorldImpl> world, PoseQuery query,
               std::shared_ptr<const PlanGuard> guard = nullptr);
  PreparedPlan prepared_;
};

class PreparedMotion {
 public:
  MotionAnswer latest(Stamp now);
  MotionAnswer at(Stamp time);
  MotionAnswer latest_realtime(Stamp now) const;
  MotionAnswer at_realtime(Stamp time) const;

  bool is_current() const { return prepared_.is_current(); }
  void refresh() { prepared_.refresh(); }
  Status status() const;
  // Whether every relation on the way that can move has a measured velocity, and acceleration.
  bool has_twist() const;
  bool has_acceleration() const;

 private:
  friend class World;
  friend class Reader;
  PreparedMotion(std::shared_ptr<WorldImpl> world, PoseQuery query,
                 std::shared_ptr<const PlanGuard> guard = nullptr);
  PreparedPlan prepared_;
};

}  // namespace sinew::world
