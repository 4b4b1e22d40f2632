#include "sinew/backend/jit/address_plan.h"

#include <algorithm>

namespace sinew::backend {
namespace {

constexpr std::int32_t kScales[] = {1, 2, 4, 8};
// Bytes that an address within reach is shorter than one of four bytes, and with an index.
constexpr std::int32_t kSavedByBase = 3, kSavedByIndex = 2;
// What a register costs: the instruction that sets it, and saving it for the caller.
constexpr std::int32_t kCost = 24;
// A register is put to so many places at first, no closer than that, then nearer to the best.
constexpr std::int32_t kTried = 256, kClosest = 8;

// Numbers from one on to before another.
struct Window {
  std::int32_t begin, end;
};

// One register after the other, each where it saves most while the others stay; the more there are,
// the more the first ones move again.
class Planner {
 public:
  Planner(std::span<const std::uint32_t> places, std::int32_t near)
      : size_(static_cast<std::int32_t>(*std::max_element(places.begin(), places.end())) + 1),
        near_(near),
        names_(size_, 0) {
    for (const std::uint32_t place : places) ++names_[place];
  }

  AddressPlan run(std::size_t registers) {
    AddressPlan plan{{0}, {}};
    std::int32_t best = improved(plan);
    while (plan.bases.size() + plan.indices.size() < registers) {
      AddressPlan with_base = plan, with_index = plan;
      with_base.bases.push_back(0);
      with_index.indices.push_back(0);
      const std::int32_t by_base = improved(with_base), by_index = improved(with_index);
      if (std::max(by_base, by_index) < best + kCost) break;
      best = std::max(by_base, by_index);
      plan = by_index >= by_base ? with_index : with_base;
    }
    return plan;
  }

 private:
  // Bytes saved; moves registers, the last one first, until none moves.
  std::int32_t improved(AddressPlan& plan) {
    std::int32_t best = 0;
    for (bool moves = true; moves;) {
      moves = false;
      for (std::size_t k = plan.indices.size(); k-- > 0;) moves |= move_index(plan, k, best);
      for (std::size_t k = plan.bases.size(); k-- > 0;) moves |= move_base(plan, k, best);
    }
    return best;
  }

  bool move_base(AddressPlan& plan, std::size_t moved, std::int32_t& best) {
    AddressPlan others = plan;
    others.bases.erase(others.bases.begin() + static_cast<std::ptrdiff_t>(moved));
    look_at(others);
    return move(plan.bases[moved], best, [&](std::int32_t at) {
      const Window direct = around(at);
      windows_.clear();
      for (const std::int32_t index : plan.indices) add_indexed(at, index);
      return sum(with_base_, direct) + saved_by_windows(direct);
    });
  }

  bool move_index(AddressPlan& plan, std::size_t moved, std::int32_t& best) {
    AddressPlan others = plan;
    others.indices.erase(others.indices.begin() + static_cast<std::ptrdiff_t>(moved));
    look_at(others);
    return move(plan.indices[moved], best, [&](std::int32_t at) {
      windows_.clear();
      for (const std::int32_t base : plan.bases) add_indexed(base, at);
      return saved_by_windows({0, 0});
    });
  }

  // `saved`: bytes that the register saves there, beside what the others do.
  template <typename Saved>
  bool move(std::int32_t& place, std::int32_t& best, Saved saved) {
    std::int32_t chosen = place;
    const auto attempt = [&](std::int32_t at) {
      const std::int32_t bytes = saved_by_others_ + saved(at);
      if (bytes <= best) return;
      best = bytes;
      chosen = at;
    };
    std::int32_t step = std::max(kClosest, size_ / kTried);
    for (std::int32_t at = 0; at < size_; at += step) attempt(at);
    for (; step > 0; step /= 2) {
      const std::int32_t middle = chosen;
      for (const std::int32_t at : {middle - step, middle + step}) attempt(at);
    }
    const bool moves = place != chosen;
    place = chosen;
    return moves;
  }

