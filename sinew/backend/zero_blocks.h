// Results that are always zero, as blocks of rows: in a mass matrix of 36 x 36 half of the numbers
// are, and a loop over the rows of a block is shorter than their stores one by one. Internal to
// `backend`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew::backend {

// Neighbours.
struct ZeroRun {
  std::uint32_t first = 0, size = 0;
};

// The runs of a row, again in each of `rows` rows that lie `stride` numbers apart.
struct ZeroBlock {
  std::uint32_t rows = 0, stride = 0;
  std::vector<ZeroRun> runs;
};

template <typename Visit>
void for_each_place(const ZeroBlock& block, Visit visit) {
  for (std::uint32_t row = 0; row < block.rows; ++row) {
    for (const ZeroRun& run : block.runs) {
      for (std::uint32_t k = 0; k < run.size; ++k) visit(run.first + row * block.stride + k);
    }
  }
}

struct Zeros {
  std::vector<ZeroBlock> blocks;
  std::vector<ZeroRun> single;  // what is in no block, in its order
};

// `places`: of the zeros, growing.
Zeros arrange_zeros(std::span<const std::uint32_t> places);

}  // namespace sinew::backend
