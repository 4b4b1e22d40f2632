// The histories of measurements that keep every entry.
#include <algorithm>

#include "sinew/world/impl.h"
#include "sinew/world/refuse.h"
#include "sinew/world/world.h"

namespace sinew::world {

History World::history(MeasurementId measurement) const {
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
  History next = *record.history;
  std::size_t& reached = next.done[std::string(user)];
  reached = std::max(reached, std::min(history.first + count, next.entries.size()));
  std::size_t first = next.entries.size();
  for (const std::string& each : users) {
    const auto said = next.done.find(each);
    first = std::min(first, said == next.done.end() ? std::size_t{0} : said->second);
  }
  const EditToken token = fresh_token();
  for (; next.first < first; ++next.first) next.entries.edit(next.first, token) = nullptr;
  State state = impl_->published();
  state.measurements.edit(measurement.index, fresh_token()).history =
      std::make_shared<const History>(std::move(next));
  impl_->publish_quietly(std::move(state));
}

}  // namespace sinew::world
