// The histories of measurements that keep every entry.
#include <algorithm>

#include "sinew/world/impl.h"
#include "sinew/world/refuse.h"
#include "sinew/world/world.h"

namespace sinew::world {

std::optional<std::size_t> History::find(Stamp time) const {
  std::size_t low = first_by_time, high = by_time.size();
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (by_time[middle]->stamp <= time) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  if (low == first_by_time) return std::nullopt;
  return low - 1;
}

void append(History& history, HistoryEntryPointer entry, EditToken token) {
  const Stamp stamp = entry->stamp;
  history.entries.push_back(entry, token);
  // What lies among entries that were let go is not covered any more.
  if (stamp <= history.let_go_until) return;
  const std::optional<std::size_t> before = history.find(stamp);
  if (before && history.by_time[*before]->stamp == stamp) {
    history.by_time.edit(*before, token) = std::move(entry);
    return;
  }
  const std::size_t place = before ? *before + 1 : history.first_by_time;
  for (std::size_t at = history.by_time.size(); at > place; --at) {
    history.by_time.edit(at, token) = HistoryEntryPointer(history.by_time[at - 1]);
  }
  history.by_time.edit(place, token) = std::move(entry);
}

void let_go(History& history, std::size_t first) {
  const EditToken token = fresh_token();
  for (; history.first < first; ++history.first) {
    history.let_go_until = std::max(history.let_go_until, history.entries[history.first]->stamp);
    history.entries.edit(history.first, token) = nullptr;
  }
  while (history.covers_something() &&
         history.by_time[history.first_by_time]->stamp <= history.let_go_until) {
    history.by_time.edit(history.first_by_time++, token) = nullptr;
  }
}

void keep(WorldImpl& world, MeasurementId measurement, History history) {
  State state = world.published();
  MeasurementRecord& record = state.measurements.edit(measurement.index, fresh_token());
  record.history = std::make_shared<const History>(std::move(history));
  record.published->publish(record.history);
  world.publish_quietly(std::move(state));
}

History World::history(MeasurementId measurement) const {
  {
    const std::lock_guard lock(impl_->editing);  // what is in a writer's log belongs to it
    for (WriterState* const writer : impl_->writers) world::collect(*impl_, *writer);
  }
  const State state = impl_->published();
  const MeasurementRecord& record = alive(*impl_, state, measurement);
  if (!record.history) {
    refuse(impl_->family->names.text(record.name), "keeps no history", "declare it with keep_all");
  }
  return *record.history;
}

void World::done(MeasurementId measurement, std::string_view user, const History& history,
                 std::size_t count) {
  const std::lock_guard lock(impl_->editing);
  const MeasurementRecord record = alive(*impl_, impl_->state, measurement);
  const std::string& iri = impl_->family->names.text(record.name);
  const std::vector<std::string>& users = record.model->used_by;
  if (!record.history || std::find(users.begin(), users.end(), user) == users.end()) {
    refuse(iri, std::string(user) + " is no declared user of its history",
           "name it in used_by, and declare the measurement with keep_all");
  }
  own_cell(*impl_, measurement);  // a clone's history is the original's until then
  History next = *impl_->state.measurements[measurement.index].history;
  std::size_t& reached = next.done[std::string(user)];
  reached = std::max(reached, std::min(history.first + count, next.entries.size()));
  std::size_t first = next.entries.size();
  for (const std::string& each : users) {
    const auto said = next.done.find(each);
    first = std::min(first, said == next.done.end() ? std::size_t{0} : said->second);
  }
  let_go(next, first);
  keep(*impl_, measurement, std::move(next));
}

}  // namespace sinew::world
