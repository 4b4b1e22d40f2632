// Batches of machine code made in this process: large graphs, whose registers are planned, rows
// near and far, many angles. What a batch computes has the bits of single calls.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "sinew/backend/jit.h"

namespace sinew::backend {
namespace {

using program::Computation;
using program::Ref;

class JitBatch : public testing::TestWithParam<JitLevel> {
 protected:
  void SetUp() override {
    std::string why;
    if (!jit_available(&why)) GTEST_SKIP() << "no just-in-time compiler here: " << why;
  }
};

// Operations on values from everywhere, so that hundreds wait; results in any order, among them
// inputs and runs of the same constant.
Computation large(std::uint32_t inputs, std::uint32_t results, unsigned seed) {
  std::mt19937 random(seed);
  Computation c;
  c.inputs = inputs;
  std::vector<Ref> values;
  for (std::uint32_t i = 0; i < inputs; ++i) values.push_back(c.dag.input(i));
  const auto any = [&] { return values[random() % values.size()].negated_if(random() % 2 == 0); };
  for (std::uint32_t i = 0; i < 4; ++i) {
    values.push_back(c.dag.sin(c.dag.input(3 * i)));
    values.push_back(c.dag.cos(c.dag.input(3 * i)));
  }
  for (int k = 0; k < 1500; ++k) {
    // Means of products of what is at most one.
    const Ref half = c.dag.constant(0.5 + 0.001 * (random() % 300) * 1e-3);
    const Ref product = c.dag.multiply(any(), any());
    values.push_back(c.dag.fma(half, product, c.dag.multiply(c.dag.constant(0.49), any())));
  }
  while (c.results.size() < results) {
    if (random() % 4 == 0) {
      const Ref constant = c.dag.constant(random() % 3 == 0 ? -2.5 : 0.0);
      c.results.resize(std::min<std::size_t>(results, c.results.size() + 1 + random() % 90),
                       constant);
    } else {
      c.results.push_back(any());
    }
  }
  return c;
}

// Angles in runs with gaps between them.
Computation sines_with_gaps(std::uint32_t angles) {
  Computation c;
  c.inputs = 2 * angles;
  for (std::uint32_t i = 0, row = 0; i < angles; ++i, row += i % 4 == 0 ? 3 : 1) {
    const Ref angle = c.dag.input(row);
    c.results.push_back(c.dag.sin(angle));
    c.results.push_back(-c.dag.cos(angle));
    c.results.push_back(c.dag.sin(-angle));
  }
  return c;
}

template <typename Number>
BasicJitFunction<Number> compiled(const Computation& computation, JitLevel level) {
  if constexpr (std::is_same_v<Number, float>) {
    return jit_compile_float(computation, {level, ""});
  } else {
    return jit_compile(computation, {level, ""});
  }
}

// Any of what is no number stands for the others.
template <typename Number>
auto bits_of(Number x) {
  using Bits = std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t>;
  return std::bit_cast<Bits>(std::isnan(x) ? std::numeric_limits<Number>::quiet_NaN() : x);
}

template <typename Number>
void expect_bits_of_single_calls(const Computation& computation, JitLevel level,
                                 const std::vector<Number>& odd) {
  const BasicJitFunction<Number> function = compiled<Number>(computation, level);
  const std::size_t inputs = computation.inputs, results = computation.results.size();
  std::mt19937 random(3);
  std::uniform_real_distribution<Number> number(-1, 1);
  for (const std::size_t n : {function.kLanes, 3 * function.kLanes + 5}) {
    std::vector<Number> in(inputs * n), out(results * n + 1, Number{4});
    for (Number& x : in) {
      x = number(random);
      if (!odd.empty() && random() % 16 == 0) x = odd[random() % odd.size()];
    }
    function.batch(in.data(), out.data(), n);
    EXPECT_EQ(out.back(), Number{4}) << "written beyond the end";
    std::size_t wrong = 0;
    std::vector<Number> sample(inputs), single(results);
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t i = 0; i < inputs; ++i) sample[i] = in[i * n + k];
      function(sample.data(), single.data());
      for (std::size_t j = 0; j < results; ++j) {
        wrong += bits_of(single[j]) == bits_of(out[j * n + k]) ? 0 : 1;
      }
    }
    EXPECT_EQ(wrong, 0u) << "of " << n * results;
  }
}

TEST_P(JitBatch, OfALargeGraphHasTheBitsOfSingleCalls) {
  expect_bits_of_single_calls<double>(large(40, 30, 1), GetParam(), {});
  expect_bits_of_single_calls<float>(large(40, 30, 1), GetParam(), {});
}

TEST_P(JitBatch, ReachesRowsNearAndFar) {
  expect_bits_of_single_calls<double>(large(300, 700, 2), GetParam(), {});
  expect_bits_of_single_calls<float>(large(12, 200, 3), GetParam(), {});
}

TEST_P(JitBatch, AnglesFarAwayAndThoseThatAreNoNumbersDisturbNoOthers) {
  const std::vector<double> odd = {1e9, -3e17, std::numeric_limits<double>::infinity(),
                                   std::numeric_limits<double>::quiet_NaN(), -99999.0};
  const std::vector<float> odd_floats(odd.begin(), odd.end());
  for (const std::uint32_t angles : {1u, 3u, 8u, 9u, 30u}) {
    expect_bits_of_single_calls<double>(sines_with_gaps(angles), GetParam(), odd);
    expect_bits_of_single_calls<double>(sines_with_gaps(angles), GetParam(), {});
    expect_bits_of_single_calls<float>(sines_with_gaps(angles), GetParam(), odd_floats);
    expect_bits_of_single_calls<float>(sines_with_gaps(angles), GetParam(), {});
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, JitBatch, testing::Values(JitLevel::kFast, JitLevel::kFull),
                         [](const auto& info) {
                           return info.param == JitLevel::kFast ? "fast" : "full";
                         });

}  // namespace
}  // namespace sinew::backend
