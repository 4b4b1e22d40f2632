// Arithmetic as a graph: sharing, folding, and formulas as text.
#include "sinew/data/scalar_graph.h"

#include <gtest/gtest.h>

#include "sinew/base/error.h"
#include "sinew/data/formula.h"

namespace sinew::data {
namespace {

using Op = ScalarOperation;

// The value of a formula's only output.
double value(const std::string& text, double x, double y) {
  const std::vector<FormulaParameter> inputs = {{"x", {}}, {"y", {}}}, outputs = {{"z", {}}};
  const Formula formula = parse_formula("z = " + text, {"f", 1, 1}, inputs, outputs);
  std::vector<double> values;
  for (const ScalarNode& node : formula.graph.nodes()) {
    if (node.operation == Op::kInput) {
      values.push_back(node.a == 0 ? x : y);
    } else if (node.operation == Op::kConstant) {
      values.push_back(node.value);
    } else {
      values.push_back(evaluate(node.operation, values[node.a], values[node.b], values[node.c]));
    }
  }
  return values[formula.outputs[0]];
}

TEST(Formula, FollowsTheRulesOfArithmetic) {
  EXPECT_EQ(value("1 + 2 * x - y / 4", 3, 8), 5);
  EXPECT_EQ(value("-x * (y - 1)", 3, 8), -21);
  EXPECT_EQ(value("x - y - 1", 3, 8), -6);
  EXPECT_EQ(value("2 * -x", 3, 0), -6);
  EXPECT_EQ(value("sqrt(x * x + y * y)", 3, 4), 5);
  EXPECT_EQ(value("hypot(x, y)", 3, 4), 5);
  EXPECT_EQ(value("select(x < y, 1, 2)", 3, 4), 1);
  EXPECT_EQ(value("select(x > y, 1, 2)", 3, 4), 2);
  EXPECT_EQ(value("select(x <= y, 1, 2)", 4, 4), 1);
  EXPECT_EQ(value("select(x >= y, 1, 2)", 3, 4), 2);
  EXPECT_EQ(value("copysign(x, y)", 3, -1), -3);
  EXPECT_EQ(value("max(min(x, y), 1e-3)", -3, 2), 1e-3);
  EXPECT_NEAR(
      value("sin(pi / 6) + cos(0) + tan(0) + asin(1) - acos(0) + atan2(0, 1) + abs(-0.5)", 0, 0), 2,
      1e-15);
}

TEST(ScalarGraph, SharesEqualNodesAndFoldsConstants) {
  ScalarGraph graph;
  const auto x = graph.input(0), y = graph.input(1);
  EXPECT_EQ(graph.apply(Op::kAdd, x, y), graph.apply(Op::kAdd, y, x));
  EXPECT_EQ(graph.apply(Op::kMultiply, x, graph.constant(1)), x);
  EXPECT_EQ(graph.apply(Op::kAdd, x, graph.constant(0)), x);
  EXPECT_TRUE(graph.is_constant(graph.apply(Op::kMultiply, x, graph.constant(0)), 0));
  EXPECT_TRUE(graph.is_constant(graph.apply(Op::kAdd, graph.constant(2), graph.constant(3)), 5));
  EXPECT_EQ(graph.apply(Op::kNegate, graph.apply(Op::kNegate, x)), x);
}

}  // namespace
}  // namespace sinew::data
