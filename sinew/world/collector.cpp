#include "sinew/world/collector.h"

#include "sinew/world/impl.h"
#include "sinew/world/refuse.h"
#include "sinew/world/write_log.h"

namespace sinew::world {

std::size_t collect(WorldImpl& world, WriterState& writer) {
  std::size_t count = 0;
  for (const auto& target : writer.targets) {
    if (!target->log) continue;
    const MeasurementRecord& record = world.state.measurements[target->measurement.index];
    // Removed since, or the handle is of a cell that this world goes on without.
    if (!record.alive || record.cell != target->cell) {
      target->log->give_room(target->log->visit_new([](Stamp, const double*) {}), kMaximumHistory);
      continue;
    }
    History next = *record.history;
    const std::size_t before = next.entries.size();
    const EditToken token = fresh_token();
    const std::uint64_t end = target->log->visit_new([&](Stamp stamp, const double* values) {
      append(next,
             std::make_shared<const HistoryEntry>(
                 HistoryEntry{stamp, {values, values + target->cell->values()}, writer.who}),
             token);
    });
    const std::size_t room = kMaximumHistory - std::min(kMaximumHistory, next.size());
    if (next.entries.size() != before) {
      count += next.entries.size() - before;
      keep(world, target->measurement, std::move(next));
    }
    target->log->give_room(end, room);
  }
  return count;
}

void complete_histories(WorldImpl& clone, const WriterState& writer, Epoch as_of) {
  for (const auto& target : writer.targets) {
    if (!target->log) continue;
    const MeasurementRecord& record = clone.state.measurements[target->measurement.index];
    if (!record.alive || record.cell != target->cell) continue;
    const Cell& cell = *record.cell;
    Cell::View view = cell.view(as_of);
    while (!view.settled) view = cell.view(as_of);
    const EditToken token = fresh_token();
    History next = *record.history;
    std::vector<double> values(cell.values());
    for (std::uint64_t entry = cell.oldest(view); entry < view.count; ++entry) {
      const Stamp stamp = cell.stamp(view, entry);
      cell.read(view, entry, values.data(), cell.values());
      const auto found = next.find(stamp);
      if (found && next.by_time[*found]->stamp == stamp && next.by_time[*found]->values == values) {
        continue;
      }
      append(next, std::make_shared<const HistoryEntry>(HistoryEntry{stamp, values, writer.who}),
             token);
    }
    clone.state.measurements.edit(target->measurement.index, fresh_token()).history =
        std::make_shared<const History>(std::move(next));
  }
}

std::size_t World::collect() {
  const std::lock_guard lock(impl_->editing);
  std::size_t count = 0;
  for (WriterState* const writer : impl_->writers) count += world::collect(*impl_, *writer);
  return count;
}

Collector::Collector(World& world, Duration period) : world_(world) {
  if (period <= Duration::zero()) refuse({}, "a collector that never rests", "a positive period");
  thread_ = std::thread([this, period] {
    std::unique_lock lock(mutex_);
    while (!ending_.wait_for(lock, period, [this] { return end_; })) {
      lock.unlock();
      world_.collect();
      lock.lock();
    }
  });
}

Collector::~Collector() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  ending_.notify_one();
  thread_.join();
  world_.collect();
}

}  // namespace sinew::world
