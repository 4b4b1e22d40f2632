#include "sinew/backend/kept_values.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace sinew::backend {

class Keeper {
 public:
  explicit Keeper(const KeptSteps& steps)
      : steps_(steps), next_(steps.widths_.size()), end_(steps.widths_.size()) {
    list_reads();
    kept_.slot.assign(steps.widths_.size(), KeptValues::kNoSlot);
    kept_.leaving.resize(steps.ends_.size());
  }

  KeptValues run(std::uint32_t registers) {
    evict(registers);
    place();
    return std::move(kept_);
  }

 private:
  // `visit(value)` for each read, and for each definition, of a step.
  template <typename Visit>
  void for_each(const std::vector<std::uint32_t>& list, std::uint32_t KeptSteps::End::*end,
                std::size_t step, Visit visit) const {
    const std::uint32_t first = step == 0 ? 0 : steps_.ends_[step - 1].*end;
    for (std::uint32_t k = first; k < steps_.ends_[step].*end; ++k) visit(list[k]);
  }
  template <typename Visit>
  void reads(std::size_t step, Visit visit) const {
    for_each(steps_.reads_, &KeptSteps::End::reads, step, visit);
  }
  template <typename Visit>
  void defines(std::size_t step, Visit visit) const {
    for_each(steps_.defines_, &KeptSteps::End::defines, step, visit);
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

  bool read_later(std::uint32_t value) const { return next_[value] < end_[value]; }

  void evict(std::uint32_t registers) {
    std::vector<std::uint32_t> held;  // values in registers
    for (std::uint32_t step = 0; step < steps_.ends_.size(); ++step) {
      reads(step, [&](std::uint32_t value) {
        while (read_later(value) && readers_[next_[value]] <= step) ++next_[value];
      });
      std::erase_if(held, [&](std::uint32_t value) { return !read_later(value); });
      defines(step, [&](std::uint32_t value) {
        if (read_later(value)) held.push_back(value);
      });
      while (held.size() > registers) {
        const auto last =
            std::max_element(held.begin(), held.end(), [&](std::uint32_t a, std::uint32_t b) {
              return readers_[next_[a]] < readers_[next_[b]];
            });
        kept_.leaving[step].push_back(*last);
        kept_.slot[*last] = 0;  // place() says which
        held.erase(last);
      }
    }
  }

  // Values that do not wait at the same time share a slot. The slots that are used most lie first,
  // where the shortest addresses reach.
  void place() {
    struct Slot {
      std::uint32_t width, uses, offset;
    };
    std::vector<Slot> slots;
    std::map<std::uint32_t, std::vector<std::uint32_t>> free;  // by width
    std::vector<std::vector<std::uint32_t>> ending(steps_.ends_.size());
    for (std::uint32_t step = 0; step < steps_.ends_.size(); ++step) {
      defines(step, [&](std::uint32_t value) {
        if (kept_.slot[value] == KeptValues::kNoSlot) return;
        const std::uint32_t width = steps_.widths_[value];
        std::vector<std::uint32_t>& unused = free[width];
        if (unused.empty()) {
          unused.push_back(static_cast<std::uint32_t>(slots.size()));
          slots.push_back({width, 0, 0});
        }
        const auto lowest = std::min_element(unused.begin(), unused.end());
        kept_.slot[value] = *lowest;
        unused.erase(lowest);
        ++slots[kept_.slot[value]].uses;
        ending[readers_[end_[value] - 1]].push_back(value);
      });
      reads(step, [&](std::uint32_t value) {
        if (kept_.slot[value] != KeptValues::kNoSlot) ++slots[kept_.slot[value]].uses;
      });
      for (const std::uint32_t value : ending[step]) {
        const std::uint32_t slot = kept_.slot[value];
        free[slots[slot].width].push_back(slot);
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
      slot.offset = (kept_.size + slot.width - 1) / slot.width * slot.width;
      kept_.size = slot.offset + slot.width;
    }
    for (std::uint32_t& slot : kept_.slot) {
      if (slot != KeptValues::kNoSlot) slot = slots[slot].offset;
    }
  }

  const KeptSteps& steps_;
  std::vector<std::uint32_t> readers_;     // steps, one value's after the other's
  std::vector<std::uint32_t> next_, end_;  // of each value, in readers_
  KeptValues kept_;
};

KeptValues keep_values(const KeptSteps& steps, std::uint32_t registers) {
  return Keeper(steps).run(registers);
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
