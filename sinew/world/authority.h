// The rights that are in force, for all that act and read on behalf of components (reader.h,
// participant.h): what is asked is judged by them and recorded, and what was handed out is judged
// again when they change. Any thread, none of them real-time.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/world/audit.h"
#include "sinew/world/rights.h"
#include "sinew/world/world.h"

namespace sinew::world {

// A measurement that somebody wants to read.
struct WantedReading {
  MeasurementId measurement;
  std::string name;  // IRI
  std::shared_ptr<const MeasurementModel> model;
};

class Authority {
 public:
  explicit Authority(Rights rights, std::shared_ptr<Audit> audit = nullptr);

  // Each throws Error with the element, who asked, and what would be right; recorded both ways.
  void ask_to_read(const std::string& who, const WantedReading& wanted);
  void ask(const std::string& who, Act act, std::string_view what);
  // Why not; recorded.
  std::optional<std::string> reason_against_reading(const std::string& who,
                                                    const WantedReading& wanted);
  std::optional<std::string> reason_against_graph(const std::string& who, std::string_view graph);

  // For something that reads these for as long as it lives: asks for each now, and again for each
  // new set of rights.
  std::shared_ptr<const Permit> permit(const std::string& who, std::vector<WantedReading> wanted);

  Rights rights() const;
  const std::shared_ptr<Audit>& audit() const { return audit_; }
  std::uint64_t changes() const { return changes_.load(std::memory_order_acquire); }
  // What was permitted and is not any more answers Status::kForbidden from now on; what was taken
  // back and is allowed again answers as before.
  void change(Rights rights);

 private:
  struct Permitted {
    std::weak_ptr<Permit> permit;
    std::string who;
    std::vector<WantedReading> wanted;
  };
  void record(Act act, const std::string& who, std::string_view what, MeasurementId measurement,
              const std::optional<std::string>& reason) const;
  std::optional<std::string> judge(const std::string& who, const WantedReading& wanted) const;

  mutable std::mutex mutex_;
  Rights rights_;
  const std::shared_ptr<Audit> audit_;
  std::vector<Permitted> permitted_;
  std::atomic<std::uint64_t> changes_ = 0;  // of the rights
};

}  // namespace sinew::world
