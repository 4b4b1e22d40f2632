#include "sinew/backend/jit/register_plan.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace sinew::backend {

class RegisterPlanner {
 public:
  explicit RegisterPlanner(const RegisterSteps& steps)
      : steps_(steps),
        next_(steps.widths_.size()),
        end_(steps.widths_.size()),
        computed_(steps.widths_.size(), false),
        fetches_(steps.widths_.size()) {
    list_reads();
    for (const std::uint32_t value : steps_.defines_) computed_[value] = true;
    plan_.slot.assign(steps.widths_.size(), RegisterPlan::kNoSlot);
    plan_.leaving.resize(steps.ends_.size());
  }

  RegisterPlan run(std::uint32_t registers, std::uint32_t longest) {
    for (std::uint32_t step = 0; step < steps_.ends_.size(); ++step) {
      take(step);
      release(step, registers, longest);
    }
    place();
    return std::move(plan_);
  }

 private:
  // `visit(value)` for each read, and for each definition, of a step.
  template <typename Visit>
  void for_each(const std::vector<std::uint32_t>& list, std::size_t RegisterSteps::End::*end,
                std::size_t step, Visit visit) const {
    const std::size_t first = step == 0 ? 0 : steps_.ends_[step - 1].*end;
    for (std::size_t k = first; k < steps_.ends_[step].*end; ++k) visit(list[k]);
  }
  template <typename Visit>
  void reads(std::size_t step, Visit visit) const {
    for_each(steps_.reads_, &RegisterSteps::End::reads, step, visit);
  }
  template <typename Visit>
  void defines(std::size_t step, Visit visit) const {
    for_each(steps_.defines_, &RegisterSteps::End::defines, step, visit);
  }

  // The steps that read each value, one value after the other: next_ up to end_.
  void list_reads() {
    for (const std::uint32_t value : steps_.reads_) ++end_[value];
    std::uint32_t at = 0;
    for (std::size_t value = 0; value < end_.size(); ++value) {
      next_[value] = at;
      at += end_[value];
      end_[value] = next_[value];
    }
    readers_.resize(at);
    for (std::uint32_t step = 0; step < steps_.ends_.size(); ++step) {
      reads(step, [&](std::uint32_t value) { readers_[end_[value]++] = step; });
    }
  }

  bool is_read_later(std::uint32_t value) const { return next_[value] < end_[value]; }
  bool is_in_memory(std::uint32_t value) const {
    return !computed_[value] || plan_.slot[value] != RegisterPlan::kNoSlot;
  }

  // What a step reads and computes is in registers.
  void take(std::uint32_t step) {
    reads(step, [&](std::uint32_t value) {
      while (is_read_later(value) && readers_[next_[value]] <= step) ++next_[value];
      if (std::find(held_.begin(), held_.end(), value) != held_.end()) return;
      held_.push_back(value);
      ++fetches_[value].count;
      fetches_[value].last = step;
    });
    defines(step, [&](std::uint32_t value) { held_.push_back(value); });
  }

  void release(std::uint32_t step, std::uint32_t registers, std::uint32_t longest) {
    const auto distance = [&](std::uint32_t value) { return readers_[next_[value]] - step; };
    std::erase_if(held_, [&](std::uint32_t value) {
      const bool stays =
          is_read_later(value) && (!is_in_memory(value) || distance(value) <= longest);
      if (!stays) plan_.leaving[step].push_back(value);
      return !stays;
    });
    while (held_.size() > registers) {
      const auto last = std::max_element(
          held_.begin(), held_.end(),
          [&](std::uint32_t a, std::uint32_t b) { return distance(a) < distance(b); });
      plan_.leaving[step].push_back(*last);
      if (computed_[*last]) plan_.slot[*last] = 0;  // place() says which
      held_.erase(last);
    }
  }

  // Values that are not needed there at the same time share a slot. The slots that are used most
  // lie first, where the shortest addresses reach.
  void place() {
    struct Slot {
      std::uint32_t width, uses, offset;
    };
    std::vector<Slot> slots;
    std::map<std::uint32_t, std::vector<std::uint32_t>> free;  // by width
    std::vector<std::vector<std::uint32_t>> ending(steps_.ends_.size());
    for (std::uint32_t step = 0; step < steps_.ends_.size(); ++step) {
      defines(step, [&](std::uint32_t value) {
        if (plan_.slot[value] == RegisterPlan::kNoSlot) return;
        const std::uint32_t width = steps_.widths_[value];
        std::vector<std::uint32_t>& unused = free[width];
        if (unused.empty()) {
          unused.push_back(static_cast<std::uint32_t>(slots.size()));
          slots.push_back({width, 0, 0});
        }
        const auto lowest = std::min_element(unused.begin(), unused.end());
        plan_.slot[value] = *lowest;
        unused.erase(lowest);
        slots[plan_.slot[value]].uses += 1 + fetches_[value].count;
        ending[fetches_[value].last].push_back(value);
      });
      for (const std::uint32_t value : ending[step]) {
        free[steps_.widths_[value]].push_back(plan_.slot[value]);
      }
    }
    std::vector<std::uint32_t> order(slots.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      const std::uint32_t of_a = slots[a].uses * slots[b].width;
      const std::uint32_t of_b = slots[b].uses * slots[a].width;
      return of_a != of_b ? of_a > of_b : a < b;
    });
    for (const std::uint32_t k : order) {
      Slot& slot = slots[k];
      slot.offset = (plan_.size + slot.width - 1) / slot.width * slot.width;
      plan_.size = slot.offset + slot.width;
    }
    for (std::uint32_t& slot : plan_.slot) {
      if (slot != RegisterPlan::kNoSlot) slot = slots[slot].offset;
    }
  }

  struct Fetches {
    std::uint32_t count = 0, last = 0;  // `last`: its step
  };
  const RegisterSteps& steps_;
  std::vector<std::uint32_t> readers_;     // steps, one value's after the other's
  std::vector<std::uint32_t> next_, end_;  // of each value, in readers_
  std::vector<bool> computed_;             // values
  std::vector<Fetches> fetches_;           // of each value
  std::vector<std::uint32_t> held_;        // values in registers
  RegisterPlan plan_;
};

RegisterPlan plan_registers(const RegisterSteps& steps, std::uint32_t registers,
                            std::uint32_t longest) {
  return RegisterPlanner(steps).run(registers, longest);
}

}  // namespace sinew::backend
