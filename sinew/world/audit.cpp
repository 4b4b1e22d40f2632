#include "sinew/world/audit.h"

#include "sinew/world/refuse.h"

namespace sinew::world {

std::string_view to_string(Act act) {
  switch (act) {
    case Act::kMeasure:
      return "write-measurement";
    case Act::kRelate:
      return "change-relation";
    case Act::kModel:
      return "change-model";
    case Act::kRead:
      return "read-measurement";
    case Act::kPerform:
      return "perform-action";
    case Act::kPredict:
      return "predict-action";
    case Act::kReadGraph:
      return "read-graph";
  }
  return "unknown";
}

Audit::Audit(std::size_t capacity, std::function<Stamp()> clock)
    : capacity_(capacity), clock_(std::move(clock)) {
  if (capacity == 0 || capacity > kMaximumAuditEntries) {
    refuse({}, "an audit of " + std::to_string(capacity) + " entries",
           "1 to " + std::to_string(kMaximumAuditEntries));
  }
  ring_.reserve(capacity);
}

void Audit::record(AuditEntry entry) {
  entry.when = clock_();
  const std::lock_guard lock(mutex_);
  entry.number = recorded_;
  ++(entry.accepted ? counts_.accepted : counts_.refused);
  if (ring_.size() < capacity_) {
    ring_.push_back(std::move(entry));
  } else {
    ring_[recorded_ % capacity_] = std::move(entry);
    ++counts_.dropped;
  }
  ++recorded_;
}

std::vector<AuditEntry> Audit::entries() const {
  const std::lock_guard lock(mutex_);
  std::vector<AuditEntry> result;
  result.reserve(ring_.size());
  const std::uint64_t first = recorded_ - ring_.size();
  for (std::uint64_t number = first; number < recorded_; ++number) {
    result.push_back(ring_[number % capacity_]);
  }
  return result;
}

Audit::Counts Audit::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

}  // namespace sinew::world
