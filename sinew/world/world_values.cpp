// Writing and reading single measurements through the world, for whoever has no handle.
#include <algorithm>
#include <cstring>

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
    if (const auto reason = world.guard(measurement, iri, *record.model, provenance)) {
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

// The numbers by read(candidate, view, values, gathered) or, where the ring does not go back so
// far, by the history.
template <typename Read>
World::Sample sample(const WorldImpl& world, MeasurementId measurement, Stamp time, Read&& read) {
  World::Sample result;
  for (int attempt = 0; attempt < kReadAttempts; ++attempt) {
    const State state = world.published();
    const MeasurementRecord& record = alive(world, state, measurement);
    const Candidate from = candidate_of(record, measurement, world.as_of(record.cell->owner()));
    result.values.resize(record.cell->values());
    const Cell::View view = record.cell->view(from.as_of);
    if (!view.settled) continue;
    Gathered gathered;
    const CellReading reading = read(from, view, result.values.data(), gathered);
    result.status = reading.status;
    // Looked up after the ring: what has left that is in it (write_log.h).
    const State past = record.history ? world.published() : state;
    const History* const history = past.measurements[measurement.index].history.get();
    result.bounds = bounds_of(from, view, history);
    result.stamp = view.count == 0 ? Stamp::min() : from.cell->stamp(view, reading.first);
    if (result.status == Status::kTooOld && history) {
      gathered = {};
      result.status = read_past(from, *history, time, result.values.data(), gathered);
      if (result.status == Status::kBusy) continue;
      if (const auto found = history->find(time)) result.stamp = history->by_time[*found]->stamp;
    }
    result.freshness = gathered.at(time);
    if (view.count == 0 || record.cell->intact(view, reading.first, from.as_of)) return result;
  }
  result.status = Status::kBusy;
  return result;
}

// One cell of a write that changes several.
struct Pending {
  Cell* cell;
  std::vector<double> numbers;
};

// A measurement's data blocks, real-time ones first, then the measurement itself.
void add_pending(const MeasurementRecord& record, std::vector<double> values,
                 std::vector<Pending>& pending) {
  for (std::size_t i = 0; record.blocks && i < record.blocks->blocks.size(); ++i) {
    const DataBlock& block = record.blocks->blocks[i];
    std::vector<double> numbers(block.words());
    convert(block, values.data(), numbers.data());
    pending.push_back({(*record.block_cells)[i].get(), std::move(numbers)});
  }
  pending.push_back({record.cell.get(), std::move(values)});
}

// Seen whole or not at all. Precondition: `editing` is held, and the stamp is later than all.
void write_as_one(WorldImpl& world, Stamp stamp, const std::vector<Pending>& pending) {
  const Epoch epoch = world.epoch.load(std::memory_order_relaxed);
  const std::uint64_t batch = world.batch->load(std::memory_order_relaxed);
  world.batch->store(batch + 1, std::memory_order_release);
  for (const Pending& one : pending) {
    one.cell->join_batch(world.batch);
    SpareOnDemand spare(*one.cell, *world.family, epoch);
    one.cell->prepare(stamp, one.numbers.data(), epoch, spare.ring);
  }
  world.batch->store(batch + 2, std::memory_order_release);
  for (const Pending& one : pending) one.cell->finish();
}

// The last value and its blocks, for others of the same stamp. Readers of the measurement wait from
// before the blocks change until after, so nobody sees the old value beside a new block.
void replace_last(WorldImpl& world, const MeasurementRecord& record, Cell& cell, Stamp stamp,
                  const std::vector<double>& values) {
  std::vector<Pending> blocks;
  add_pending(record, values, blocks);
  blocks.pop_back();  // the measurement itself
  const Epoch epoch = world.epoch.load(std::memory_order_relaxed);
  SpareOnDemand spare(cell, *world.family, epoch);
  cell.begin_replacing(epoch, spare.ring);
  write_as_one(world, stamp, blocks);
  cell.finish_replacing(stamp, values.data());
}

void remember(WorldImpl& world, MeasurementId measurement, Stamp stamp,
              const std::vector<double>& values, std::string_view provenance) {
  const std::shared_ptr<const History> before = world.state.measurements[measurement.index].history;
  if (!before) return;
  History next = *before;
  append(next, std::make_shared<const HistoryEntry>(
                   HistoryEntry{stamp, values, std::string(provenance)}));
  keep(world, measurement, std::move(next));
}

bool is_full(const WorldImpl& world, MeasurementId measurement) {
  const auto& history = world.state.measurements[measurement.index].history;
  return history && history->size() >= kMaximumHistory;
}

Status write_values(WorldImpl& world, MeasurementId measurement, Stamp stamp,
                    const std::vector<double>& values) {
  Cell& cell = own_cell(world, measurement);
  const Epoch epoch = world.epoch.load(std::memory_order_relaxed);
  const Cell::View view = cell.view(kNow);
  const bool constant = is_static(world, measurement);
  if (constant && view.count > 0) return Status::kStatic;
  const MeasurementRecord& record = world.state.measurements[measurement.index];
  if (view.count > 0 && stamp <= cell.stamp(view, view.count - 1)) {
    // Blocks hold the last value: one further back does not touch them.
    if (record.blocks && stamp == cell.stamp(view, view.count - 1)) {
      replace_last(world, record, cell, stamp, values);
      return Status::kOk;
    }
    SpareOnDemand spare(cell, *world.family, epoch);
    return cell.correct(stamp, values.data(), epoch, spare.ring) ? Status::kOk : Status::kTooLate;
  }
  if (record.blocks) {
    std::vector<Pending> pending;
    add_pending(record, values, pending);
    write_as_one(world, stamp, pending);
  } else {
    SpareOnDemand spare(cell, *world.family, epoch);
    cell.append(stamp, values.data(), epoch, spare.ring);
  }
  // A constant becomes part of the plans.
  if (constant) world.publish(world.published());
  return Status::kOk;
}

const DataBlock& block_of(const WorldImpl& world, const MeasurementRecord& record,
                          std::size_t block, std::size_t size) {
  const std::string& iri = world.family->names.text(record.name);
  if (!record.blocks || block >= record.blocks->blocks.size()) {
    refuse(iri, "has no data block number " + std::to_string(block), "see World::find_block");
  }
  const DataBlock& found = record.blocks->blocks[block];
  if (found.bytes != size) {
    refuse(found.name, std::to_string(size) + " bytes for a " + found.prototype,
           std::to_string(found.bytes));
  }
  return found;
}

}  // namespace

