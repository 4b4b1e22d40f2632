#include "sinew/backend/zero_blocks.h"

#include <algorithm>

namespace sinew::backend {
namespace {

// A loop takes about as many bytes as four stores besides its own, and a store up to four numbers.
constexpr std::uint32_t kLeastStores = 8;
constexpr std::uint32_t kNumbersOfStore = 4;
constexpr std::uint32_t kLeastRows = 3;
// How many runs further the next row is looked for.
constexpr std::size_t kNextRow = 8;

std::vector<ZeroRun> runs_of(std::span<const std::uint32_t> places) {
  std::vector<ZeroRun> runs;
  for (const std::uint32_t place : places) {
    if (!runs.empty() && runs.back().first + runs.back().size == place) {
      ++runs.back().size;
    } else {
      runs.push_back({place, 1});
    }
  }
  return runs;
}

class Arrangement {
 public:
  explicit Arrangement(std::vector<ZeroRun> runs) : runs_(std::move(runs)) {
    taken_.assign(runs_.size(), false);
  }

  Zeros run() {
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (!taken_[i]) begin_block(i);
    }
    Zeros zeros;
    for (ZeroBlock& block : blocks_) {
      if (is_worth_a_loop(block)) {
        zeros.blocks.push_back(std::move(block));
      } else {
        give_back(block, zeros.single);
      }
    }
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (!taken_[i]) zeros.single.push_back(runs_[i]);
    }
    std::sort(zeros.single.begin(), zeros.single.end(),
              [](const ZeroRun& a, const ZeroRun& b) { return a.first < b.first; });
    return zeros;
  }

 private:
  // How often this run repeats, so far apart.
  std::uint32_t rows_of(std::size_t run, std::uint32_t stride) const {
    std::uint32_t rows = 1;
    while (find({runs_[run].first + rows * stride, runs_[run].size}) < runs_.size()) ++rows;
    return rows;
  }

  // A run that is in no block yet.
  std::size_t find(const ZeroRun& run) const {
    const auto at = std::lower_bound(
        runs_.begin(), runs_.end(), run.first,
        [](const ZeroRun& other, std::uint32_t first) { return other.first < first; });
    const auto index = static_cast<std::size_t>(at - runs_.begin());
    const bool is_it = at != runs_.end() && at->first == run.first && at->size == run.size;
    return is_it && !taken_[index] ? index : runs_.size();
  }

  // The longest repetition of this run, and what repeats alike within a row of it.
  void begin_block(std::size_t run) {
    ZeroBlock block{1, 0, {runs_[run]}};
    for (std::size_t next = run + 1; next < std::min(runs_.size(), run + kNextRow); ++next) {
      if (taken_[next] || runs_[next].size != runs_[run].size) continue;
      const std::uint32_t stride = runs_[next].first - runs_[run].first;
      const std::uint32_t rows = rows_of(run, stride);
      if (rows > block.rows) {
        block.rows = rows;
        block.stride = stride;
      }
    }
    if (block.rows < kLeastRows) return;
    for (std::size_t next = run + 1;
         next < runs_.size() && runs_[next].first < runs_[run].first + block.stride; ++next) {
      if (!taken_[next] && rows_of(next, block.stride) == block.rows) {
        block.runs.push_back(runs_[next]);
      }
    }
    for (const ZeroRun& of_row : block.runs) {
      for (std::uint32_t row = 0; row < block.rows; ++row) {
        taken_[find({of_row.first + row * block.stride, of_row.size})] = true;
      }
    }
    blocks_.push_back(std::move(block));
  }

  static bool is_worth_a_loop(const ZeroBlock& block) {
    std::uint32_t stores = 0;
    for (const ZeroRun& run : block.runs) {
      stores += (run.size + kNumbersOfStore - 1) / kNumbersOfStore;
    }
    return stores * (block.rows - 1) >= kLeastStores;
  }

  static void give_back(const ZeroBlock& block, std::vector<ZeroRun>& single) {
    for (const ZeroRun& run : block.runs) {
      for (std::uint32_t row = 0; row < block.rows; ++row) {
        single.push_back({run.first + row * block.stride, run.size});
      }
    }
  }

  std::vector<ZeroRun> runs_;
  std::vector<bool> taken_;
  std::vector<ZeroBlock> blocks_;
};

}  // namespace

Zeros arrange_zeros(std::span<const std::uint32_t> places) {
  return Arrangement(runs_of(places)).run();
}

}  // namespace sinew::backend
