#include "sinew/world/space_index.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::world {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

float rounded_down(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest > value ? std::nextafter(nearest, -kFar) : nearest;
}
float rounded_up(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest < value ? std::nextafter(nearest, kFar) : nearest;
}

// Every third bit of the result is one of the lowest 21 of `value`.
std::uint64_t spread(std::uint64_t value) {
  value &= 0x1fffff;
  value = (value | value << 32) & 0x1f00000000ffff;
  value = (value | value << 16) & 0x1f0000ff0000ff;
  value = (value | value << 8) & 0x100f00f00f00f00f;
  value = (value | value << 4) & 0x10c30c30c30c30c3;
  return (value | value << 2) & 0x1249249249249249;
}

struct Query {
  float minimum[3], maximum[3];
};

// Which of the eight boxes meet the query's, as bits.
template <typename Block>
unsigned meeting(const Block& block, const Query& query) {
  int hit[8] = {1, 1, 1, 1, 1, 1, 1, 1};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < 8; ++i) {  // without a branch, so that all are compared at once
      hit[i] &= static_cast<int>(block.minimum[axis][i] <= query.maximum[axis]);
      hit[i] &= static_cast<int>(block.maximum[axis][i] >= query.minimum[axis]);
    }
  }
  unsigned bits = 0;
  for (int i = 0; i < 8; ++i) bits |= static_cast<unsigned>(hit[i]) << i;
  return bits;
}

}  // namespace

SpaceIndex::Block SpaceIndex::Block::empty() {
  Block block;
  for (auto& row : block.minimum) row.fill(kFar);
  for (auto& row : block.maximum) row.fill(-kFar);
  return block;
}

void SpaceIndex::put(std::vector<Block>& blocks, std::size_t slot, const Bounds3& box) {
  Block& block = blocks[slot / kWidth];
  const std::size_t lane = slot % kWidth;
  block.minimum[0][lane] = rounded_down(box.minimum.x);
  block.minimum[1][lane] = rounded_down(box.minimum.y);
  block.minimum[2][lane] = rounded_down(box.minimum.z);
  block.maximum[0][lane] = rounded_up(box.maximum.x);
  block.maximum[1][lane] = rounded_up(box.maximum.y);
  block.maximum[2][lane] = rounded_up(box.maximum.z);
}

// The boxes around a slot of the tree, from the bottom to the top.
void SpaceIndex::refit(std::size_t slot) {
  for (std::size_t level = 0; level + 1 < levels_.size(); ++level) {
    const Block& block = levels_[level][slot / kWidth];
    slot /= kWidth;
    Block& above = levels_[level + 1][slot / kWidth];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      above.minimum[axis][slot % kWidth] =
          *std::min_element(block.minimum[axis].begin(), block.minimum[axis].end());
      above.maximum[axis][slot % kWidth] =
          *std::max_element(block.maximum[axis].begin(), block.maximum[axis].end());
    }
  }
}

void SpaceIndex::set(Index number, const Bounds3& box) {
  if (slots_.size() <= number) slots_.resize(number + 1, kNone);
  Index& slot = slots_[number];
  if (slot == kNone) {
    slot = kWaiting | static_cast<Index>(waiting_numbers_.size());
    if (waiting_numbers_.size() % kWidth == 0) waiting_.push_back(Block::empty());
    waiting_numbers_.push_back(number);
    ++size_;
  }
  if (slot & kWaiting) {
    put(waiting_, slot & ~kWaiting, box);
  } else {
    put(levels_[0], slot, box);
    refit(slot);
  }
  ++changed_;
}

void SpaceIndex::remove(Index number) {
  if (number >= slots_.size() || slots_[number] == kNone) return;
  const Index slot = slots_[number];
  std::vector<Block>& blocks = slot & kWaiting ? waiting_ : levels_[0];
  const Index lane = slot & ~kWaiting;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    blocks[lane / kWidth].minimum[axis][lane % kWidth] = kFar;
    blocks[lane / kWidth].maximum[axis][lane % kWidth] = -kFar;
  }
  (slot & kWaiting ? waiting_numbers_ : numbers_)[lane] = kNone;
  if (!(slot & kWaiting)) refit(slot);
  slots_[number] = kNone;
  --size_;
  ++changed_;
}

// Half of what is there has changed: by then the changes cost more than what a new tree does. Fewer
// than a few blocks are as well looked through one by one.
void SpaceIndex::settle() {
  if (changed_ > size_ / 2 + 8 * kWidth || waiting_numbers_.size() > size_ / 16 + 8 * kWidth) {
    rebuild();
  }
}

