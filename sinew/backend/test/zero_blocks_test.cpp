#include "sinew/backend/zero_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace sinew::backend {
namespace {

// The zeros of `rows` rows of a matrix, from `first` to `last` in each.
std::vector<std::uint32_t> part(std::uint32_t width, std::uint32_t rows, std::uint32_t first,
                                std::uint32_t last) {
  std::vector<std::uint32_t> places;
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t k = first; k < last; ++k) places.push_back(row * width + k);
  }
  return places;
}

// What is written, in growing order.
std::vector<std::uint32_t> written(const Zeros& zeros) {
  std::vector<std::uint32_t> places;
  for (const ZeroBlock& block : zeros.blocks) {
    for_each_place(block, [&](std::size_t place) { places.push_back(place); });
  }
  for (const ZeroRun& run : zeros.single) {
    for (std::uint32_t k = 0; k < run.size; ++k) places.push_back(run.first + k);
  }
  std::sort(places.begin(), places.end());
  return places;
}

TEST(ZeroBlocks, RowsThatAreAlikeAreABlock) {
  const Zeros zeros = arrange_zeros(part(36, 7, 9, 28));
  ASSERT_EQ(zeros.blocks.size(), 1U);
  EXPECT_EQ(zeros.blocks[0].rows, 7U);
  EXPECT_EQ(zeros.blocks[0].stride, 36U);
  ASSERT_EQ(zeros.blocks[0].runs.size(), 1U);
  EXPECT_EQ(zeros.blocks[0].runs[0].first, 9U);
  EXPECT_EQ(zeros.blocks[0].runs[0].size, 19U);
  EXPECT_TRUE(zeros.single.empty());
}

TEST(ZeroBlocks, SeveralRunsOfARowAreOneBlock) {
  std::vector<std::uint32_t> places = part(36, 7, 0, 8);
  const std::vector<std::uint32_t> more = part(36, 7, 15, 27);
  places.insert(places.end(), more.begin(), more.end());
  std::sort(places.begin(), places.end());
  const Zeros zeros = arrange_zeros(places);
  ASSERT_EQ(zeros.blocks.size(), 1U);
  EXPECT_EQ(zeros.blocks[0].runs.size(), 2U);
}

TEST(ZeroBlocks, AFewZerosAreNotWorthALoop) {
  const Zeros zeros = arrange_zeros(part(6, 3, 1, 3));
  EXPECT_TRUE(zeros.blocks.empty());
  EXPECT_EQ(zeros.single.size(), 3U);
  EXPECT_TRUE(arrange_zeros({}).single.empty());
}

TEST(ZeroBlocks, EveryZeroIsWrittenOnceAndNothingElse) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 generator(seed);
    const std::uint32_t width = 4 + generator() % 30, rows = 1 + generator() % 30;
    std::vector<std::uint32_t> places;
    // Blocks, and here and there a number that is none.
    const std::uint32_t first = generator() % width, last = first + generator() % (width - first);
    for (std::uint32_t k = 0; k < width * rows; ++k) {
      const bool in_block = k % width >= first && k % width <= last;
      if (generator() % 20 != 0 ? in_block : !in_block) places.push_back(k);
    }
    EXPECT_EQ(written(arrange_zeros(places)), places) << seed;
  }
}

}  // namespace
}  // namespace sinew::backend
