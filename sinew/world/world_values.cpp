// Writing and reading single measurements through the world, for whoever has no handle.
#include "sinew/world/impl.h"
#include "sinew/world/reading.h"
#include "sinew/world/refuse.h"
#include "sinew/world/world.h"

namespace sinew::world {
namespace {

// What may be written, checked before anything is touched. `values` become acceptable.
Status check(const WorldImpl& world, MeasurementId measurement, std::span<double> values,
             std::string_view provenance) {
  const MeasurementRecord record = alive(world, world.state, measurement);
  const std::string& iri = world.family->names.text(record.name);
  if (world.guard) {
    if (const auto reason = world.guard(measurement, *record.model, provenance)) {
      refuse(iri, *reason, "who is declared as its provenance writes it");
    }
  }
  if (values.size() != record.cell->values()) {
    refuse(
        iri,
        std::to_string(values.size()) + " numbers for a " + std::string(to_string(record.quantity)),
        std::to_string(record.cell->values()));
  }
  if (record.cell->owner() == world.token && !record.cell->claimed_by.empty()) {
    refuse(iri, "a real-time writer is at work: " + record.cell->claimed_by,
           "write through its handle");
  }
  return acceptable(record.quantity, values) ? Status::kOk : Status::kNotANumber;
}

bool is_static(const WorldImpl& world, MeasurementId measurement) {
  return std::holds_alternative<Static>(
      world.state.measurements[measurement.index].model->life_cycle);
}

Candidate candidate_of(const WorldImpl& world, const MeasurementRecord& record,
                       MeasurementId measurement) {
  Candidate candidate;
  candidate.cell = record.cell.get();
  candidate.as_of = world.as_of(record.cell->owner());
  candidate.model = record.model.get();
  candidate.measurement = measurement;
  candidate.quantity = record.quantity;
  candidate.period = record.model->period;
  const LifeCycle& life_cycle = record.model->life_cycle;
  candidate.is_static = std::holds_alternative<Static>(life_cycle);
  candidate.prediction = std::get_if<Prediction>(&life_cycle);
  if (const auto* timed = std::get_if<TimeDependent>(&life_cycle)) {
    candidate.validity = timed->validity;
    candidate.expiry = timed->expiry;
  } else if (candidate.prediction) {
    candidate.validity = candidate.prediction->horizon;
  }
  return candidate;
}

template <typename Read>
World::Sample sample(const WorldImpl& world, MeasurementId measurement, Stamp time, Read&& read) {
  const State state = world.published();
  const MeasurementRecord& record = alive(world, state, measurement);
  const Candidate from = candidate_of(world, record, measurement);
  World::Sample result;
  result.values.resize(record.cell->values());
  for (int attempt = 0; attempt < kReadAttempts; ++attempt) {
    const Cell::View view = record.cell->view(from.as_of);
    if (!view.settled) continue;
    Gathered gathered;
    const CellReading reading = read(from, view, result.values.data(), gathered);
    result.status = reading.status;
    result.bounds = bounds_of(from, view);
    result.stamp = view.count == 0 ? Stamp::min() : from.cell->stamp(view, reading.first);
    result.freshness = gathered.at(time);
    if (view.count == 0 || record.cell->intact(view, reading.first, from.as_of)) return result;
  }
  result.status = Status::kBusy;
  return result;
}

}  // namespace

void World::set_write_guard(WriteGuard guard) {
  const std::lock_guard lock(impl_->editing);
  impl_->guard = std::move(guard);
}

Status World::write(MeasurementId measurement, Stamp stamp, const Pose& pose,
                    const WriteContext& who) {
  double values[7];
  store_pose(pose, values);
  return write(measurement, stamp, std::span<const double>(values), who);
}

Status World::write(MeasurementId measurement, Stamp stamp, std::span<const double> values,
                    const WriteContext& who) {
  const std::lock_guard lock(impl_->editing);
  std::vector<double> checked(values.begin(), values.end());
  const Status status = check(*impl_, measurement, checked, who.provenance);
  if (status != Status::kOk) return status;
  Cell& cell = own_cell(*impl_, measurement);
  const Epoch epoch = impl_->epoch.load(std::memory_order_relaxed);
  const Cell::View view = cell.view(kNow);
  const bool constant = is_static(*impl_, measurement);
  if (constant && view.count > 0) return Status::kStatic;
  SpareOnDemand spare(cell, *impl_->family, epoch);
  if (view.count > 0 && stamp <= cell.stamp(view, view.count - 1)) {
    return cell.correct(stamp, checked.data(), epoch, spare.ring) ? Status::kOk : Status::kTooLate;
  }
  cell.append(stamp, checked.data(), epoch, spare.ring);
  // A constant becomes part of the plans.
  if (constant) impl_->publish(impl_->published());
  return Status::kOk;
}

Status World::write_together(Stamp stamp, std::span<const Value> values, const WriteContext& who) {
  const std::lock_guard lock(impl_->editing);
  struct Checked {
    Cell* cell;
    std::vector<double> values;
  };
  std::vector<Checked> checked;
  for (const Value& value : values) {
    checked.push_back({nullptr, {value.values.begin(), value.values.end()}});
    const Status status = check(*impl_, value.measurement, checked.back().values, who.provenance);
    if (status != Status::kOk) return status;
    if (is_static(*impl_, value.measurement)) return Status::kStatic;
    Cell& cell = own_cell(*impl_, value.measurement);
    for (const Checked& other : checked) {
      if (other.cell == &cell) {
        refuse(name(value.measurement), "written twice in one batch", "one value for each");
      }
    }
    checked.back().cell = &cell;
    const Cell::View view = cell.view(kNow);
    if (view.count > 0 && stamp <= cell.stamp(view, view.count - 1)) return Status::kOutOfOrder;
  }
  const Epoch epoch = impl_->epoch.load(std::memory_order_relaxed);
  const std::uint64_t batch = impl_->batch->load(std::memory_order_relaxed);
  impl_->batch->store(batch + 1, std::memory_order_release);
  for (const Checked& one : checked) {
    one.cell->join_batch(impl_->batch);
    SpareOnDemand spare(*one.cell, *impl_->family, epoch);
    one.cell->prepare(stamp, one.values.data(), epoch, spare.ring);
  }
  impl_->batch->store(batch + 2, std::memory_order_release);
  for (const Checked& one : checked) one.cell->finish();
  return Status::kOk;
}

World::Sample World::latest(MeasurementId measurement, Stamp now) const {
  return sample(*impl_, measurement, now,
                [now](const Candidate& from, const Cell::View& view, double* values,
                      Gathered& gathered) { return read_last(from, view, now, values, gathered); });
}

World::Sample World::at(MeasurementId measurement, Stamp time) const {
  return sample(
      *impl_, measurement, time,
      [time](const Candidate& from, const Cell::View& view, double* values, Gathered& gathered) {
        return read_between(from, view, time, values, gathered);
      });
}

}  // namespace sinew::world
