#include "sinew/world/handles.h"

#include <cmath>

#include "sinew/world/impl.h"
#include "sinew/world/reading.h"

namespace sinew::world {
namespace {

void let_go(const std::shared_ptr<WorldImpl>& world, const std::unique_ptr<WriterState>& state) {
  if (!world || !state) return;
  const std::lock_guard lock(world->editing);
  collect(*world, *state);
  std::erase(world->writers, state.get());
  state->each([](WriterState::Target& target) { target.cell->claimed_by.clear(); });
}

// While one lives, `clone` waits for the write; the epoch is one that no clone has seen yet.
class Writing {
 public:
  Writing(WriterState& state, const WorldImpl& world) : state_(state) {
    sequence_ = state_.active.load(std::memory_order_relaxed);
    // Before the epoch is read, for the one that makes a clone: it changes the epoch and then looks
    // at this word.
    state_.active.store(sequence_ + 1, std::memory_order_seq_cst);
    epoch = world.epoch.load(std::memory_order_seq_cst);
  }
  ~Writing() { state_.active.store(sequence_ + 2, std::memory_order_release); }
  Writing(const Writing&) = delete;
  Writing& operator=(const Writing&) = delete;
  Epoch epoch;

 private:
  WriterState& state_;
  std::uint64_t sequence_;
};

// Takes a spare out of its place if the write needed it.
struct Spare {
  explicit Spare(WriterState::Target& target) : place(target.spares) {
    if (!place->load(std::memory_order_acquire)) ++place;
    ring = before = place->load(std::memory_order_acquire);
  }
  ~Spare() {
    if (ring != before) place->store(nullptr, std::memory_order_release);
  }
  std::atomic<Ring*>* place;
  Ring* ring;
  Ring* before;
};

std::optional<Stamp> last_stamp(const Cell& cell) {
  const Cell::View view = cell.view(kNow);
  if (view.count == 0) return std::nullopt;
  return cell.stamp(view, view.count - 1);
}

// Earlier than all that a full ring holds.
bool is_before_ring(const Cell& cell, Stamp stamp) {
  const Cell::View view = cell.view(kNow);
  return view.count >= cell.capacity() - 1 && stamp < cell.stamp(view, cell.oldest(view));
}

bool has_entry_of(const Cell& cell, Stamp stamp) {
  const Cell::View view = cell.view(kNow);
  return view.count > 0 && cell.stamp(view, cell.find(view, stamp)) == stamp;
}

std::uint64_t refused_by(const WriterState& state) {
  std::uint64_t count = 0;
  for (const auto& target : state.targets) count += target->log ? target->log->refused() : 0;
  return count;
}

bool finite(const double* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isfinite(values[i])) return false;
  }
  return true;
}

// Makes quaternions exactly unit, in place.
bool make_acceptable(bool is_pose, double* values, std::size_t count) {
  if (!is_pose) return finite(values, count);
  Pose X = load_pose(values);
  if (!normalise(X)) return false;
  store_pose(X, values);
  return true;
}

// Appends to the blocks of a value, unseen until the batch is committed.
void prepare_blocks(WriterState::Target& target, Stamp stamp, const double* values, Epoch epoch) {
  for (std::size_t i = 0; i < target.blocks_targets.size(); ++i) {
    double numbers[kMaximumValues];
    convert(target.blocks->blocks[i], values, numbers);
    Spare spare(*target.blocks_targets[i]);
    target.blocks_targets[i]->cell->prepare(stamp, numbers, epoch, spare.ring);
  }
}

// The same to a value and its blocks.
void prepare(WriterState::Target& target, Stamp stamp, const double* values, Epoch epoch) {
  prepare_blocks(target, stamp, values, epoch);
  Spare spare(target);
  target.cell->prepare(stamp, values, epoch, spare.ring);
}

// Even: not committed. The heads of the last batch were all set before it returned.
std::uint64_t open_batch(BatchState& state) {
  const std::uint64_t batch = state.load(std::memory_order_relaxed) + 1;
  state.store(batch, std::memory_order_release);
  return batch;
}

void commit_batch(WriterState& state, std::uint64_t batch) {
  state.batch->store(batch + 1, std::memory_order_release);
  // Real-time blocks come first among a measurement's.
  for (const auto& target : state.targets) {
    for (const auto& block : target->blocks_targets) block->cell->finish();
    target->cell->finish();
  }
}

}  // namespace

Writer::Writer(std::shared_ptr<WorldImpl> world, std::unique_ptr<WriterState> state)
    : world_(std::move(world)), state_(std::move(state)) {}
Writer::Writer(Writer&&) noexcept = default;
Writer& Writer::operator=(Writer&& other) noexcept {
  std::swap(world_, other.world_);
  std::swap(state_, other.state_);
  return *this;
}
Writer::~Writer() { let_go(world_, state_); }

Status Writer::write_values(Stamp stamp, const double* values, bool correction) {
  WriterState::Target& target = *state_->targets.front();
  Cell& cell = *target.cell;
  const std::optional<Stamp> last = last_stamp(cell);
  const bool past = last && stamp <= *last;
  if (past && !correction) return Status::kOutOfOrder;
  if (state_->forbidden.load(std::memory_order_acquire)) return Status::kForbidden;
  if (!target.log) return write_to_cell(stamp, values, past);
  if (past && is_before_ring(cell, stamp)) return Status::kTooLate;
  const bool inserts = !past || !has_entry_of(cell, stamp);
  if (!target.log->has_room(cell, stamp, inserts)) return Status::kNoRoom;
  const Status status = write_to_cell(stamp, values, past);
  if (status == Status::kOk) target.log->push(stamp, values, past);
  return status;
}