  Window around(std::int32_t at) const {
    return {std::clamp(at - near_, 0, size_), std::clamp(at + near_, 0, size_)};
  }
  void add_indexed(std::int32_t base, std::int32_t index) {
    if (index == 0) return;
    for (const std::int32_t scale : kScales) windows_.push_back(around(base + scale * index));
  }

  // What these registers save, and what one more would, up to each number.
  void look_at(const AddressPlan& plan) {
    saved_.assign(size_, 0);
    windows_.clear();
    for (const std::int32_t base : plan.bases) {
      for (const std::int32_t index : plan.indices) add_indexed(base, index);
    }
    const auto fill = [&](Window window, std::int32_t bytes) {
      std::fill(saved_.begin() + window.begin, saved_.begin() + window.end, bytes);
    };
    for (const Window& window : windows_) fill(window, kSavedByIndex);
    for (const std::int32_t base : plan.bases) fill(around(base), kSavedByBase);
    saved_by_others_ = 0;
    with_base_.assign(size_ + 1, 0);
    with_index_.assign(size_ + 1, 0);
    for (std::int32_t i = 0; i < size_; ++i) {
      saved_by_others_ += names_[i] * saved_[i];
      with_base_[i + 1] = with_base_[i] + names_[i] * (kSavedByBase - saved_[i]);
      with_index_[i + 1] = with_index_[i] + names_[i] * std::max(0, kSavedByIndex - saved_[i]);
    }
  }

  static std::int32_t sum(const std::vector<std::int32_t>& up_to, Window window) {
    return window.begin < window.end ? up_to[window.end] - up_to[window.begin] : 0;
  }

  // What lies in several of windows_ counts once, what lies in `direct` not at all.
  std::int32_t saved_by_windows(Window direct) {
    std::sort(windows_.begin(), windows_.end(),
              [](const Window& a, const Window& b) { return a.begin < b.begin; });
    std::int32_t bytes = 0, done = 0;
    for (const Window& window : windows_) {
      const std::int32_t begin = std::max(window.begin, done);
      if (begin >= window.end) continue;
      done = window.end;
      bytes += sum(with_index_, {begin, window.end});
      bytes -= sum(with_index_, {std::max(begin, direct.begin), std::min(window.end, direct.end)});
    }
    return bytes;
  }

  std::int32_t size_, near_;
  std::vector<std::int32_t> names_;  // instructions that name each number
  std::vector<std::int32_t> saved_;  // bytes, of each number, by the others
  std::int32_t saved_by_others_ = 0;
  std::vector<std::int32_t> with_base_, with_index_;  // bytes more, of the numbers before each
  std::vector<Window> windows_;
};

}  // namespace

AddressPlan plan_addresses(std::span<const std::uint32_t> places, std::int32_t near,
                           std::size_t registers) {
  if (places.empty()) return {{0}, {}};
  return Planner(places, near).run(registers);
}

PlannedAddress address_of(const AddressPlan& plan, std::int32_t near, std::uint32_t place) {
  const auto to = static_cast<std::int32_t>(place);
  const auto is_near = [&](std::int32_t at) { return -near <= to - at && to - at < near; };
  for (std::uint32_t base = 0; base < plan.bases.size(); ++base) {
    if (is_near(plan.bases[base])) return {base, 0, 0, to - plan.bases[base]};
  }
  for (std::uint32_t base = 0; base < plan.bases.size(); ++base) {
    for (std::uint32_t index = 0; index < plan.indices.size(); ++index) {
      for (const std::int32_t scale : kScales) {
        const std::int32_t at = plan.bases[base] + scale * plan.indices[index];
        if (is_near(at)) {
          return {base, index, static_cast<std::uint32_t>(scale), to - at};
        }
      }
    }
  }
  return {0, 0, 0, to - plan.bases.front()};
}

}  // namespace sinew::backend
