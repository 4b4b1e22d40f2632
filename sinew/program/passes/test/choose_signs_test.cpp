// Which negations vanish, and that no value changes.
#include "sinew/program/passes/choose_signs.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "sinew/program/dag/evaluate.h"

namespace sinew::program {
namespace {

class ChooseSigns : public testing::Test {
 protected:
  ChooseSigns() {
    c.inputs = 5;
    for (std::uint32_t i = 0; i < 5; ++i) x[i] = c.dag.input(i);
  }

  // What is left of how many; the numbers stay, bit by bit.
  void expect(std::uint32_t before, std::uint32_t after) const {
    EXPECT_EQ(count_negations(c), before);
    const Computation chosen = choose_signs(c);
    EXPECT_EQ(count_negations(chosen), after);
    EXPECT_EQ(count_operations(chosen), count_operations(c));
    const std::vector<double> in = {0.3, -1.7, 2.1, 0.9, -0.4};
    EXPECT_EQ(evaluate(chosen, in), evaluate(c, in));
  }

  Computation c;
  Ref x[5];
};

TEST_F(ChooseSigns, AFusedOperationIsComputedWithTheSignOfItsResult) {
  c.results = {-c.dag.fma(x[0], x[1], x[2])};
  expect(1, 0);
}

TEST_F(ChooseSigns, ADifferenceIsTurnedAround) {
  c.results = {-c.dag.subtract(x[0], x[1])};
  expect(1, 0);
}

TEST_F(ChooseSigns, AConstantFactorTakesTheSign) {
  c.results = {-c.dag.multiply(c.dag.constant(0.5), x[0]), c.dag.constant(-3.0)};
  expect(1, 0);
}

TEST_F(ChooseSigns, AConstantTermTakesTheSign) {
  c.results = {-c.dag.add(c.dag.constant(0.5), x[0])};
  expect(1, 0);
}

TEST_F(ChooseSigns, AProductHandsItsSignToAFactorThatIsComputed) {
  c.results = {-c.dag.multiply(c.dag.fma(x[0], x[1], x[2]), x[3])};
  expect(1, 0);
}

TEST_F(ChooseSigns, TheSignGoesOverSeveralOperations) {
  const Ref first = c.dag.fma(x[0], x[1], x[2]);
  c.results = {-c.dag.multiply(x[3], c.dag.multiply(x[4], first)), c.dag.fma(first, first, x[1])};
  expect(1, 0);
}

TEST_F(ChooseSigns, OfAProductOfInputsANegationIsLeft) {
  c.results = {-c.dag.multiply(x[0], x[1])};
  expect(1, 1);
}

TEST_F(ChooseSigns, AValueThatIsWantedWithBothSignsIsNegatedOnce) {
  const Ref sum = c.dag.add(x[0], x[1]);
  c.results = {sum, -sum, -sum};
  expect(1, 1);
}

TEST_F(ChooseSigns, ReadersThatTakeEitherSignDoNotHoldAValueBack) {
  const Ref value = c.dag.fma(x[0], x[1], x[2]);
  c.results = {-value, c.dag.fma(value, x[3], x[4]), c.dag.add(value, x[4])};
  expect(1, 0);
}

// A product of two signs is needed positive, a sum may not be negative in both.
TEST_F(ChooseSigns, TurningPaysOnlyWhereItCostsNoMoreElsewhere) {
  const Ref value = c.dag.fma(x[0], x[1], x[2]);
  c.results = {-value, c.dag.sqrt(value), c.dag.multiply(value, x[3])};
  expect(1, 1);
}

TEST_F(ChooseSigns, WhatASelectionChoosesFromTurnsWithIt) {
  const Ref chosen =
      c.dag.select(c.dag.less(x[0], x[1]), c.dag.fma(x[2], x[3], x[4]), c.dag.constant(0.25));
  c.results = {-chosen};
  expect(1, 0);
}

TEST_F(ChooseSigns, TheOrderOfComputationStays) {
  const Ref a = c.dag.fma(x[0], x[1], x[2]), b = c.dag.multiply(c.dag.constant(2.0), x[3]);
  c.results = {-a, -b};
  for (std::uint32_t i = 0; i < c.dag.size(); ++i) {
    if (i != a.node() && i != b.node()) c.order.push_back(i);
  }
  c.order.push_back(b.node());
  c.order.push_back(a.node());
  const Computation chosen = choose_signs(c);
  ASSERT_GE(chosen.order.size(), 2U);
  EXPECT_EQ(chosen.order[chosen.order.size() - 2], chosen.results[1].node());
  EXPECT_EQ(chosen.order.back(), chosen.results[0].node());
}

// All choices of a small problem, one after the other.
std::uint32_t least_negations(const SignChoice& choice, std::uint32_t values) {
  std::uint32_t least = 0xffffffffU;
  for (std::uint32_t turned = 0; turned < 1U << values; ++turned) {
    SignChoice trial = choice;
    bool allowed = true;
    for (std::uint32_t i = 0; i < values; ++i) {
      if ((turned >> i & 1U) != 0) allowed = allowed && trial.turn_if_free(i);
    }
    if (allowed) least = std::min(least, trial.negations());
  }
  return least;
}

TEST(SignChoice, IsMostlyAsGoodAsTryingAllChoices) {
  std::uint32_t first = 0, found = 0, least = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 generator(seed);
    const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(generator() % n); };
    constexpr std::uint32_t kValues = 11;
    SignChoice choice(kValues);
    for (std::uint32_t i = 3; i < kValues; ++i) {
      const Ref a = Ref::of(below(i), below(2) == 0), b = Ref::of(below(i), below(2) == 0);
      constexpr SignRule kRules[] = {SignRule::kAny, SignRule::kSum, SignRule::kProduct,
                                     SignRule::kEach};
      const SignRule rule = kRules[below(4)];
      if (rule == SignRule::kAny) {
        choice.set(i, rule);
      } else {
        choice.set(i, rule, {a, b});
      }
    }
    for (int k = 0; k < 4; ++k) choice.want(Ref::of(3 + below(kValues - 3), below(2) == 0));
    first += choice.negations();
    least += least_negations(choice, kValues);
    choice.run();
    found += choice.negations();
  }
  EXPECT_GE(found, least);
  EXPECT_LE(found - least, (first - least) / 50) << first << " at first, " << least << " at best";
}

}  // namespace
}  // namespace sinew::program
