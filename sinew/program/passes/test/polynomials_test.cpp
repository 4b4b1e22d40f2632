// What reading a graph as sums of products promises: the same values, with uses that are counted.
#include "sinew/program/passes/polynomials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sinew/program/dag/evaluate.h"
#include "sinew/program/passes/test/random_computation.h"

namespace sinew::program {
namespace {

// The results, node by node of the system: independent of evaluate().
std::vector<double> values_of(const Polynomials& system, const std::vector<double>& inputs) {
  const Dag& dag = system.graph.dag;
  std::vector<double> values(dag.size(), std::nan(""));
  const auto value = [&](Ref ref) {
    return ref.negative() ? -values[ref.node()] : values[ref.node()];
  };
  for (const std::uint32_t i : system.nodes) {
    if (system.uses[i] == 0) continue;
    const Node& node = dag.node(i);
    if (system.kinds[i] != SumKind::kNone) {
      values[i] = 0.0;
      for (const Term& term : system.terms_of(i)) {
        double product = term.coefficient;
        for (const std::uint32_t factor : system.factors_of(term)) product *= values[factor];
        values[i] += product;
      }
    } else if (node.op == Op::kConstant) {
      values[i] = node.value;
    } else if (node.op == Op::kInput) {
      values[i] = inputs[node.index];
    } else if (node.op == Op::kDivide) {
      values[i] = value(node.a) / value(node.b);
    } else if (node.op == Op::kSqrt) {
      values[i] = std::sqrt(value(node.a));
    } else if (node.op == Op::kSin) {
      values[i] = std::sin(value(node.a));
    } else if (node.op == Op::kCos) {
      values[i] = std::cos(value(node.a));
    } else if (node.op == Op::kLess) {
      values[i] = value(node.a) < value(node.b) ? 1.0 : 0.0;
    } else if (node.op == Op::kSelect) {
      values[i] = value(node.a) != 0.0 ? value(node.b) : value(node.c);
    }
  }
  std::vector<double> results;
  for (const Ref result : system.graph.results) results.push_back(value(result));
  return results;
}

// What Polynomials::uses says, counted from the results on.
std::vector<std::uint32_t> counted_uses(const Polynomials& system) {
  std::vector<std::uint32_t> uses(system.sums.size(), 0);
  std::vector<std::uint32_t> todo;
  const auto use = [&](std::uint32_t i) {
    if (uses[i]++ == 0) todo.push_back(i);
  };
  for (const Ref result : system.graph.results) use(result.node());
  while (!todo.empty()) {
    const std::uint32_t i = todo.back();
    todo.pop_back();
    if (system.kinds[i] != SumKind::kNone) {
      for (const Term& term : system.terms_of(i)) {
        for (const std::uint32_t factor : system.factors_of(term)) use(factor);
      }
      continue;
    }
    const Node& node = system.graph.dag.node(i);
    const Ref operands[] = {node.a, node.b, node.c};
    for (int k = 0; k < arity(node.op); ++k) use(operands[k].node());
  }
  return uses;
}

class ReadSums : public testing::TestWithParam<unsigned> {};

TEST_P(ReadSums, HaveTheValuesOfTheGraph) {
  const Computation computation = random_computation(GetParam());
  Polynomials system(computation);
  system.read();
  const std::vector<double> inputs = {0.3, -1.2, 0.7, 0.5, 2.0, -0.4};
  const std::vector<double> expected = evaluate(computation, inputs);
  const std::vector<double> actual = values_of(system, inputs);
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_NEAR(actual[k], expected[k], 1e-9 * (1.0 + std::abs(expected[k])));
  }
}

TEST_P(ReadSums, KnowHowOftenEachNodeIsUsed) {
  Polynomials system(random_computation(GetParam()));
  for (int round = 0; round < 3; ++round) {
    system.read();
    EXPECT_EQ(system.uses, counted_uses(system));
    system.write(Association::kPlain);
  }
}

TEST_P(ReadSums, CountTheOperationsOfTheGraph) {
  Polynomials system(random_computation(GetParam()));
  system.write((system.read(), Association::kFused));
  const OperationCount count = count_operations(system.graph);
  EXPECT_EQ(system.operations(), count.add + count.multiply);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ReadSums, testing::Range(0U, 100U));

TEST(Polynomials, CollectTermsInTheOrderInWhichTheyWereAdded) {
  // (x + y) - (x - z): x goes, y and z stay, and nobody uses x any more.
  Computation c;
  c.inputs = 3;
  const Ref x = c.dag.input(0), y = c.dag.input(1), z = c.dag.input(2);
  c.results = {c.dag.subtract(c.dag.add(x, y), c.dag.subtract(x, z))};
  Polynomials system(c);
  system.read();
  const auto terms = system.terms_of(c.results[0].node());
  ASSERT_EQ(terms.size(), 2U);
  EXPECT_EQ(system.uses[x.node()], 0U);
  EXPECT_EQ(system.uses[y.node()], 1U);
  EXPECT_EQ(system.uses[z.node()], 1U);
}

TEST(Polynomials, ASumOfWhichOneTermIsLeftIsPartOfAProduct) {
  // ((x + y) - x) * z is y z.
  Computation c;
  c.inputs = 3;
  const Ref x = c.dag.input(0), y = c.dag.input(1), z = c.dag.input(2);
  const Ref sum = c.dag.subtract(c.dag.add(c.dag.add(x, y), z), c.dag.add(x, z));
  c.results = {c.dag.multiply(sum, z)};
  Polynomials system(c);
  system.read();
  const auto terms = system.terms_of(c.results[0].node());
  ASSERT_EQ(terms.size(), 1U);
  ASSERT_EQ(terms[0].count, 2U);
  EXPECT_EQ(system.factors_of(terms[0])[0], y.node());
  EXPECT_EQ(system.factors_of(terms[0])[1], z.node());
  EXPECT_EQ(system.uses[sum.node()], 0U);
  EXPECT_EQ(system.uses[y.node()], 1U);
}

TEST(Polynomials, WhatNobodyUsesMayBeDeep) {
  // (sin sin ... x + y) - (sin sin ... x - z) is y + z.
  constexpr int kDepth = 200'000;
  Computation c;
  c.inputs = 3;
  const Ref x = c.dag.input(0), y = c.dag.input(1), z = c.dag.input(2);
  Ref deep = x;
  for (int k = 0; k < kDepth; ++k) deep = c.dag.sin(deep);
  c.results = {c.dag.subtract(c.dag.add(deep, y), c.dag.subtract(deep, z))};
  Polynomials system(c);
  system.read();
  EXPECT_EQ(system.uses[x.node()], 0U);
  EXPECT_EQ(system.uses, counted_uses(system));
}

// No recursion: as deep as a graph may be.
TEST(Polynomials, ReadLongChains) {
  constexpr std::uint32_t kFactors = 100'000, kTerms = 2'000;
  Computation c;
  c.inputs = kFactors;
  Ref product = c.dag.input(0), sum = c.dag.input(0);
  for (std::uint32_t i = 1; i < kFactors; ++i) product = c.dag.multiply(product, c.dag.input(i));
  for (std::uint32_t i = 1; i < kTerms; ++i) sum = c.dag.add(sum, c.dag.input(i));
  c.results = {product, sum};
  Polynomials system(c);
  system.read();
  EXPECT_EQ(system.terms_of(product.node())[0].count, kFactors);
  EXPECT_EQ(system.terms_of(sum.node()).size(), kTerms);
  system.write(Association::kPlain);
  EXPECT_EQ(count_operations(system.graph), count_operations(c));
}

}  // namespace
}  // namespace sinew::program
