// What every pass promises: the same results to round-off, and no more operations than before.
#include "sinew/program/passes/passes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/program/dag/evaluate.h"
#include "sinew/program/passes/choose_signs.h"
#include "sinew/program/passes/factor_sums.h"
#include "sinew/program/passes/fuse_multiply_add.h"
#include "sinew/program/passes/latency.h"
#include "sinew/program/passes/merge_terms.h"
#include "sinew/program/passes/reassociate.h"
#include "sinew/program/passes/schedule.h"
#include "sinew/program/passes/share_denominators.h"
#include "sinew/program/passes/share_sums.h"
#include "sinew/program/passes/test/random_computation.h"

namespace sinew::program {
namespace {

struct PassCase {
  const char* name;
  Computation (*run)(Computation);
};

void PrintTo(const PassCase& c, std::ostream* os) { *os << c.name; }

std::uint32_t total(const OperationCount& n) {
  return n.add + n.multiply + n.divide * 4 + n.sqrt * 4;
}

void expect_same_results(const Computation& a, const Computation& b, unsigned seed) {
  ASSERT_EQ(a.inputs, b.inputs);
  ASSERT_EQ(a.results.size(), b.results.size());
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int k = 0; k < 5; ++k) {
    std::vector<double> in(a.inputs);
    for (double& value : in) value = uniform(generator);
    const std::vector<double> x = evaluate(a, in);
    const std::vector<double> y = evaluate(b, in);
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_NEAR(x[i], y[i], 1e-9 * (1.0 + std::abs(x[i]))) << "result " << i << ", seed " << seed;
    }
  }
}

// Sums and products of small whole numbers, which doubles compute without round-off.
Computation random_whole_computation(unsigned seed) {
  std::mt19937 generator(seed);
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(generator() % n); };
  Computation c;
  c.inputs = 5;
  std::vector<Ref> level;
  for (std::uint32_t i = 0; i < c.inputs; ++i) level.push_back(c.dag.input(i));
  for (const double constant : {1.0, 2.0, -3.0}) level.push_back(c.dag.constant(constant));
  // Each level of products doubles the digits: four of them stay below 2^53.
  for (int depth = 0; depth < 3; ++depth) {
    std::vector<Ref> products, sums = level;
    for (int k = 0; k < 12; ++k) {
      const Ref a = level[below(level.size())], b = level[below(level.size())];
      products.push_back(c.dag.multiply(a, b).negated_if(below(3) == 0));
    }
    for (int k = 0; k < 10; ++k) {
      Ref sum = products[below(products.size())];
      for (std::uint32_t n = below(5); n > 0; --n) {
        const Ref term =
            below(4) == 0 ? sums[below(sums.size())] : products[below(products.size())];
        sum = c.dag.add(sum, term.negated_if(below(2) == 0));
      }
      sums.push_back(sum);
    }
    level.assign(sums.end() - 10, sums.end());
  }
  c.results = level;
  return c;
}

// A pass that works on a graph seen as polynomials.
template <void (*kPass)(Polynomials&)>
Computation by(Computation computation) {
  Polynomials system(std::move(computation));
  kPass(system);
  return std::move(system.graph);
}

class EveryPass : public testing::TestWithParam<PassCase> {};

TEST_P(EveryPass, KeepsTheResultsOfRandomGraphs) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const Computation before = random_computation(seed);
    expect_same_results(before, GetParam().run(before), seed);
  }
}

TEST_P(EveryPass, IsExactWhereArithmeticIs) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    const Computation before = random_whole_computation(seed);
    const Computation after = GetParam().run(before);
    std::mt19937 generator(seed);
    std::vector<double> in(before.inputs);
    for (double& value : in) value = static_cast<double>(generator() % 7) - 3.0;
    const std::vector<double> x = evaluate(before, in);
    const std::vector<double> y = evaluate(after, in);
    for (std::size_t i = 0; i < x.size(); ++i) {
      ASSERT_LT(std::abs(x[i]), 9e15);
      EXPECT_EQ(x[i], y[i]) << "result " << i << ", seed " << seed;
    }
  }
}

