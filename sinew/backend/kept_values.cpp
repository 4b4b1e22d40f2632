#include "sinew/backend/kept_values.h"

#include <algorithm>

namespace sinew::backend {

KeptValues keep_values(const ValueSteps& steps, std::uint32_t registers) {
  KeptValues kept;
  kept.slot.assign(steps.values(), kNoSlot);
  kept.left_ends.reserve(steps.size());
  Readers readers(steps);
  std::vector<SlotUse> uses(steps.values(), {1, 0});
  std::vector<std::uint32_t> held;  // values in registers
  for (std::uint32_t step = 0; step < steps.size(); ++step) {
    for (const std::uint32_t value : steps.reads(step)) {
      readers.pass(value, step);
      ++uses[value].count;
      uses[value].last = step;
      if (readers.is_read_later(value)) continue;
      if (const auto found = std::find(held.begin(), held.end(), value); found != held.end())
        held.erase(found);
    }
    for (const std::uint32_t value : steps.defines(step)) {
      if (readers.is_read_later(value)) held.push_back(value);
    }
    while (held.size() > registers) {
      const auto last = std::max_element(
          held.begin(), held.end(),
          [&](std::uint32_t a, std::uint32_t b) { return readers.next(a) < readers.next(b); });
      kept.left.push_back(*last);
      kept.slot[*last] = 0;  // share_slots says which
      held.erase(last);
    }
    kept.left_ends.push_back(static_cast<std::uint32_t>(kept.left.size()));
  }
  kept.size = share_slots(steps, uses, kept.slot);
  return kept;
}

std::vector<std::string> kept_pointers(std::uint32_t size) {
  std::vector<std::string> pointers;
  while (pointers.size() < kKeptPointers && pointers.size() * 2 * kNearNumbers < size) {
    pointers.push_back(pointers.empty() ? "kept" : "kept" + std::to_string(pointers.size() + 1));
  }
  return pointers;
}

std::uint32_t kept_numbers(std::uint32_t size) {
  const auto pointers = static_cast<std::uint32_t>(kept_pointers(size).size());
  return std::max(size, (2 * pointers - 1) * kNearNumbers);
}

KeptPlace kept_place(std::uint32_t slot) {
  const std::uint32_t at = std::min(slot / (2 * kNearNumbers), kKeptPointers - 1);
  return {at == 0 ? "kept" : "kept" + std::to_string(at + 1),
          static_cast<int>(slot) - static_cast<int>((2 * at + 1) * kNearNumbers)};
}

}  // namespace sinew::backend
