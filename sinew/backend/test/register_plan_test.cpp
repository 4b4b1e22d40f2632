#include "sinew/backend/jit/register_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace {

using sinew::backend::plan_registers;
using sinew::backend::RegisterPlan;
using sinew::backend::ValueSteps;

constexpr std::uint32_t kNone = sinew::backend::kNoSlot;
constexpr std::uint32_t kFar = 1000;

struct Step {
  std::vector<std::uint32_t> reads;
  std::uint32_t computes;
};

ValueSteps steps(std::uint32_t values, const std::vector<Step>& list,
                 const std::vector<std::uint8_t>& widths = {}) {
  ValueSteps result(values);
  for (std::uint32_t value = 0; value < widths.size(); ++value) {
    result.set_width(value, widths[value]);
  }
  for (const Step& step : list) {
    for (const std::uint32_t read : step.reads) result.read(read);
    result.define(step.computes);
    result.end();
  }
  return result;
}

TEST(RegisterPlan, NothingIsWrittenWhileThereAreRegisters) {
  const RegisterPlan plan =
      plan_registers(steps(4, {{{}, 0}, {{}, 1}, {{0, 1}, 2}, {{2}, 3}}), 2, kFar);
  EXPECT_EQ(plan.size, 0u);
  EXPECT_EQ(plan.slot, std::vector<std::uint32_t>(4, kNone));
}

TEST(RegisterPlan, WhatIsReadLastMakesRoom) {
  // 0 is read by the last step, 1 and 2 before it.
  const RegisterPlan plan =
      plan_registers(steps(5, {{{}, 0}, {{}, 1}, {{}, 2}, {{1, 2}, 3}, {{0, 3}, 4}}), 2, kFar);
  EXPECT_EQ(plan.slot, (std::vector<std::uint32_t>{0, kNone, kNone, kNone, kNone}));
  EXPECT_EQ(plan.leaving[2], (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(plan.size, 1u);
}

TEST(RegisterPlan, WhatLiesInMemoryAnywayIsNotWritten) {
  // Nobody computes 0.
  const RegisterPlan plan =
      plan_registers(steps(5, {{{0}, 1}, {{0}, 2}, {{1, 2}, 3}, {{0, 3}, 4}}), 1, kFar);
  EXPECT_EQ(plan.slot[0], kNone);
}

TEST(RegisterPlan, WhatLiesInMemoryMakesRoomBeforeWhatWouldHaveToBeWritten) {
  // Nobody computes 0. It is read again after two steps, 1 after three.
  const std::vector<Step> list = {{{0}, 1}, {{}, 2}, {{0, 2}, 3}, {{1, 3}, 4}};
  const RegisterPlan plan = plan_registers(steps(5, list), 2, kFar);
  EXPECT_EQ(plan.leaving[1], std::vector<std::uint32_t>{0});
  EXPECT_EQ(plan.size, 0u);
}

TEST(RegisterPlan, WhatLiesInMemoryIsHeldForItsNextReaderAsFarAsSaid) {
  const std::vector<Step> list = {{{0}, 1}, {{1}, 2}, {{2, 0}, 3}};
  EXPECT_EQ(plan_registers(steps(4, list), 9, 2).leaving[0], std::vector<std::uint32_t>{});
  EXPECT_EQ(plan_registers(steps(4, list), 9, 1).leaving[0], std::vector<std::uint32_t>{0});
}

// Runs a plan as the emitter does, and says what goes wrong.
class Machine {
 public:
  Machine(const std::vector<Step>& list, const std::vector<std::uint8_t>& widths,
          std::uint32_t registers)
      : list_(list),
        widths_(widths),
        registers_(registers),
        plan_(plan_registers(steps(static_cast<std::uint32_t>(widths.size()), list, widths),
                             registers, 20)) {
    for (const Step& step : list) computed_.insert(step.computes);
  }

  void run() {
    for (std::size_t at = 0; at < list_.size(); ++at) {
      for (const std::uint32_t value : list_[at].reads) {
        if (!held_.contains(value)) fetch(value, at);
        held_.insert(value);
      }
      compute(list_[at].computes);
      for (const std::uint32_t value : plan_.leaving[at]) held_.erase(value);
      EXPECT_LE(held_.size(), registers_) << "step " << at;
    }
  }
  std::size_t fetched() const { return fetched_; }

 private:
  void fetch(std::uint32_t value, std::size_t at) {
    ++fetched_;
    if (!computed_.contains(value)) return;
    ASSERT_NE(plan_.slot[value], kNone) << value;
    for (std::uint32_t k = 0; k < widths_[value]; ++k) {
      EXPECT_EQ(memory_[plan_.slot[value] + k], value) << "read by step " << at;
    }
  }
  void compute(std::uint32_t value) {
    held_.insert(value);
    const std::uint32_t slot = plan_.slot[value];
    if (slot == kNone) return;
    EXPECT_EQ(slot % widths_[value], 0u);
    EXPECT_LE(slot + widths_[value], plan_.size);
    for (std::uint32_t k = 0; k < widths_[value]; ++k) memory_[slot + k] = value;
  }

  const std::vector<Step>& list_;
  const std::vector<std::uint8_t>& widths_;
  std::uint32_t registers_;
  RegisterPlan plan_;
  std::set<std::uint32_t> computed_, held_;
  std::map<std::uint32_t, std::uint32_t> memory_;
  std::size_t fetched_ = 0;
};

TEST(RegisterPlan, EveryReaderFindsItsValueInRandomPrograms) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    constexpr std::uint32_t kGiven = 20;  // values that nobody computes
    constexpr std::uint32_t kSteps = 300;
    std::vector<std::uint8_t> widths(kGiven + kSteps, 1);
    std::vector<Step> list;
    for (std::uint32_t at = 0; at < kSteps; ++at) {
      const std::uint32_t value = kGiven + at;
      widths[value] = std::uint8_t{1} << random() % 3;
      Step step{{}, value};
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t read = random() % value;
        if (std::find(step.reads.begin(), step.reads.end(), read) == step.reads.end()) {
          step.reads.push_back(read);
        }
      }
      list.push_back(step);
    }
    const std::uint32_t registers = 4 + random() % 30;
    Machine machine(list, widths, registers);
    machine.run();
    EXPECT_GT(machine.fetched(), 0u);
    if (HasFailure()) FAIL() << "round " << round;
  }
}

}  // namespace