TEST_P(EveryPass, NeedsNoMoreOperations) {
  std::uint32_t before_all = 0;
  std::uint32_t after_all = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    const Computation before = random_computation(seed);
    const std::uint32_t n = total(count_operations(before));
    const std::uint32_t m = total(count_operations(GetParam().run(before)));
    before_all += n;
    after_all += m;
    EXPECT_LE(m, n) << "seed " << seed;
  }
  EXPECT_LE(after_all, before_all);
}

TEST_P(EveryPass, GivesTheSameGraphEachTime) {
  const Computation before = random_computation(3);
  const Computation a = GetParam().run(before);
  const Computation b = GetParam().run(before);
  ASSERT_EQ(a.dag.size(), b.dag.size());
  EXPECT_EQ(a.order, b.order);
  EXPECT_TRUE(std::equal(a.results.begin(), a.results.end(), b.results.begin()));
}

TEST_P(EveryPass, AcceptsAnEmptyComputation) {
  EXPECT_TRUE(GetParam().run(Computation{}).results.empty());
}

Computation optimise_all(Computation c) { return optimise(std::move(c)); }

INSTANTIATE_TEST_SUITE_P(Passes, EveryPass,
                         testing::Values(PassCase{"share_denominators", share_denominators},
                                         PassCase{"merge_terms", by<merge_terms>},
                                         PassCase{"factor_sums", by<factor_sums>},
                                         PassCase{"share_sums", by<share_sums>},
                                         PassCase{"reassociate", by<reassociate>},
                                         PassCase{"fuse_multiply_add", by<fuse_multiply_add>},
                                         PassCase{"choose_signs", choose_signs},
                                         PassCase{"schedule", schedule},
                                         PassCase{"optimise", optimise_all}),
                         [](const auto& info) { return std::string(info.param.name); });

class PassTest : public testing::Test {
 protected:
  PassTest() {
    c.inputs = 5;
    for (std::uint32_t i = 0; i < 5; ++i) x[i] = c.dag.input(i);
  }
  Ref sum(std::initializer_list<Ref> terms) {
    Ref result = c.dag.constant(0.0);
    for (const Ref term : terms) result = c.dag.add(result, term);
    return result;
  }
  Computation c;
  Ref x[5];
};

TEST_F(PassTest, CommonFactorsAreTakenOut) {
  // x0 x1 + x2 + x0 x3 + x0 x4
  c.results = {sum(
      {c.dag.multiply(x[0], x[1]), x[2], c.dag.multiply(x[0], x[3]), c.dag.multiply(x[0], x[4])})};
  EXPECT_EQ(count_operations(by<factor_sums>(c)), (OperationCount{.add = 3, .multiply = 1}));
}

TEST_F(PassTest, EqualCoefficientsAreTakenOutWhateverTheirSigns) {
  const Ref half = c.dag.constant(0.5);
  c.results = {c.dag.subtract(c.dag.multiply(half, x[0]), c.dag.multiply(half, x[1]))};
  EXPECT_EQ(count_operations(by<factor_sums>(c)), (OperationCount{.add = 1, .multiply = 1}));
}

TEST_F(PassTest, ProductsThatOthersUseStay) {
  const Ref p = c.dag.multiply(x[0], x[1]), q = c.dag.multiply(x[0], x[2]);
  c.results = {c.dag.add(p, q), p, q};
  EXPECT_EQ(count_operations(by<factor_sums>(c)), count_operations(c));
}

TEST_F(PassTest, SumsThatShareTermsAreAddedOnce) {
  c.results = {sum({x[0], x[1], x[2]}), sum({x[0], x[3], -x[2]}), sum({x[2], x[4], -x[0]})};
  // x0 - x2 is in two of them.
  EXPECT_EQ(count_operations(by<share_sums>(c)).add, 5U);
}

