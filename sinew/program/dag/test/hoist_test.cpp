#include "sinew/program/dag/hoist.h"

#include <gtest/gtest.h>

#include <vector>

#include "sinew/program/dag/evaluate.h"

namespace sinew::program {
namespace {

// Results that mix a slow input s and a fast one f: sin(s) f + s s, sqrt(s s), f f, s, 2.
Computation mixed() {
  Computation c;
  c.inputs = 2;
  Dag& dag = c.dag;
  const Ref s = dag.input(0), f = dag.input(1);
  const Ref square = dag.multiply(s, s);
  c.results = {dag.add(dag.multiply(dag.sin(s), f), square), -dag.sqrt(square), dag.multiply(f, f),
               s, dag.constant(2)};
  return c;
}

std::vector<double> in_two_parts(const Hoisted& hoisted, std::vector<double> in) {
  const std::vector<double> held = evaluate(hoisted.update, in);
  in.insert(in.end(), held.begin(), held.end());
  return evaluate(hoisted.evaluate, in);
}

TEST(Hoist, GivesTheSameResultsInTwoParts) {
  const Computation c = mixed();
  for (const std::vector<bool>& slow :
       {std::vector<bool>{true, false}, {false, true}, {true, true}, {false, false}}) {
    const std::vector<double> in{0.7, -1.3};
    EXPECT_EQ(in_two_parts(hoist(c, slow), in), evaluate(c, in));
  }
}

TEST(Hoist, LeavesNothingSlowInTheEvaluation) {
  const Hoisted hoisted = hoist(mixed(), {true, false});
  const OperationCount fast = count_operations(hoisted.evaluate);
  EXPECT_EQ(fast.sincos, 0U);
  EXPECT_EQ(fast.sqrt, 0U);
  EXPECT_EQ(fast.multiply, 2U);  // held sine times f, f f
  EXPECT_EQ(fast.add, 1U);
}

TEST(Hoist, HoldsOnlyWhatTheEvaluationNeeds) {
  // sin(s), s s and its root: not s itself, not the constant.
  EXPECT_EQ(hoist(mixed(), {true, false}).update.results.size(), 3U);
  EXPECT_EQ(hoist(mixed(), {false, false}).update.results.size(), 0U);
}

}  // namespace
}  // namespace sinew::program