void SpaceIndex::rebuild() {
  struct Placed {
    std::uint64_t code;
    Index number, slot;
  };
  std::vector<Placed> order;
  order.reserve(size_);
  const auto middle = [&](Index slot, std::size_t axis) {
    const Block& block =
        slot & kWaiting ? waiting_[(slot & ~kWaiting) / kWidth] : levels_[0][slot / kWidth];
    const std::size_t lane = (slot & ~kWaiting) % kWidth;
    return 0.5 * (static_cast<double>(block.minimum[axis][lane]) + block.maximum[axis][lane]);
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double lowest[3] = {kInfinity, kInfinity, kInfinity}, extent = 0;
  double highest[3] = {-kInfinity, -kInfinity, -kInfinity};
  for (Index number = 0; number < slots_.size(); ++number) {
    if (slots_[number] == kNone) continue;
    order.push_back({0, number, slots_[number]});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double at = middle(slots_[number], axis);
      lowest[axis] = std::min(lowest[axis], at);
      highest[axis] = std::max(highest[axis], at);
    }
  }
  for (int axis = 0; axis < 3; ++axis) extent = std::max(extent, highest[axis] - lowest[axis]);
  const double scale = extent > 0 && std::isfinite(extent) ? 0x1fffff / extent : 0;
  for (Placed& placed : order) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double along = scale * (middle(placed.slot, axis) - lowest[axis]);
      placed.code |= spread(static_cast<std::uint64_t>(std::clamp(along, 0.0, 2097151.0))) << axis;
    }
  }
  std::sort(order.begin(), order.end(),
            [](const Placed& a, const Placed& b) { return a.code < b.code; });

  std::vector<std::vector<Block>> levels;
  levels.emplace_back((order.size() + kWidth - 1) / kWidth, Block::empty());
  std::vector<Index> numbers(levels[0].size() * kWidth, kNone);
  for (std::size_t to = 0; to < order.size(); ++to) {
    const Index from = order[to].slot;
    const Block& source =
        from & kWaiting ? waiting_[(from & ~kWaiting) / kWidth] : levels_[0][from / kWidth];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      levels[0][to / kWidth].minimum[axis][to % kWidth] =
          source.minimum[axis][(from & ~kWaiting) % kWidth];
      levels[0][to / kWidth].maximum[axis][to % kWidth] =
          source.maximum[axis][(from & ~kWaiting) % kWidth];
    }
    numbers[to] = order[to].number;
    slots_[order[to].number] = static_cast<Index>(to);
  }
  levels_ = std::move(levels);
  numbers_ = std::move(numbers);
  waiting_.clear();
  waiting_numbers_.clear();
  changed_ = 0;
  while (levels_.back().size() > 1) {
    levels_.emplace_back((levels_.back().size() + kWidth - 1) / kWidth, Block::empty());
  }
  for (std::size_t block = 0; block < levels_[0].size(); ++block) refit(block * kWidth);
}

void SpaceIndex::search(const Bounds3& box, std::vector<Index>& found) const {
  const Query query = {
      {rounded_down(box.minimum.x), rounded_down(box.minimum.y), rounded_down(box.minimum.z)},
      {rounded_up(box.maximum.x), rounded_up(box.maximum.y), rounded_up(box.maximum.z)}};
  for (std::size_t block = 0; block < waiting_.size(); ++block) {
    for (unsigned bits = meeting(waiting_[block], query); bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(__builtin_ctz(bits));
      found.push_back(waiting_numbers_[block * kWidth + lane]);
    }
  }
  if (levels_.empty() || levels_[0].empty()) return;
  // Depth first. A level adds seven blocks at most to what is still to be looked at, and ten levels
  // are 2^30 boxes.
  struct Visit {
    std::uint32_t block, level;
  };
  Visit todo[8 * 12];
  std::size_t count = 0;
  todo[count++] = {0, static_cast<std::uint32_t>(levels_.size() - 1)};
  while (count > 0) {
    const auto [block, level] = todo[--count];
    for (unsigned bits = meeting(levels_[level][block], query); bits != 0; bits &= bits - 1) {
      const auto slot = block * static_cast<std::uint32_t>(kWidth) +
                        static_cast<std::uint32_t>(__builtin_ctz(bits));
      if (level == 0) {
        found.push_back(numbers_[slot]);
      } else {
        todo[count++] = {slot, level - 1};
      }
    }
  }
}

}  // namespace sinew::world