Status Writer::write_to_cell(Stamp stamp, const double* values, bool past) {
  WriterState::Target& target = *state_->targets.front();
  Cell& cell = *target.cell;
  const Writing writing(*state_, *world_);
  // Blocks hold the last value: one further back does not touch them.
  if (past && target.blocks && stamp == last_stamp(cell)) {
    Spare spare(target);
    cell.begin_replacing(writing.epoch, spare.ring);
    const std::uint64_t batch = open_batch(*state_->batch);
    prepare_blocks(target, stamp, values, writing.epoch);
    state_->batch->store(batch + 1, std::memory_order_release);
    for (const auto& block : target.blocks_targets) block->cell->finish();
    cell.finish_replacing(stamp, values);
    return Status::kOk;
  }
  if (target.blocks && !past) {
    const std::uint64_t batch = open_batch(*state_->batch);
    prepare(target, stamp, values, writing.epoch);
    commit_batch(*state_, batch);
    return Status::kOk;
  }
  Spare spare(target);
  if (past) {
    return cell.correct(stamp, values, writing.epoch, spare.ring) ? Status::kOk : Status::kTooLate;
  }
  cell.append(stamp, values, writing.epoch, spare.ring);
  return Status::kOk;
}

std::uint64_t Writer::refused() const { return refused_by(*state_); }

Status Writer::write(Stamp stamp, const Pose& pose) {
  Pose X = pose;
  if (!state_->targets.front()->is_pose || !normalise(X)) return Status::kNotANumber;
  double values[7];
  store_pose(X, values);
  return write_values(stamp, values, false);
}

Status Writer::correct(Stamp stamp, const Pose& pose) {
  Pose X = pose;
  if (!state_->targets.front()->is_pose || !normalise(X)) return Status::kNotANumber;
  double values[7];
  store_pose(X, values);
  return write_values(stamp, values, true);
}

Status Writer::write(Stamp stamp, std::span<const double> values) {
  const WriterState::Target& target = *state_->targets.front();
  if (values.size() != target.cell->values()) return Status::kNotANumber;
  if (target.is_pose) return write(stamp, load_pose(values.data()));
  if (!finite(values.data(), values.size())) return Status::kNotANumber;
  return write_values(stamp, values.data(), false);
}

Status Writer::correct(Stamp stamp, std::span<const double> values) {
  const WriterState::Target& target = *state_->targets.front();
  if (values.size() != target.cell->values()) return Status::kNotANumber;
  if (target.is_pose) return correct(stamp, load_pose(values.data()));
  if (!finite(values.data(), values.size())) return Status::kNotANumber;
  return write_values(stamp, values.data(), true);
}

Status Writer::write_block(std::size_t block, Stamp stamp, const void* value, std::size_t size) {
  return write_block(block, stamp, value, size, false);
}
Status Writer::correct_block(std::size_t block, Stamp stamp, const void* value, std::size_t size) {
  return write_block(block, stamp, value, size, true);
}

Status Writer::write_block(std::size_t block, Stamp stamp, const void* value, std::size_t size,
                           bool correction) {
  const WriterState::Target& target = *state_->targets.front();
  if (!target.blocks || block >= target.blocks->blocks.size()) return Status::kNotANumber;
  const DataBlock& from = target.blocks->blocks[block];
  if (size != from.bytes) return Status::kNotANumber;
  if (!from.to_canonical) return Status::kReadOnly;
  double canonical[kMaximumValues];
  if (!from.to_canonical->run(value, canonical)) return Status::kNotANumber;
  if (!make_acceptable(target.is_pose, canonical, target.cell->values())) {
    return Status::kNotANumber;
  }
  return write_values(stamp, canonical, correction);
}

BatchWriter::BatchWriter(std::shared_ptr<WorldImpl> world, std::unique_ptr<WriterState> state)
    : world_(std::move(world)), state_(std::move(state)) {
  for (const auto& target : state_->targets) size_ += target->cell->values();
}
BatchWriter::BatchWriter(BatchWriter&&) noexcept = default;
BatchWriter& BatchWriter::operator=(BatchWriter&& other) noexcept {
  std::swap(world_, other.world_);
  std::swap(state_, other.state_);
  std::swap(size_, other.size_);
  return *this;
}
BatchWriter::~BatchWriter() { let_go(world_, state_); }

std::uint64_t BatchWriter::refused() const { return refused_by(*state_); }

Status BatchWriter::write(Stamp stamp, std::span<const double> values) {
  if (values.size() != size_) return Status::kNotANumber;
  const double* from = values.data();
  for (const auto& target : state_->targets) {
    double checked[kMaximumValues];
    const std::size_t count = target->cell->values();
    std::copy(from, from + count, checked);
    if (!make_acceptable(target->is_pose, checked, count)) return Status::kNotANumber;
    const std::optional<Stamp> last = last_stamp(*target->cell);
    if (last && stamp <= *last) return Status::kOutOfOrder;
    from += count;
  }
  if (state_->forbidden.load(std::memory_order_acquire)) return Status::kForbidden;
  for (const auto& target : state_->targets) {
    if (target->log && !target->log->has_room(*target->cell, stamp, true)) return Status::kNoRoom;
  }
  const Writing writing(*state_, *world_);
  const std::uint64_t batch = open_batch(*state_->batch);
  from = values.data();
  for (const auto& target : state_->targets) {
    double checked[kMaximumValues];
    const std::size_t count = target->cell->values();
    std::copy(from, from + count, checked);
    make_acceptable(target->is_pose, checked, count);
    prepare(*target, stamp, checked, writing.epoch);
    if (target->log) target->log->push(stamp, checked, false);
    from += count;
  }
  commit_batch(*state_, batch);
  return Status::kOk;
}

}  // namespace sinew::world
