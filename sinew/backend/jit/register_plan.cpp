#include "sinew/backend/jit/register_plan.h"

#include <algorithm>

namespace sinew::backend {

namespace {

// What lies in memory need not be written there to make room: it goes before others that are read
// again later, up to so many times as far away.
constexpr std::uint32_t kInMemory = 4;

class RegisterPlanner {
 public:
  explicit RegisterPlanner(const ValueSteps& steps)
      : steps_(steps), readers_(steps), computed_(steps.values(), false), uses_(steps.values()) {
    for (const std::uint32_t value : steps_.defines()) {
      computed_[value] = true;
      uses_[value].count = 1;
    }
    plan_.slot.assign(steps.values(), kNoSlot);
    plan_.leaving.resize(steps.size());
  }

  RegisterPlan run(std::uint32_t registers, std::uint32_t longest) {
    for (std::uint32_t step = 0; step < steps_.size(); ++step) {
      take(step);
      release(step, registers, longest);
    }
    plan_.size = share_slots(steps_, uses_, plan_.slot);
    return std::move(plan_);
  }

 private:
  bool is_in_memory(std::uint32_t value) const {
    return !computed_[value] || plan_.slot[value] != kNoSlot;
  }

  // What a step reads and computes is in registers.
  void take(std::uint32_t step) {
    for (const std::uint32_t value : steps_.reads(step)) {
      readers_.pass(value, step);
      if (std::find(held_.begin(), held_.end(), value) != held_.end()) continue;
      held_.push_back(value);
      ++uses_[value].count;
      uses_[value].last = step;
    }
    const auto computed = steps_.defines(step);
    held_.insert(held_.end(), computed.begin(), computed.end());
  }

  void release(std::uint32_t step, std::uint32_t registers, std::uint32_t longest) {
    const auto distance = [&](std::uint32_t value) { return readers_.next(value) - step; };
    std::erase_if(held_, [&](std::uint32_t value) {
      const bool stays =
          readers_.is_read_later(value) && (!is_in_memory(value) || distance(value) <= longest);
      if (!stays) plan_.leaving[step].push_back(value);
      return !stays;
    });
    const auto cost = [&](std::uint32_t value) {
      return distance(value) * (is_in_memory(value) ? kInMemory : 1);
    };
    while (held_.size() > registers) {
      const auto last =
          std::max_element(held_.begin(), held_.end(),
                           [&](std::uint32_t a, std::uint32_t b) { return cost(a) < cost(b); });
      plan_.leaving[step].push_back(*last);
      if (computed_[*last]) plan_.slot[*last] = 0;  // share_slots says which
      held_.erase(last);
    }
  }

  const ValueSteps& steps_;
  Readers readers_;
  std::vector<bool> computed_;       // values
  std::vector<SlotUse> uses_;        // in memory: writing it, and the times that it is fetched
  std::vector<std::uint32_t> held_;  // values in registers
  RegisterPlan plan_;
};

}  // namespace

RegisterPlan plan_registers(const ValueSteps& steps, std::uint32_t registers,
                            std::uint32_t longest) {
  return RegisterPlanner(steps).run(registers, longest);
}

}  // namespace sinew::backend