Status write_checked(WorldImpl& world, MeasurementId measurement, Stamp stamp,
                     const std::vector<double>& values, std::string_view provenance) {
  if (is_full(world, measurement)) return Status::kFull;
  Status status = write_values(world, measurement, stamp, values);
  // Too late for the ring, but not for who keeps everything.
  const std::shared_ptr<const History>& history =
      world.state.measurements[measurement.index].history;
  if (status == Status::kTooLate && history && stamp > history->let_go_until) status = Status::kOk;
  if (status == Status::kOk) remember(world, measurement, stamp, values, provenance);
  return status;
}

void World::set_write_guard(WriteGuard guard) {
  const std::lock_guard lock(impl_->editing);
  impl_->guard = std::move(guard);
  for (WriterState* const writer : impl_->writers) {
    bool forbidden = false;
    for (const auto& target : writer->targets) {
      const MeasurementRecord& record = impl_->state.measurements[target->measurement.index];
      if (!record.alive || !impl_->guard) continue;
      forbidden = impl_
                      ->guard(target->measurement, impl_->family->names.text(record.name),
                              *record.model, writer->who)
                      .has_value() ||
                  forbidden;
    }
    writer->forbidden.store(forbidden, std::memory_order_release);
  }
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
  return status == Status::kOk ? write_checked(*impl_, measurement, stamp, checked, who.provenance)
                               : status;
}

Status World::write_together(Stamp stamp, std::span<const Value> values, const WriteContext& who) {
  const std::lock_guard lock(impl_->editing);
  std::vector<Pending> pending;
  std::vector<MeasurementId> seen;
  for (const Value& value : values) {
    std::vector<double> checked(value.values.begin(), value.values.end());
    const Status status = check(*impl_, value.measurement, checked, who.provenance);
    if (status != Status::kOk) return status;
    if (is_static(*impl_, value.measurement)) return Status::kStatic;
    if (is_full(*impl_, value.measurement)) return Status::kFull;
    if (std::find(seen.begin(), seen.end(), value.measurement) != seen.end()) {
      refuse(name(value.measurement), "written twice in one batch", "one value for each");
    }
    seen.push_back(value.measurement);
    const Cell& cell = own_cell(*impl_, value.measurement);
    const Cell::View view = cell.view(kNow);
    if (view.count > 0 && stamp <= cell.stamp(view, view.count - 1)) return Status::kOutOfOrder;
    add_pending(impl_->state.measurements[value.measurement.index], std::move(checked), pending);
  }
  write_as_one(*impl_, stamp, pending);
  for (const Value& value : values) {
    remember(*impl_, value.measurement, stamp, {value.values.begin(), value.values.end()},
             who.provenance);
  }
  return Status::kOk;
}