TEST_F(PassTest, BracketsOpenWhereTermsMeet) {
  const Ref two = c.dag.constant(2.0), three = c.dag.constant(3.0);
  c.results = {c.dag.add(c.dag.multiply(two, c.dag.add(x[0], x[1])),
                         c.dag.multiply(three, c.dag.subtract(x[0], x[1])))};
  // 5 x0 - x1
  EXPECT_EQ(count_operations(by<merge_terms>(c)), (OperationCount{.add = 1, .multiply = 1}));
}

TEST_F(PassTest, SeveralQuotientsNeedOneDivision) {
  c.results = {c.dag.divide(x[0], x[4]), c.dag.divide(x[1], x[4]), c.dag.divide(x[2], x[3])};
  EXPECT_EQ(count_operations(share_denominators(c)), (OperationCount{.multiply = 2, .divide = 2}));
}

TEST_F(PassTest, ALongSumBecomesAShallowTree) {
  const Ref s = c.dag.sin(x[0]);
  // The late term first, so that written in order everything waits for it.
  c.results = {sum({s, x[1], x[2], x[3], x[4]})};
  const auto depth = [](const Computation& computation) {
    return ReadyTimes(computation.dag).of(computation.results[0]);
  };
  EXPECT_EQ(depth(c), latency(Op::kSin) + 4 * latency(Op::kAdd));
  EXPECT_EQ(depth(by<reassociate>(c)), latency(Op::kSin) + latency(Op::kAdd));
}

TEST_F(PassTest, ProductsAndSumsFuse) {
  c.results = {c.dag.add(c.dag.multiply(x[0], x[1]), c.dag.multiply(x[2], x[3]))};
  const Computation fused = by<fuse_multiply_add>(c);
  const Node& root = fused.dag.node(fused.results[0]);
  EXPECT_EQ(root.op, Op::kFma);
  EXPECT_EQ(fused.dag.node(root.c).op, Op::kMultiply);
  EXPECT_EQ(count_operations(fused), count_operations(c));
}

TEST_F(PassTest, TheScheduleComputesOperandsFirstAndEachLiveNodeOnce) {
  const Computation scheduled = optimise(random_computation(11));
  std::vector<std::uint8_t> done(scheduled.dag.size(), 0);
  for (const std::uint32_t i : scheduled.order) {
    EXPECT_FALSE(done[i]);
    const Node& node = scheduled.dag.node(i);
    const Ref operands[] = {node.a, node.b, node.c};
    for (int k = 0; k < arity(node.op); ++k) EXPECT_TRUE(done[operands[k].node()]);
    done[i] = 1;
  }
  EXPECT_EQ(done, live_nodes(scheduled));
}

TEST_F(PassTest, TheScheduleKeepsFewValuesLive) {
  // Many pairs of sums that are needed only at the very end of each: computed breadth first they
  // would all be live at once.
  for (std::uint32_t i = 0; i < 200; ++i) {
    c.dag.set_origin(i);
    const Ref a = c.dag.multiply(x[0], c.dag.constant(1.0 + i)), b = c.dag.add(a, x[1]);
    c.results.push_back(c.dag.multiply(b, a));
  }
  Ref all = c.dag.constant(0.0);
  for (const Ref result : c.results) all = c.dag.add(all, result);
  c.results = {all};
  EXPECT_LE(live_values(schedule(c)), kLiveLimit + 4);
}

TEST(Optimise, ReportsEveryPass) {
  std::vector<std::string> lines;
  OptimiseOptions options;
  options.trace = [&](const PassReport& report) { lines.push_back(to_string(report)); };
  optimise(random_computation(1), options);
  ASSERT_GE(lines.size(), 6U);
  EXPECT_EQ(lines.front().substr(0, 19), "share denominators:");
  EXPECT_EQ(lines.back().substr(0, 9), "schedule:");
}

}  // namespace
}  // namespace sinew::program
