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
  MeasurementId measurement;
  Quantity quantity = Quantity::kPose;
  bool is_static = false;
  bool is_timed = false;  // validity, expiry or period is declared
};

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
  bool has_tail = false;
  Pose tail;
  std::vector<SymbolicStep> symbolic;
  std::vector<std::shared_ptr<const void>> keep;  // cells and models
};

// Where cells of other owners are seen from.
using AsOf = std::function<Epoch(std::uint64_t owner)>;

// Plans a query. With `motion`, velocities and accelerations of each step are looked for as well.
std::shared_ptr<const Plan> make_plan(const State& state, const Names& names, const AsOf& as_of,
                                      const PoseQuery& query, bool motion,
                                      std::uint64_t structure_version);

// The last entries, predicted to `now`; or the state at a time. Bounded, no allocation, no lock.
void read_latest(const Plan& plan, Stamp now, Policy policy, PoseAnswer& answer);
void read_at(const Plan& plan, Stamp time, Policy policy, PoseAnswer& answer);
void read_latest_common(const Plan& plan, Policy policy, PoseAnswer& answer);
void read_motion(const Plan& plan, Stamp time, bool latest, Policy policy, MotionAnswer& answer);

// The state at a time that some ring no longer covers, with the histories of `past`; not for
// real-time threads. kBusy when `past` is older than what the rings begin with: take a newer one.
void read_at_past(const Plan& plan, const State& past, Stamp time, Policy policy,
                  PoseAnswer& answer);
void read_motion_past(const Plan& plan, const State& past, Stamp time, Policy policy,
                      MotionAnswer& answer);

}  // namespace sinew::world
