#include "sinew/backend/kept_values.h"

#include <gtest/gtest.h>

#include <set>

namespace {

using sinew::backend::keep_values;
using sinew::backend::KeptValues;
using sinew::backend::ValueSteps;

constexpr std::uint32_t kNone = sinew::backend::kNoSlot;

// One step after the other: what it reads, then what it computes.
ValueSteps steps(std::uint32_t values,
                 std::initializer_list<std::pair<std::vector<std::uint32_t>, std::uint32_t>> list) {
  ValueSteps result(values);
  for (const auto& [reads, value] : list) {
    for (const std::uint32_t read : reads) result.read(read);
    result.define(value);
    result.end();
  }
  return result;
}

TEST(KeptValues, NobodyWaitsWhileThereAreRegisters) {
  const KeptValues kept = keep_values(steps(4, {{{}, 0}, {{}, 1}, {{0, 1}, 2}, {{2}, 3}}), 2);
  EXPECT_FALSE(kept.any());
  EXPECT_EQ(kept.slot, std::vector<std::uint32_t>(4, kNone));
}

TEST(KeptValues, WhatIsReadLastMakesRoom) {
  // 0 is read by the last step, 1 and 2 before it.
  const KeptValues kept =
      keep_values(steps(5, {{{}, 0}, {{}, 1}, {{}, 2}, {{1, 2}, 3}, {{0, 3}, 4}}), 2);
  EXPECT_EQ(kept.slot, (std::vector<std::uint32_t>{0, kNone, kNone, kNone, kNone}));
  const auto leaving = kept.leaving(2);
  EXPECT_EQ(std::vector(leaving.begin(), leaving.end()), (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(kept.size, 1u);
}

TEST(KeptValues, AResultThatNobodyReadsNeedsNoRegister) {
  EXPECT_FALSE(keep_values(steps(4, {{{}, 0}, {{}, 1}, {{}, 2}, {{0}, 3}}), 1).any());
}

TEST(KeptValues, ValuesThatDoNotWaitTogetherShareASlot) {
  const KeptValues kept = keep_values(
      steps(7, {{{}, 0}, {{}, 1}, {{1}, 2}, {{0, 2}, 3}, {{3}, 4}, {{}, 5}, {{5, 4}, 6}}), 1);
  ASSERT_NE(kept.slot[0], kNone);
  ASSERT_NE(kept.slot[4], kNone);
  EXPECT_EQ(kept.slot[0], kept.slot[4]);
  EXPECT_EQ(kept.size, 1u);
}

TEST(KeptValues, VectorsLieWhereTheirWidthDividesAndOverlapNobody) {
  ValueSteps list(7);
  for (std::uint32_t value = 0; value < 6; ++value) {
    list.define(value);
    list.set_width(value, value % 2 == 0 ? 1 : 4);
    list.end();
  }
  for (std::uint32_t value = 0; value < 6; ++value) list.read(value);
  list.define(6);
  list.end();
  const KeptValues kept = keep_values(list, 1);
  std::set<std::uint32_t> taken;
  std::uint32_t waiting = 0;
  for (std::uint32_t value = 0; value < 6; ++value) {
    if (kept.slot[value] == kNone) continue;
    ++waiting;
    const std::uint32_t width = value % 2 == 0 ? 1 : 4;
    EXPECT_EQ(kept.slot[value] % width, 0u) << value;
    for (std::uint32_t k = 0; k < width; ++k) {
      EXPECT_TRUE(taken.insert(kept.slot[value] + k).second) << value;
      EXPECT_LT(kept.slot[value] + k, kept.size);
    }
  }
  EXPECT_EQ(waiting, 5u);
}

}  // namespace
