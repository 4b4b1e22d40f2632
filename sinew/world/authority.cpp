#include "sinew/world/authority.h"

#include <utility>

#include "sinew/world/refuse.h"

namespace sinew::world {

Authority::Authority(Rights rights, std::shared_ptr<Audit> audit)
    : rights_(std::move(rights)), audit_(std::move(audit)) {}

void Authority::record(Act act, const std::string& who, std::string_view what,
                       MeasurementId measurement, const std::optional<std::string>& reason) const {
  if (!audit_) return;
  audit_->record({.act = act,
                  .accepted = !reason,
                  .who = who,
                  .what = std::string(what),
                  .measurement = measurement,
                  .reason = reason.value_or("")});
}

std::optional<std::string> Authority::judge(const std::string& who,
                                            const WantedReading& wanted) const {
  auto reason = rights_.reason_against_reading(who, wanted.name, wanted.model->used_by,
                                               wanted.model->provenance);
  record(Act::kRead, who, wanted.name, wanted.measurement, reason);
  return reason;
}

std::optional<std::string> Authority::reason_against_reading(const std::string& who,
                                                             const WantedReading& wanted) {
  const std::lock_guard lock(mutex_);
  return judge(who, wanted);
}

std::optional<std::string> Authority::reason_against_graph(const std::string& who,
                                                           std::string_view graph) {
  const std::lock_guard lock(mutex_);
  auto reason = rights_.reason_against_graph(who, graph);
  record(Act::kReadGraph, who, graph, {}, reason);
  return reason;
}

namespace {

[[noreturn]] void refuse_reading(const std::string& who, const WantedReading& wanted,
                                 const std::string& reason) {
  refuse(wanted.name, reason,
         "name it in used_by, or a rule that allows " + who +
             " to read-measurement; a query may avoid the relation, or choose another "
             "provenance");
}

}  // namespace

void Authority::ask_to_read(const std::string& who, const WantedReading& wanted) {
  if (const auto reason = reason_against_reading(who, wanted)) {
    refuse_reading(who, wanted, *reason);
  }
}

void Authority::ask(const std::string& who, Act act, std::string_view what) {
  std::optional<std::string> reason;
  {
    const std::lock_guard lock(mutex_);
    reason = rights_.reason_against(who, act, what);
    record(act, who, what, {}, reason);
  }
  if (reason)
    refuse(what, *reason, "a rule that allows " + who + " to " + std::string(to_string(act)));
}

std::shared_ptr<const Permit> Authority::permit(const std::string& who,
                                                std::vector<WantedReading> wanted) {
  // Judged and noted in one, so that no change of the rights comes between.
  const std::lock_guard lock(mutex_);
  for (const WantedReading& each : wanted) {
    if (const auto reason = judge(who, each)) refuse_reading(who, each, *reason);
  }
  auto permit = std::make_shared<Permit>();
  std::erase_if(permitted_, [](const Permitted& each) { return each.permit.expired(); });
  permitted_.push_back({permit, who, std::move(wanted)});
  return permit;
}

Rights Authority::rights() const {
  const std::lock_guard lock(mutex_);
  return rights_;
}

void Authority::change(Rights rights) {
  const std::lock_guard lock(mutex_);
  rights_ = std::move(rights);
  changes_.fetch_add(1, std::memory_order_release);
  for (const Permitted& each : permitted_) {
    const auto permit = each.permit.lock();
    if (!permit) continue;
    bool holds = true;
    for (const WantedReading& wanted : each.wanted) holds = !judge(each.who, wanted) && holds;
    permit->holds.store(holds, std::memory_order_release);
  }
}

}  // namespace sinew::world
