#include "sinew/world/reading.h"

#include <algorithm>

namespace sinew::world {
namespace {

CellReading predict_last(const Candidate& from, const Cell::View& view, Stamp stamp, Stamp time,
                         double* values, Gathered& gathered) {
  const std::uint64_t last = view.count - 1;
  const Cell& cell = *from.cell;
  if (time - stamp > from.prediction->horizon) return {Status::kBeyondHorizon, last};
  const std::uint32_t size = cell.values();
  double entry[kMaximumValues];
  double before[kMaximumValues];
  cell.read(view, last, entry, size);
  double spacing = 0;
  std::uint64_t first = last;
  if (last > cell.oldest(view)) {
    first = last - 1;
    cell.read(view, first, before, size);
    spacing = seconds_of(stamp - cell.stamp(view, first));
  }
  if (!predict(from.prediction->model, from.quantity == Quantity::kPose, size, entry,
               first != last ? before : nullptr, spacing, seconds_of(time - stamp), values)) {
    return {Status::kNoModel, last};
  }
  gathered.predicted = true;
  gathered.add(from, stamp, time);
  return {Status::kOk, first};
}

}  // namespace

void interpolate(Interpolation how, Quantity quantity, std::uint32_t size, const double* from,
                 const double* to, double share, double* values) {
  if (how == Interpolation::kHold) {
    std::copy(from, from + size, values);
  } else if (quantity == Quantity::kPose) {
    const Pose a = load_pose(from);
    const Pose b = load_pose(to);
    store_pose(how == Interpolation::kScrew ? screw(a, b, share) : slerp(a, b, share), values);
  } else {
    for (std::uint32_t i = 0; i < size; ++i) values[i] = from[i] + share * (to[i] - from[i]);
  }
}

CellReading read_last(const Candidate& from, const Cell::View& view, Stamp now, double* values,
                      Gathered& gathered) {
  if (view.count == 0) return {Status::kNoData, 0};
  const std::uint64_t last = view.count - 1;
  const Stamp stamp = from.cell->stamp(view, last);
  if (from.prediction && now > stamp) {
    return predict_last(from, view, stamp, now, values, gathered);
  }
  from.cell->read(view, last, values, from.cell->values());
  gathered.add(from, stamp, now);
  return {Status::kOk, last};
}

CellReading read_between(const Candidate& from, const Cell::View& view, Stamp time, double* values,
                         Gathered& gathered) {
  if (view.count == 0) return {Status::kNoData, 0};
  const Cell& cell = *from.cell;
  const std::uint64_t last = view.count - 1;
  const std::uint32_t size = cell.values();
  if (from.is_static) {
    cell.read(view, last, values, size);
    gathered.add(from, time, time);
    return {Status::kOk, last};
  }
  const std::uint64_t oldest = cell.oldest(view);
  const Stamp newest_stamp = cell.stamp(view, last);
  if (time > newest_stamp) {
    if (!from.prediction) return {Status::kTooNew, last};
    return predict_last(from, view, newest_stamp, time, values, gathered);
  }
  if (time < cell.stamp(view, oldest)) return {Status::kTooOld, oldest};
  const std::uint64_t at = cell.find(view, time);
  const Stamp stamp = cell.stamp(view, at);
  if (stamp == time) {
    cell.read(view, at, values, size);
    gathered.add(from, time, time);
    return {Status::kOk, at};
  }
  double before[kMaximumValues];
  double after[kMaximumValues];
  cell.read(view, at, before, size);
  cell.read(view, at + 1, after, size);
  const Stamp next = cell.stamp(view, at + 1);
  const double share =
      static_cast<double>((time - stamp).count()) / static_cast<double>((next - stamp).count());
  interpolate(from.model->interpolation, from.quantity, size, before, after, share, values);
  gathered.add(from, stamp, time);
  return {Status::kOk, at};
}

Status read_past(const Candidate& from, const History& history, Stamp time, double* values,
                 Gathered& gathered) {
  const std::optional<std::size_t> found = history.find(time);
  if (!found) return Status::kTooOld;
  const HistoryEntry& before = *history.by_time[*found];
  if (before.stamp == time) {
    std::copy(before.values.begin(), before.values.end(), values);
  } else {
    if (*found + 1 == history.by_time.size()) return Status::kBusy;
    const HistoryEntry& after = *history.by_time[*found + 1];
    const double share = static_cast<double>((time - before.stamp).count()) /
                         static_cast<double>((after.stamp - before.stamp).count());
    interpolate(from.model->interpolation, from.quantity, from.cell->values(), before.values.data(),
                after.values.data(), share, values);
  }
  gathered.add(from, before.stamp, time);
  return Status::kOk;
}

Bounds bounds_of(const Candidate& from, const Cell::View& view, const History* history) {
  Bounds bounds;
  bounds.measurement = from.measurement;
  if (view.count > 0) {
    bounds.oldest = from.cell->stamp(view, from.cell->oldest(view));
    bounds.newest = from.cell->stamp(view, view.count - 1);
  }
  if (history && history->covers_something()) {
    bounds.oldest = std::min(bounds.oldest, history->by_time[history->first_by_time]->stamp);
  }
  return bounds;
}

}  // namespace sinew::world