std::size_t World::find_block(MeasurementId measurement, std::string_view iri) const {
  const State state = impl_->published();
  const MeasurementRecord& record = alive(*impl_, state, measurement);
  const auto found = record.blocks ? record.blocks->find(iri) : std::nullopt;
  if (!found) {
    refuse(iri, "is no data block of " + impl_->family->names.text(record.name),
           "one that was declared with the measurement");
  }
  return *found;
}

Status World::write_block(MeasurementId measurement, std::size_t block, Stamp stamp,
                          const void* value, std::size_t size, const WriteContext& who) {
  const std::lock_guard lock(impl_->editing);
  const MeasurementRecord record = alive(*impl_, impl_->state, measurement);
  const DataBlock& from = block_of(*impl_, record, block, size);
  if (!from.to_canonical) return Status::kReadOnly;
  std::vector<double> canonical(record.cell->values());
  if (!from.to_canonical->run(value, canonical.data())) return Status::kNotANumber;
  const Status status = check(*impl_, measurement, canonical, who.provenance);
  return status == Status::kOk
             ? write_checked(*impl_, measurement, stamp, canonical, who.provenance)
             : status;
}

Status World::read_blocks(MeasurementId measurement, std::span<const BlockBuffer> buffers,
                          Stamp* stamp) const {
  const State state = impl_->published();
  const MeasurementRecord& record = alive(*impl_, state, measurement);
  if (buffers.size() > kMaximumBlocksOfMeasurement) {
    refuse(impl_->family->names.text(record.name), "more blocks asked than there can be",
           "each once");
  }
  for (const BlockBuffer& buffer : buffers) block_of(*impl_, record, buffer.block, buffer.size);
  const Epoch as_of = impl_->as_of(record.cell->owner());
  for (int attempt = 0; attempt < kReadAttempts; ++attempt) {
    Cell::View views[kMaximumBlocksOfMeasurement];
    bool whole = true;
    for (std::size_t i = 0; i < buffers.size(); ++i) {
      views[i] = (*record.block_cells)[buffers[i].block]->view(as_of);
      whole = whole && views[i].settled;
      if (whole && views[i].count == 0) return Status::kNoData;
    }
    for (std::size_t i = 0; whole && i < buffers.size(); ++i) {
      whole = (*record.block_cells)[buffers[i].block]->unchanged(views[i], as_of);
    }
    for (std::size_t i = 0; whole && i < buffers.size(); ++i) {
      const Cell& cell = *(*record.block_cells)[buffers[i].block];
      double numbers[kMaximumValues];
      cell.read(views[i], views[i].count - 1, numbers, cell.values());
      if (stamp) *stamp = cell.stamp(views[i], views[i].count - 1);
      whole = cell.intact(views[i], views[i].count - 1, as_of);
      std::memcpy(buffers[i].value, numbers, buffers[i].size);
    }
    if (whole) return Status::kOk;
  }
  return Status::kBusy;
}

Status World::read_blocks_at(MeasurementId measurement, Stamp time,
                             std::span<const BlockBuffer> buffers) const {
  const State state = impl_->published();
  const MeasurementRecord& record = alive(*impl_, state, measurement);
  for (const BlockBuffer& buffer : buffers) block_of(*impl_, record, buffer.block, buffer.size);
  const Sample canonical = at(measurement, time);
  if (canonical.status != Status::kOk) return canonical.status;
  for (const BlockBuffer& buffer : buffers) {
    const DataBlock& block = record.blocks->blocks[buffer.block];
    std::vector<double> numbers(block.words());
    convert(block, canonical.values.data(), numbers.data());
    std::memcpy(buffer.value, numbers.data(), buffer.size);
  }
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
