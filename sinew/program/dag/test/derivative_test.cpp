#include "sinew/program/dag/derivative.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "sinew/base/error.h"
#include "sinew/program/dag/evaluate.h"
#include "sinew/program/dag/traced.h"

namespace sinew::program {
namespace {

std::vector<std::uint32_t> all(std::size_t n) {
  std::vector<std::uint32_t> indices(n);
  std::iota(indices.begin(), indices.end(), 0U);
  return indices;
}

// A smooth function with every operation: sums, products, quotients, roots, sines, fused products.
Computation smooth_function() {
  Computation c;
  c.inputs = 4;
  Dag& dag = c.dag;
  const Ref x = dag.input(0), y = dag.input(1), z = dag.input(2);
  const Ref radius =
      dag.sqrt(dag.add(dag.multiply(x, x), dag.add(dag.multiply(y, y), dag.constant(1))));
  const Ref wave = dag.multiply(dag.sin(dag.multiply(x, y)), -dag.cos(z));
  c.results.push_back(dag.add(radius, -wave));
  c.results.push_back(dag.divide(wave, radius));
  c.results.push_back(dag.fma(x, -z, dag.divide(dag.constant(1), radius)));
  c.results.push_back(-dag.multiply(z, z));
  return c;
}

// Fourth-order central differences: independent of the rules under test.
double difference(const Computation& c, std::vector<double> in, std::uint32_t row,
                  std::uint32_t column) {
  const double h = 1e-3, at = in[column];
  const auto value = [&](double step) {
    in[column] = at + step;
    return evaluate(c, in)[row];
  };
  return (8 * (value(h) - value(-h)) - (value(2 * h) - value(-2 * h))) / (12 * h);
}

class Derivative : public testing::TestWithParam<DerivativeMode> {};

TEST_P(Derivative, AgreesWithDifferences) {
  const Computation c = smooth_function();
  const auto rows = all(4), columns = all(4);
  const Computation d = differentiate(c, rows, columns, false, GetParam());
  ASSERT_EQ(d.results.size(), 16U);
  std::mt19937 random(3);
  std::uniform_real_distribution<> number(-1.5, 1.5);
  for (int sample = 0; sample < 200; ++sample) {
    std::vector<double> in(4);
    for (double& x : in) x = number(random);
    const std::vector<double> jacobian = evaluate(d, in);
    for (std::uint32_t r = 0; r < 4; ++r) {
      for (std::uint32_t j = 0; j < 4; ++j) {
        EXPECT_NEAR(jacobian[4 * r + j], difference(c, in, r, j), 1e-9) << r << " " << j;
      }
    }
  }
}

TEST_P(Derivative, IsTheConstantZeroWhereNothingDepends) {
  const Computation d = differentiate(smooth_function(), all(4), all(4), false, GetParam());
  for (std::uint32_t r = 0; r < 4; ++r) EXPECT_TRUE(d.dag.is_constant(d.results[4 * r + 3], 0.0));
  EXPECT_TRUE(d.dag.is_constant(d.results[4 * 3 + 0], 0.0));
  EXPECT_TRUE(d.dag.is_constant(d.results[4 * 3 + 1], 0.0));
}

TEST_P(Derivative, TakesTheRowsAndColumnsThatAreAskedFor) {
  const Computation c = smooth_function();
  const std::vector<std::uint32_t> rows{3, 0}, columns{2};
  const Computation d = differentiate(c, rows, columns, true, GetParam());
  ASSERT_EQ(d.results.size(), 6U);
  const std::vector<double> in{0.3, -0.7, 1.1, 0.0};
  const std::vector<double> values = evaluate(c, in), out = evaluate(d, in);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(out[i], values[i]);
  EXPECT_NEAR(out[4], -2 * 1.1, 1e-15);
  EXPECT_NEAR(out[5], difference(c, in, 0, 2), 1e-9);
}

TEST_P(Derivative, OfASelectionIsThatOfTheBranchTaken) {
  Computation c;
  c.inputs = 2;
  const Ref x = c.dag.input(0), y = c.dag.input(1);
  c.results.push_back(c.dag.select(c.dag.less(x, y), c.dag.multiply(x, x), -y));
  const Computation d = differentiate(c, all(1), all(2), false, GetParam());
  EXPECT_EQ(evaluate(d, std::vector<double>{1.0, 2.0}), (std::vector<double>{2.0, 0.0}));
  EXPECT_EQ(evaluate(d, std::vector<double>{3.0, 2.0}), (std::vector<double>{0.0, -1.0}));
}

INSTANTIATE_TEST_SUITE_P(Modes, Derivative,
                         testing::Values(DerivativeMode::kForward, DerivativeMode::kReverse,
                                         DerivativeMode::kCheaper));

TEST(DerivativeCost, OfOneResultByManyInputsIsASmallMultipleOfTheFunction) {
  // Reverse mode: the gradient of a sum of products costs at most a few times the function,
  // whatever the number of inputs.
  Computation c;
  c.inputs = 50;
  Ref product = c.dag.constant(1);
  for (std::uint32_t i = 0; i < c.inputs; ++i) product = c.dag.multiply(product, c.dag.input(i));
  c.results.push_back(product);
  const Computation d = differentiate(c, all(1), all(c.inputs));
  EXPECT_LE(count_operations(d).multiply, 4 * count_operations(c).multiply);
}

TEST(DerivativeFault, NamesTheRowOrColumnThatIsNotThere) {
  const Computation c = smooth_function();
  EXPECT_THROW(differentiate(c, std::vector<std::uint32_t>{4}, all(1)), Error);
  EXPECT_THROW(differentiate(c, all(1), std::vector<std::uint32_t>{4}), Error);
}

}  // namespace
}  // namespace sinew::program
