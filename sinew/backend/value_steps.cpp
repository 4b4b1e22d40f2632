#include "sinew/backend/value_steps.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

namespace sinew::backend {

std::span<const std::uint32_t> ValueSteps::defines(std::uint32_t step) const {
  return std::span(defines_).subspan(begin_of(step).defines,
                                     ends_[step].defines - begin_of(step).defines);
}

std::span<const std::uint32_t> ValueSteps::reads(std::uint32_t step) const {
  return std::span(reads_).subspan(begin_of(step).reads, ends_[step].reads - begin_of(step).reads);
}

Readers::Readers(const ValueSteps& steps) : next_(steps.values()), end_(steps.values()) {
  for (std::uint32_t step = 0; step < steps.size(); ++step) {
    for (const std::uint32_t value : steps.reads(step)) ++end_[value];
  }
  std::uint32_t at = 0;
  for (std::uint32_t value = 0; value < steps.values(); ++value) {
    next_[value] = at;
    at += end_[value];
    end_[value] = next_[value];
  }
  readers_.resize(at);
  for (std::uint32_t step = 0; step < steps.size(); ++step) {
    for (const std::uint32_t value : steps.reads(step)) readers_[end_[value]++] = step;
  }
}

namespace {

struct Slot {
  std::uint32_t width, uses, offset;
};

// The slots that are used most come first. Returns the numbers of all.
std::uint32_t place(std::vector<Slot>& slots) {
  std::vector<std::uint32_t> order(slots.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t of_a = slots[a].uses * slots[b].width;
    const std::uint32_t of_b = slots[b].uses * slots[a].width;
    return of_a != of_b ? of_a > of_b : a < b;
  });
  std::uint32_t size = 0;
  for (const std::uint32_t k : order) {
    Slot& slot = slots[k];
    slot.offset = (size + slot.width - 1) / slot.width * slot.width;
    size = slot.offset + slot.width;
  }
  return size;
}

}  // namespace

std::uint32_t share_slots(const ValueSteps& steps, std::span<const SlotUse> uses,
                          std::span<std::uint32_t> slot) {
  std::vector<Slot> slots;
  std::vector<std::vector<std::uint32_t>> free;  // by width; the lowest is on top of each heap
  // Values that are read last in each step: the first of them, and the one after each.
  std::vector<std::uint32_t> ending(steps.size(), kNoSlot), next(slot.size());
  for (std::uint32_t step = 0; step < steps.size(); ++step) {
    for (const std::uint32_t value : steps.defines(step)) {
      if (slot[value] == kNoSlot) continue;
      const std::uint32_t width = steps.width(value);
      if (free.size() <= width) free.resize(width + 1);
      std::vector<std::uint32_t>& unused = free[width];
      if (unused.empty()) {
        slot[value] = static_cast<std::uint32_t>(slots.size());
        slots.push_back({width, 0, 0});
      } else {
        std::pop_heap(unused.begin(), unused.end(), std::greater());
        slot[value] = unused.back();
        unused.pop_back();
      }
      slots[slot[value]].uses += uses[value].count;
      next[value] = std::exchange(ending[uses[value].last], value);
    }
    for (std::uint32_t value = ending[step]; value != kNoSlot; value = next[value]) {
      std::vector<std::uint32_t>& unused = free[steps.width(value)];
      unused.push_back(slot[value]);
      std::push_heap(unused.begin(), unused.end(), std::greater());
    }
  }
  const std::uint32_t size = place(slots);
  for (std::uint32_t& of_value : slot) {
    if (of_value != kNoSlot) of_value = slots[of_value].offset;
  }
  return size;
}

}  // namespace sinew::backend
