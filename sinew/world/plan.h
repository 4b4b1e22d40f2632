// A planned query: the way from one frame to another as a list of measured steps with the constants
// between them, and the reading of all its cells at one instant. Immutable once made; real-time
// threads only read it.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "sinew/world/answer.h"
#include "sinew/world/prepared.h"
#include "sinew/world/state.h"

namespace sinew::world {

// A measurement that a step may use.
struct Candidate {
  const Cell* cell = nullptr;
  Epoch as_of = kNow;
  const MeasurementModel* model = nullptr;
  const Prediction* prediction = nullptr;  // of the model, if it has one
  Duration validity = kForever;
  Stamp expiry = Stamp::max();
  Duration period = kForever;
  // Where every entry is kept: what there is at each reading, or what a clone found.
  const PublishedHistory* published = nullptr;
  const History* inherited = nullptr;
  MeasurementId measurement;
  Quantity quantity = Quantity::kPose;
  bool is_static = false;
  bool is_timed = false;  // validity, expiry or period is declared
};

// Of a measurement that is seen as it was in that epoch.
Candidate candidate_of(const MeasurementRecord& record, MeasurementId measurement, Epoch as_of);

struct PlanStep {
  RelationKind kind = RelationKind::kFree;
  // One measurement, a pose without a model, between whose entries is a line: the usual case, which
  // is read without detours.
  bool is_simple = false;
  bool inverse = false;                // walked from B to A
  bool has_before = false;             // `before` is not the identity
  bool freshest = false;               // choose among the candidates by stamp
  std::uint32_t first = 0, count = 0;  // candidates for the position
  // Candidates for velocity and acceleration; kNone: there are none.
  Index velocity = kNone, acceleration = kNone;
  Pose before;  // constant pose to compose with first
};

struct Plan {
  Status status = Status::kOk;
  std::uint64_t structure_version = 0;
  std::vector<PlanStep> steps;
  std::vector<Candidate> candidates;
  bool keeps_past = false;  // some candidate has a history
  bool has_tail = false;
  Pose tail;
  std::vector<SymbolicStep> symbolic;
  std::vector<std::shared_ptr<const void>> keep;  // cells and models
};

// All that it may read, constants too; each once.
std::vector<MeasurementId> measurements_of(const Plan& plan);

// Where cells of other owners are seen from.
using AsOf = std::function<Epoch(std::uint64_t owner)>;

// Plans a query. With `motion`, velocities and accelerations of each step are looked for as well.
std::shared_ptr<const Plan> make_plan(const State& state, const Names& names, const AsOf& as_of,
                                      const PoseQuery& query, bool motion,
                                      std::uint64_t structure_version);

// The last entries, predicted to `now`; or the state at a time. Bounded, no allocation, no lock.
// What a ring no longer covers is taken from the history, for whoever has a place among its readers
// (published_history.h).
void read_latest(const Plan& plan, Stamp now, Policy policy, PoseAnswer& answer);
void read_at(const Plan& plan, Stamp time, Policy policy, ReaderPlace* reader, PoseAnswer& answer);
void read_latest_common(const Plan& plan, Policy policy, ReaderPlace* reader, PoseAnswer& answer);
void read_motion(const Plan& plan, Stamp time, bool latest, Policy policy, ReaderPlace* reader,
                 MotionAnswer& answer);

}  // namespace sinew::world
