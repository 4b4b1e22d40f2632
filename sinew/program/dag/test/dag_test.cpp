#include "sinew/program/dag/dag.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sinew/program/dag/evaluate.h"
#include "sinew/program/dag/traced.h"

namespace sinew::program {
namespace {

class DagTest : public testing::Test {
 protected:
  Dag dag;
  Ref x = dag.input(0);
  Ref y = dag.input(1);
  Ref z = dag.input(2);
  Ref number(double value) { return dag.constant(value); }
};

TEST_F(DagTest, TheSameOperationIsTheSameNode) {
  EXPECT_EQ(dag.add(x, y), dag.add(y, x));
  EXPECT_EQ(dag.multiply(x, y), dag.multiply(y, x));
  EXPECT_EQ(dag.sin(x), dag.sin(x));
  EXPECT_NE(dag.divide(x, y), dag.divide(y, x));
}

TEST_F(DagTest, SignsCostNoNode) {
  EXPECT_EQ(dag.subtract(y, x), -dag.subtract(x, y));
  EXPECT_EQ(dag.add(-x, -y), -dag.add(x, y));
  EXPECT_EQ(dag.multiply(-x, y), -dag.multiply(x, y));
  EXPECT_EQ(dag.multiply(-x, -y), dag.multiply(x, y));
  EXPECT_EQ(dag.divide(-x, y), -dag.divide(x, y));
  EXPECT_EQ(dag.sin(-x), -dag.sin(x));
  EXPECT_EQ(dag.cos(-x), dag.cos(x));
  EXPECT_EQ(dag.fma(-x, y, z), -dag.fma(x, y, -z));
}

TEST_F(DagTest, OperationsWithZeroAndOneVanish) {
  EXPECT_EQ(dag.add(x, number(0)), x);
  EXPECT_EQ(dag.multiply(x, number(0)), number(0));
  EXPECT_EQ(dag.multiply(x, number(-0.0)), number(0));
  EXPECT_EQ(dag.multiply(x, number(1)), x);
  EXPECT_EQ(dag.multiply(x, number(-1)), -x);
  EXPECT_EQ(dag.subtract(x, x), number(0));
  EXPECT_EQ(dag.divide(number(0), x), number(0));
  EXPECT_EQ(dag.divide(x, number(1)), x);
  EXPECT_EQ(dag.divide(x, x), number(1));
  EXPECT_EQ(dag.fma(x, y, number(0)), dag.multiply(x, y));
  EXPECT_EQ(dag.fma(x, number(1), y), dag.add(x, y));
}

TEST_F(DagTest, ConstantsFold) {
  EXPECT_TRUE(dag.is_constant(dag.add(number(1), number(2)), 3.0));
  EXPECT_TRUE(dag.is_constant(dag.sqrt(number(9)), 3.0));
  EXPECT_TRUE(dag.is_constant(dag.divide(number(1), number(-4)), -0.25));
  EXPECT_TRUE(dag.is_constant(dag.cos(number(0)), 1.0));
  EXPECT_EQ(dag.multiply(number(2), dag.multiply(number(3), x)), dag.multiply(number(6), x));
  EXPECT_EQ(dag.add(number(2), dag.add(number(3), x)), dag.add(number(5), x));
  EXPECT_EQ(dag.subtract(number(2), dag.subtract(x, number(3))), dag.subtract(number(5), x));
  EXPECT_EQ(dag.select(dag.less(number(1), number(2)), x, y), x);
}

TEST_F(DagTest, MultiplesOfTheSameAddUp) {
  EXPECT_EQ(dag.add(x, x), dag.multiply(number(2), x));
  EXPECT_EQ(dag.add(dag.multiply(number(2), x), dag.multiply(number(3), x)),
            dag.multiply(number(5), x));
  EXPECT_EQ(dag.subtract(dag.multiply(number(2), x), x), x);
}

TEST_F(DagTest, RoundingNoiseInSumsOfConstantsIsZero) {
  EXPECT_EQ(dag.add(number(0.1 + 0.2), number(-0.3)), number(0));
  EXPECT_NE(dag.add(number(0.3), number(-0.29999)), number(0));
}

TEST_F(DagTest, ManyNodesKeepTheirIdentity) {
  std::vector<Ref> sums;
  for (std::uint32_t i = 0; i < 10000; ++i) sums.push_back(dag.add(x, dag.input(i + 3)));
  for (std::uint32_t i = 0; i < 10000; ++i) EXPECT_EQ(dag.add(x, dag.input(i + 3)), sums[i]);
}

TEST_F(DagTest, NodesRememberTheClosureThatAskedFirst) {
  dag.set_origin(7);
  const Ref sum = dag.add(x, y);
  dag.set_origin(8);
  EXPECT_EQ(dag.node(dag.add(y, x)).origin, 7U);
  EXPECT_EQ(dag.node(dag.multiply(x, y)).origin, 8U);
  EXPECT_EQ(dag.node(x).origin, kNoOrigin);
  EXPECT_EQ(dag.node(sum).origin, 7U);
}

TEST(OperationCount, CountsWhatResultsNeedAndNothingElse) {
  Computation c;
  c.inputs = 3;
  const Ref x = c.dag.input(0), y = c.dag.input(1), z = c.dag.input(2);
  c.dag.multiply(x, z);  // dead
  c.results = {c.dag.fma(x, y, z), c.dag.multiply(c.dag.sin(x), c.dag.cos(x)), -c.dag.divide(x, y),
               c.dag.sqrt(z), c.dag.select(c.dag.less(x, y), y, z)};
  const OperationCount expected{
      .add = 1, .multiply = 2, .divide = 1, .sqrt = 1, .sincos = 1, .select = 1};
  EXPECT_EQ(count_operations(c), expected);
}

TEST(Traced, RecordsWhatTheSameFormulaComputesWithDoubles) {
  const auto formula = [](auto a, auto b) {
    using std::cos;
    using std::sin;
    using std::sqrt;
    return (a + 2.0 * b) / (1.0 - a * b) - sin(a) * cos(-b) + sqrt(a * a);
  };
  Computation c;
  c.inputs = 2;
  Dag& dag = c.dag;
  c.results = {formula(Traced(dag, dag.input(0)), Traced(dag, dag.input(1))).in(dag)};
  const std::vector<double> in = {0.3, -1.7};
  EXPECT_NEAR(evaluate(c, in)[0], formula(0.3, -1.7), 1e-15);
}

TEST(Traced, ChoosesWithoutBranching) {
  Computation c;
  c.inputs = 2;
  const Traced a(c.dag, c.dag.input(0)), b(c.dag, c.dag.input(1));
  c.results = {select_less(a, b, a, b).in(c.dag)};
  EXPECT_EQ(evaluate(c, std::vector<double>{1, 2})[0], 1);
  EXPECT_EQ(evaluate(c, std::vector<double>{2, 1})[0], 1);
}

}  // namespace
}  // namespace sinew::program
